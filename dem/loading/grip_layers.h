#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace dem
{
  /** What a uniaxial test grips: two layers of particles at the ends of a specimen (mesoscale specification 9.3). */
  struct GripLayers
  {
    std::vector<std::size_t> low, high;  ///< particle numbers
    double                   length = 0; ///< between the outermost centres; the strain refers to it [m]
    double                   middle = 0; ///< between them, along the axis [m]
    double                   section =
      0; ///< smallest section between the layers, of the particles themselves where nothing lies between [m^2]
  };

  /** Particles of a specimen and how thick its discs are. */
  struct SpecimenShape
  {
    const std::vector<Eigen::Vector3d> &centre; ///< [m]
    const std::vector<double>          &radius; ///< [m]
    int                                 dimension = 3;
    double                              thickness = 0; ///< two dimensions only [m]
  };

  /**
   * Particles whose centre is within the grips' thickness of the specimen's ends along an axis.
   * @throws InputError if a layer would be empty or the two would meet; it names Loading/Grip thickness
   */
  GripLayers find_grip_layers(const SpecimenShape &specimen, int axis, double grip_thickness);
} // namespace dem
