#pragma once

#include "base/entry_path.h"
#include "dem/laws/scaled_constants.h"
#include "dem/mesostructure/aggregate_sizes.h"
#include "dem/mesostructure/mix.h"
#include "dem/mesostructure/placement.h"

#include <Eigen/Core>

#include <cstdint>
#include <list>
#include <string>
#include <vector>

namespace apps
{
  /** Sub-section of "Mix/Constituents": what a cubic metre of concrete has of a material. */
  struct MixConstituent
  {
    std::string name;
    double      mass      = 0;             ///< [kg/m^3]
    double      density   = 0;             ///< of the material [kg/m^3]
    bool        aggregate = false;         ///< part of the grading; those with sizes are anyway
    double      smallest = 0, largest = 0; ///< sizes of a class of aggregates [m]; 0: finer than all classes
    bool        is_aggregate() const { return aggregate || largest > 0; }
  };

  /** Sub-section "Mix" of "Specimen": aggregates in mortar (doc/theory/mesostructure.md). */
  struct MixSection
  {
    enum class Grading
    {
      constituents, ///< their classes
      passing,      ///< of sieves, listed
      retained,     ///< likewise
      file,         ///< a table of one or the other
      fuller
    };
    enum class Sizes
    {
      increments, ///< of constant number
      drawn
    };

    std::list<MixConstituent> constituents;             ///< in the scene's order; none: the content is given
    double                    unit_weight = 0, air = 0; ///< [kg/m^3], [-]
    double                    content = 0; ///< aggregates of every size, part of the volume [-]; 0: of the constituents
    Grading                   grading = Grading::constituents;
    std::vector<dem::SievePart> curve; ///< as written: parts of 1, or percent
    std::string                 curve_file;
    double                      fuller_exponent = 0.5;
    double                      smallest        = 0; ///< aggregate that is modelled [m]; 0: there is no mix
    double                      largest         = 0; ///< of Fuller's curve [m]
    Sizes                       sizes           = Sizes::increments;
    double                      increment       = 0; ///< delta_0 [m]; 0: tuned
    dem::AggregateShape         shape;
    std::int64_t                corners   = dem::AggregateShape().corners;
    double                      clearance = dem::AggregatePlacement().clearance; ///< of the sum of two radii
    double                      distance = 0, wall = 0;                          ///< [m]
    std::int64_t seed = 1, tries = dem::AggregatePlacement().tries, restarts = dem::AggregatePlacement().restarts;
    std::string  mortar = "mortar", aggregate = "aggregate"; ///< names of materials

    dem::ConstantFactors aggregates = {2.5, 5, 1}, interface = {0.5, 0.5, 0.1}; ///< of constants, over the mortar's

    bool given() const { return smallest > 0; }
    /** @param box edges, or zero where there is none [m] @throws base::InputError */
    void check(const base::EntryPath &specimen, const Eigen::Vector3d &box, int dimension) const;
    /** The same of a periodic cell, whose edges are known once its particles are. @throws base::InputError */
    void check_for_cell(const base::EntryPath &specimen) const;
    /** @param materials of section Materials, empty: there is none @throws base::InputError where mortar or aggregate is not among them */
    void require_among(const std::vector<std::string> &materials, const base::EntryPath &specimen) const;

    dem::MixVolumes       volumes() const;            ///< @pre there are constituents
    dem::GradingCurve     grading_curve() const;      ///< @throws base::InputError
    double                all_aggregates() const;     ///< part of the volume, of every size [-]
    double                prescribed_content() const; ///< likewise, of modelled sizes
    dem::AggregateSizes   sizes_in(const Eigen::Vector3d &box) const;
    dem::PlacedAggregates placed_in(const Eigen::Vector3d &box, bool periodic) const;
    /** The box of which a plane model is the section z = 0: periodic, and twice as deep as the largest aggregate. @param box in the plane [m] */
    Eigen::Vector3d box_behind(const Eigen::Vector3d &box) const;
  };
} // namespace apps
