#pragma once

#include "apps/scene/section.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <string>

namespace apps
{
  using Expressions = std::array<Expression, 3>; ///< for x, y and z

  /** Entries "QUANTITY x", "QUANTITY y" and "QUANTITY z", or "x", "y" and "z" of a section that is the quantity. */
  inline void declare_components(
    Section &section, const std::string &quantity, Expressions &members, const char *unit, const std::string &meaning)
  {
    for (std::size_t i = 0; i < 3; ++i)
      section.expression(quantity + (quantity.empty() ? "" : " ") + "xyz"[i], members[i], unit).means(meaning);
  }

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
