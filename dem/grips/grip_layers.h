#pragma once

#include "dem/grips/section.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace dem
{
  /** What the strain of a specimen between grips refers to. */
  enum class Gauge
  {
    inner_faces, ///< from the innermost centre of one grip to that of the other: all that can strain, nothing else
    outermost_centres, ///< from one end of the specimen to the other: as Stransky (2018) published
    planes             ///< between two planes of the user's own, whose motion is measured, as by an extensometer
  };

  /** How a specimen is gripped, and what its stress and strain refer to. */
  struct GripParameters
  {
    double thickness = 0; ///< [m], > 0: a grip holds the centres within it of the outermost centre
    double area      = 0; ///< that stress refers to [m^2]; 0: nominal_section()
    Gauge  gauge     = Gauge::inner_faces;
    double low_plane = 0, high_plane = 0; ///< along the axis [m]; Gauge::planes only
  };

  /**
   * Measures the motion of a plane across an axis: of the particles within a diameter of it, the displacement that a straight line
   * through theirs (least squares over the place along the axis) has at the plane. Exact where strain is uniform.
   */
  struct PlaneGauge
  {
    std::vector<std::size_t> particles; ///< by their numbers
    std::vector<double>      weight;    ///< of their displacements along the axis; the sum is 1

    /** Of the plane along the axis [m]. @param displacement of a particle along the axis, by its number */
    template <typename Displacement>
    double motion(const Displacement &displacement) const
    {
      double sum = 0;
      for (std::size_t k = 0; k < particles.size(); ++k)
        sum += weight[k] * displacement(particles[k]);
      return sum;
    }
  };

  /** What a uniaxial test grips: two layers of particles at the ends of a specimen (doc/theory/laboratory-test.md). */
  struct GripLayers
  {
    std::vector<std::size_t> low, high;        ///< particle numbers
    double                   low_face     = 0; ///< innermost centre of the low grip, along the axis [m]
    double                   high_face    = 0; ///< of the high one [m]
    double                   distance     = 0; ///< that the strain prescribed by the grips refers to [m]
    double                   gauge_length = 0; ///< that the measured strain refers to [m]
    double                   section      = 0; ///< that the stress refers to [m^2]
    /** Low and high, where the strain is measured between planes; otherwise it is that of the grips. */
    std::optional<std::pair<PlaneGauge, PlaneGauge>> planes;

    double middle() const { return 0.5 * (low_face + high_face); }
  };

  /**
   * Particles whose centre is within the grips' thickness of the specimen's outermost centres along an axis.
   * @throws base::InputError if the two layers would meet (it names Grip thickness), or a plane has no particles near it
   */
  GripLayers find_grip_layers(const SpecimenShape &specimen, int axis, const GripParameters &parameters);
} // namespace dem
