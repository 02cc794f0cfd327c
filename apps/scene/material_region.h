#pragma once

#include "apps/scene/section.h"

#include <Eigen/Core>

#include <array>
#include <string>

namespace apps
{
  /** Sub-section of "Regions": particles whose centre lies within are of its material. */
  struct MaterialRegion
  {
    enum class Shape
    {
      box,
      sphere
    };

    std::string           name, material;
    Shape                 shape = Shape::sphere;
    std::array<double, 3> lower = {0, 0, 0}, upper = {0, 0, 0}; ///< corners of a box [m]
    std::array<double, 3> centre = {0, 0, 0};                   ///< of a sphere [m]
    double                radius = 0;                           ///< of a sphere [m]

    void declare(Section &section);
    /** @throws dem::InputError for a box inside out. */
    void validate(const Section &section, int dimension) const;
    /** In two dimensions z is not looked at: a rectangle, or a circle. Its border belongs to it. */
    bool holds(const Eigen::Vector3d &place, int dimension) const;
  };
} // namespace apps
