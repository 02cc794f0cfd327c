#pragma once

#include "dem/mesostructure/grading_curve.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /** Diameters of aggregates that stand for a grading. */
  struct AggregateSizes
  {
    std::vector<double> diameters;     ///< descending [m]
    double              volume    = 0; ///< of spheres of these diameters [m^3]
    double              increment = 0; ///< delta_0, by constant increments only [m]
  };

  /** Volume of spheres [m^3]. @param diameters [m] */
  double volume_of_spheres(const std::vector<double> &diameters);

  /**
   * Sizes by constant number increment (doc/theory/mesostructure.md, 2; Stransky, 2018, 8.2): the first is the smallest, each next one so
   * much larger that [P(d + D) - P(d)]/(d + D)^3 is that of the first increment, until no size of the curve is.
   *
   * @param smallest of the modelled aggregates, on the curve below its largest [m] @param increment delta_0 of the first [m], > 0
   * @throws base::InputError for sizes off the curve, an increment that leads nowhere, or more than a million aggregates
   */
  AggregateSizes sizes_by_increment(const GradingCurve &curve, double smallest, double increment);

  /**
   * The same, with the increment tuned. About its target the volume goes in saw teeth, as the largest aggregate comes and goes: that increment
   * is taken whose volume and passing are nearest, as parts of 0.5 % and 0.005, within which both are unless aggregates are too few.
   * @param volume of the requested aggregates [m^3], > 0 @throws base::InputError also where not one aggregate is so small
   */
  AggregateSizes sizes_for_volume(const GradingCurve &curve, double smallest, double volume);

  /**
   * Sizes drawn from the number density of each class between two sieves, f(d) ~ P'(d)/d^3, coarsest class first: as many as bring its
   * volume nearest to what the grading gives, what it lacks or has too much being made up for by the next finer class.
   * @throws base::InputError as sizes_for_volume()
   */
  AggregateSizes drawn_sizes(const GradingCurve &curve, double smallest, double volume, std::uint64_t seed);

  /** Largest difference of the passing of so many spheres, with the finer solid that the curve has, from the curve at its sieves [-]. */
  double largest_misfit(const GradingCurve &curve, double smallest, const std::vector<double> &diameters);
} // namespace dem
