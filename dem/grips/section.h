#pragma once

#include <Eigen/Core>

#include <vector>

namespace dem
{
  /** Particles of a specimen and how thick its discs are. */
  struct SpecimenShape
  {
    const std::vector<Eigen::Vector3d> &centre; ///< [m]
    const std::vector<double>          &radius; ///< [m]
    int                                 dimension = 3;
    double                              thickness = 0; ///< two dimensions only [m]
  };

  /**
   * Nominal section of a specimen across an axis [m^2], as a laboratory measures it with a calliper: of all particles, seen along the
   * axis, the rectangle around their circles, or the circle around them where that is the smaller one (a cylinder). In two dimensions
   * the extent across the axis times the thickness.
   *
   * The rectangle's sides are those of the axes; the circle is drawn around its middle.
   */
  double nominal_section(const SpecimenShape &specimen, int axis);
} // namespace dem
