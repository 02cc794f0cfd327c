#pragma once

#include "dem/grips/grip_layers.h"
#include "dem/loading/curve_figures.h"
#include "dem/specimen/specimen.h"

#include <functional>
#include <vector>

namespace dem
{
  /** Uniaxial test between two layers of particles that move apart or together (doc/theory/laboratory-test.md). */
  struct UniaxialParameters
  {
    int            axis        = 2; ///< 0, 1, 2: x, y, z
    double         strain_rate = 0; ///< [1/s], > 0 pulls, < 0 crushes: relative speed of the grips over their distance
    GripParameters grips;
    bool           lateral_blocked = false; ///< grips hold their particles sideways
    bool           spin_blocked    = false; ///< grips hold their particles' rotation
    bool           turning         = false; ///< each grip turns about its middle; only if lateral_blocked
    /** Stop when stress has fallen to this part of the peak, in (0, 1); 0: however far it falls. */
    double stop_fraction = 0;
    double stop_strain   = 0; ///< stop when the grips have moved by this part of their distance, > 0
  };

  /** One row of the stress-strain curve. Tension positive. */
  struct UniaxialSample
  {
    double time;   ///< [s]
    double strain; ///< over the gauge length [-]
    double stress; ///< half the difference of the grips' reactions over the section [Pa]
  };

  /**
   * Grips on a specimen and the curve they measure. Figures and the end of the test come from every step, samples are only what is
   * shown. The specimen must outlive the test.
   */
  class UniaxialTest
  {
  public:
    /**
     * Find the two layers, grip them, and start with the velocity field linear between them (no first shock).
     * @throws base::InputError when the layers meet, and for parameters out of range.
     */
    UniaxialTest(Specimen &specimen, const UniaxialParameters &parameters);

    /** Take the given number of steps, fewer where the test ends, and add one sample to the curve. */
    UniaxialSample advance(std::int64_t steps);
    /**
     * Move the grips at another rate from now on: slower, or back. Figures and stop criterion go on as for the first rate.
     * @throws base::InputError for a rate that is not finite
     */
    void set_strain_rate(double strain_rate);
    /** The stop criterion is met. */
    bool finished() const;
    /** Steps to the stop strain, the most that the test can take. */
    std::int64_t most_steps() const;

    /** Reports every step to the caller, however seldom the curve is sampled. Not part of the state. */
    void watch(std::function<void(const UniaxialSample &)> each_step) { watcher = std::move(each_step); }

    const std::vector<UniaxialSample> &curve() const { return samples; }
    UniaxialFigures                    figures() const;
    const GripLayers                  &grip_layers() const { return layers; }
    double                             section() const { return layers.section; }           ///< A [m^2]
    double                             gauge_length() const { return layers.gauge_length; } ///< [m]
    void                               visit_state(base::StateVisitor &visitor);

  private:
    /** Time and strains of the forces that the next step will find. */
    void look_ahead();
    /** Take the forces of the step just done. */
    void   measure();
    double travel() const; ///< of the grips, over their distance
    double opening_of_planes() const;
    void   move_grips();
    bool   past_peak() const;

    Specimen                   *specimen;
    UniaxialParameters          parameters;
    GripLayers                  layers;
    std::array<std::size_t, 2>  grips; ///< low, high
    std::int64_t                row;   ///< particles one behind the other from grip to grip: steps that a wave takes
    double                      rate;  ///< of the grips now [1/s]
    double                      rate_changed_at = 0, travel_then = 0; ///< time [s] and travel of the last change
    double                      planes_at_start = 0; ///< what the planes' displacements differ by then [m]
    double                      next_time = 0, next_travel = 0, next_strain = 0; ///< see look_ahead()
    UniaxialSample              now       = {0, 0, 0};
    double                      travelled = 0, travelled_at_peak = 0;
    std::int64_t                low_steps    = 0; ///< for how many steps the stress has been below the stop fraction
    std::int64_t                fallen_steps = 0; ///< and as low as after a peak
    CurveFigures                record;
    std::vector<UniaxialSample> samples;

    std::function<void(const UniaxialSample &)> watcher;
  };
} // namespace dem
