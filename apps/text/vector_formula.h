#pragma once

#include "apps/text/expression.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>

namespace apps
{
  using Expressions = std::array<Expression, 3>; ///< for x, y and z

  inline bool any_given(const Expressions &formulas)
  {
    return std::any_of(formulas.begin(), formulas.end(), [](const Expression &e) { return e.given(); });
  }

  /** Its value; zero where a component is not given. */
  inline Eigen::Vector3d value_of(const Expressions &formulas, const Eigen::Vector3d &place, const double time)
  {
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    for (int c = 0; c < 3; ++c)
      if (const Expression &formula = formulas[static_cast<std::size_t>(c)]; formula.given())
        value[c] = formula(place.x(), place.y(), place.z(), time);
    return value;
  }
} // namespace apps
