#pragma once

#include "dem/peridynamics/model.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dem::peridynamics
{
  /** Constants of the bonds between two materials. */
  struct PairConstants
  {
    double young_modulus    = 0;                                       ///< [Pa]; 0: the two are not bonded
    double critical_stretch = std::numeric_limits<double>::infinity(); ///< [-]
  };

  /**
   * Of bonds one half of which is of each material: the halves pull alike, so that the stiffness is the harmonic mean, and the bond breaks
   * when the first of them reaches its critical stretch (doc/theory/peridynamics.md, 1).
   */
  PairConstants in_series(const Material &one, const Material &other);

  /** The materials of a body. They share the model of their bonds and the calibration of the grid, which are those of the first. */
  struct Mixture
  {
    std::vector<Material>      materials; ///< at least one
    std::vector<PairConstants> pairs;     ///< of the bonds between each two, in the order of dem::material_pair()
    std::vector<std::int32_t>  of; ///< number of the material of each place of the grid; empty: all are of the first

    Mixture() = default;
    /** One material. */
    explicit Mixture(const Material &material);
    /** Several, whose bonds are in_series(). @param of_places one number per place of the grid */
    Mixture(const std::vector<Material> &several, const std::vector<std::int32_t> &of_places);

    const Material &at(std::size_t place) const;
    PairConstants  &between(std::size_t one, std::size_t other);
    /** Number of the pair of the materials at two places. */
    std::size_t pair_at(std::size_t place, std::size_t other_place) const;
    double      largest_modulus() const; ///< of any pair [Pa]
  };
} // namespace dem::peridynamics
