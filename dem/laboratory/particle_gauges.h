#pragma once

#include "dem/specimen/observation.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace dem
{
  /** A body of particles as a laboratory measures it with a calliper, radii included [m]. */
  struct BodyExtent
  {
    Eigen::Vector3d low, high;

    explicit BodyExtent(const ParticleKinematics &particles);
    double length(const int axis) const { return high[axis] - low[axis]; }
    double middle(const int axis) const { return 0.5 * (low[axis] + high[axis]); }
  };

  /** Some particles whose mean motion is measured. */
  struct MeanMotion
  {
    std::vector<std::size_t> particles;
    double                   place = 0; ///< mean coordinate along the axis when they were chosen [m]

    /** Mean displacement along an axis [m]. */
    double along(const ObservedSpecimen &specimen, int axis) const;
  };

  /** Strain along an axis between two groups of particles: positive where they have moved apart. */
  struct ParticleGauge
  {
    int        axis = 0;
    MeanMotion low, high;

    bool   given() const { return !low.particles.empty() && !high.particles.empty() && high.place > low.place; }
    double length() const { return high.place - low.place; } ///< [m]
    double strain(const ObservedSpecimen &specimen) const;
  };

  /**
   * The two rows of particles about a quarter and three quarters of the height, each two mean diameters to either side, so that the
   * platens have no part in what they measure.
   */
  ParticleGauge rows_along(const ParticleKinematics &particles, int axis);
  /** The outermost twentieth of the particles at either side, of those in the middle half of the height. */
  ParticleGauge sides_across(const ParticleKinematics &particles, int axis, int across);

  double mean_diameter(const std::vector<double> &radius); ///< [m]
  /** Particles whose coordinate along an axis lies that near to a place [m]. */
  MeanMotion particles_near(const ParticleKinematics &particles, int axis, double place, double within);
} // namespace dem
