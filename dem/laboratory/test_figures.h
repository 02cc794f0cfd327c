#pragma once

#include "dem/laboratory/test_record.h"

#include <string>
#include <vector>

namespace dem
{
  /** A number that a test may have found. */
  struct Finding
  {
    bool        found = false;
    double      value = 0;
    std::string why_not; ///< where it is not determined

    static Finding of(double value) { return {true, value, {}}; }
    static Finding none(std::string reason) { return {false, 0, std::move(reason)}; }
  };

  /** What is read off the curve of a test (spec: measures of a laboratory, 3). */
  struct TestFigures
  {
    Finding largest_stress;  ///< of every step [Pa]
    Finding strength;        ///< the same, once it is known to be the peak [Pa]
    Finding smooth_strength; ///< the largest mean over one part in 200 of the curve [Pa]
    Finding strain_at_peak;  ///< by the platens [-]
    Finding modulus;         ///< slope at half the peak, by the platens [Pa]
    Finding gauge_modulus;   ///< the same by gauges [Pa]
    Finding secant_modulus;  ///< from the start to half the peak, by the platens: E50 [Pa]
    Finding poisson_secant;  ///< lateral over axial strain of the gauges at half the peak [-]
    Finding poisson_slope;   ///< ratio of their slopes there [-]
  };

  /** What the figures of a curve are read from. */
  struct TestCurve
  {
    const TestRecord &record;
    double            offset   = 0;     ///< of the stress: what is no load of the test, as a confining pressure [Pa]
    bool              past     = false; ///< the largest stress is known to be the peak
    double            peak     = 0;     ///< largest stress of every step, without the offset [Pa]
    double            at_peak  = 0;     ///< strain there
    bool              compress = true;  ///< otherwise the specimen is pulled, and grows thinner
  };

  /**
   * Modulus and ratio of Poisson from least-squares lines over the rows where the stress, on its first way up, lies between 0.45 and
   * 0.55 of the peak.
   */
  TestFigures figures_of(const TestCurve &curve);

  /** Whether the loading was slow enough to be called static (spec: bonded contact laws, 7.4). */
  struct QuasiStatic
  {
    /** Largest difference of the forces on both platens over their mean, before the peak and from a tenth of it on. */
    Finding imbalance;
    /** Largest kinetic energy over the work of the loading, likewise. */
    Finding kinetic;
    /** Largest Specimen::force_ratio(), likewise. */
    Finding force_ratio;
    /** By how much the strength differs at half the speed, over it; only where that was checked: see effect_of_speed(). */
    Finding speed = Finding::none("the loading was not repeated at half the speed");

    static constexpr double most_imbalance = 0.01, most_kinetic = 0.001, most_speed = 0.02;

    bool determined() const { return imbalance.found && kinetic.found; }
    bool holds() const
    {
      return determined() && imbalance.value < most_imbalance && kinetic.value < most_kinetic &&
             (!speed.found || speed.value < most_speed);
    }
  };

  /** |strength at half the speed / strength - 1|. */
  Finding effect_of_speed(const TestFigures &test, const TestFigures &at_half_the_speed);

  QuasiStatic quasi_static(const TestCurve &curve);
} // namespace dem
