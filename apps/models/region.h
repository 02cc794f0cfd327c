#pragma once

#include "base/entry_path.h"

#include <Eigen/Core>

#include <array>

namespace apps
{
  /** A part of space, as entries of a section: a box along the axes, a sphere or a cylinder. */
  struct Region
  {
    enum class Shape
    {
      box,
      sphere,
      cylinder
    };

    Shape                 shape = Shape::sphere;
    std::array<double, 3> lower = {0, 0, 0}, upper = {0, 0, 0}; ///< corners of a box [m]
    std::array<double, 3> centre = {0, 0, 0};                   ///< of a sphere [m]
    std::array<double, 3> from = {0, 0, 0}, to = {0, 0, 0};     ///< ends of the axis of a cylinder [m]
    double                radius = 0;                           ///< of a sphere or cylinder [m]

    /** @throws base::InputError for a box inside out, or a cylinder without length. */
    void check(const base::EntryPath &section, int dimension) const;
    /** In two dimensions z is ignored: a rectangle, a circle, a strip. Its border belongs to it. */
    bool holds(const Eigen::Vector3d &place, int dimension) const;
    /** Whether any place of the straight line between the two is held. */
    bool meets(const Eigen::Vector3d &one, const Eigen::Vector3d &other, int dimension) const;
  };
} // namespace apps
