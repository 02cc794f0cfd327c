#pragma once

#include "apps/models/mix.h"
#include "dem/mesostructure/placement.h"
#include "dem/model/packing.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace apps
{
  /** Where the aggregates of a mix lie. */
  struct MixBox
  {
    Eigen::Vector3d edges    = Eigen::Vector3d::Zero(); ///< [m]
    bool            periodic = false;
  };

  /**
   * Number and name the materials of a packing's particles by a mix: mortar, or aggregate. Says on the standard error what was reached.
   *
   * @param box that the aggregates lie in @param linked distance over the sum of two radii up to which particles are linked: aggregates with such
   * ones are of different numbers @pre the mix is given @throws base::InputError
   */
  void take_mix(dem::Packing &packing, const MixSection &mix, const MixBox &box, double linked);

  /** Figures of the mix: requested and reached content, number, largest size, by class of sieves. */
  struct MixFigures
  {
    dem::GradingCurve     curve;
    double                requested = 0, reached = 0; ///< part of the specimen that is aggregate [-]
    dem::AggregateSizes   sizes;
    dem::PlacedAggregates placed;
    double                smallest;

    nlohmann::json json() const;
    std::string    text() const; ///< one line
    /** Curve, and content of each class of sieves, both as requested and as placed. @return why not, empty when drawn */
    std::string draw(const std::filesystem::path &file) const;
  };

  /** @param box that the aggregates lie in @pre the mix is given */
  MixFigures mix_figures(const MixSection &mix, const MixBox &box);
} // namespace apps
