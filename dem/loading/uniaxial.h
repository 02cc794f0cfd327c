#pragma once

#include "dem/specimen.h"

#include <optional>
#include <vector>

namespace dem
{
  /** Uniaxial test between two layers of particles that move apart or together (mesoscale specification 9.3). */
  struct UniaxialParameters
  {
    int    axis            = 2;     ///< 0, 1, 2: x, y, z
    double strain_rate     = 0;     ///< [1/s], > 0 pulls, < 0 crushes
    double grip_thickness  = 0;     ///< [m], > 0: layers of particles whose centre is within it of the specimen's end
    bool   lateral_blocked = false; ///< grips hold their particles sideways
    bool   spin_blocked    = false; ///< grips hold their particles' rotation
    double stop_fraction   = 0;     ///< stop when stress has fallen to this part of the peak, in (0, 1)
    double stop_strain     = 0;     ///< stop at this |strain|, > 0
  };

  /** One row of the stress-strain curve. Tension positive. */
  struct UniaxialSample
  {
    double time;   ///< [s]
    double strain; ///< displacement between the grips over their reference distance [-]
    double stress; ///< half the difference of the grips' reactions over the section [Pa]
  };

  /** What the curve says so far. Stresses and strains as magnitudes. */
  struct UniaxialFigures
  {
    double young_modulus  = 0; ///< least-squares slope through the origin up to a third of the peak stress [Pa]
    double strength       = 0; ///< largest stress [Pa]
    double strain_at_peak = 0; ///< [-]
  };

  /** Grips on a specimen and the curve they measure. The specimen must outlive the test. */
  class UniaxialTest
  {
  public:
    /**
   * Find the two layers, grip them, and start with the velocity field linear along the axis (no first shock).
   * @throws InputError when a layer is empty or the layers meet, and for parameters out of range.
   */
    UniaxialTest(Specimen &specimen, const UniaxialParameters &parameters);

    /** Take the given number of steps and add one sample to the curve. */
    UniaxialSample advance(std::int64_t steps);
    /**
     * Move the grips at another rate from now on: slower, or back. Figures and stop criterion go on as for the first rate.
     * @throws InputError for a rate that is not finite
     */
    void set_strain_rate(double strain_rate);
    /** The stop criterion is met. */
    bool finished() const;
    /** Steps to the stop strain, the most that the test can take. */
    std::int64_t most_steps() const;

    const std::vector<UniaxialSample> &curve() const;
    UniaxialFigures                    figures() const;
    double                             section() const; ///< A, smallest convex-hull section across the axis [m^2]
    double                             reference_length() const; ///< l0, between the grips' extreme centres [m]
    void                               visit_state(StateVisitor &visitor);

  private:
    Specimen                   *specimen;
    UniaxialParameters          parameters;
    std::array<std::size_t, 2>  grips; ///< low, high
    double                      area, length;
    double                      rate;                                 ///< of the grips now [1/s]
    double                      rate_changed_at = 0, strain_then = 0; ///< time [s] and strain of the last change
    std::vector<UniaxialSample> samples;
  };
} // namespace dem
