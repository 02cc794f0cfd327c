#pragma once

#include <Eigen/Core>

#include <vector>

namespace coupling
{
  /** What a slab between two parallel cuts passes on, as its volume mean: (1/thickness) integral of sigma n, and its moment. */
  struct SectionForce
  {
    double          place  = 0;                       ///< of the slab's middle along the axis [m]
    double          volume = 0;                       ///< of what lies in the slab [m^3]
    Eigen::Vector3d force  = Eigen::Vector3d::Zero(); ///< [N]
    Eigen::Vector3d moment = Eigen::Vector3d::Zero(); ///< about the axis' parallel through the given centre [N m]
  };

  /** Which cuts: `count` slabs of equal thickness from `low` to `high` along an axis. */
  struct Sections
  {
    int             axis = 0;
    double          low = 0, high = 0; ///< [m]
    int             count  = 1;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< moments are about this point moved to the slab's middle [m]
  };

  /**
   * Section forces of stresses carried by volumes at places: particles or integration points alike. What lies outside counts for the
   * outermost slabs.
   */
  std::vector<SectionForce> section_forces(const Sections                     &sections,
                                           const std::vector<Eigen::Vector3d> &place,
                                           const std::vector<double>          &volume,
                                           const std::vector<Eigen::Matrix3d> &stress);
} // namespace coupling
