#pragma once

#include "apps/scene/section.h"
#include "apps/text/vector_formula.h"

#include <string>

namespace apps
{
  /** Entries "QUANTITY x", "QUANTITY y" and "QUANTITY z", or "x", "y" and "z" of a section that is the quantity. */
  inline void declare_components(
    Section &section, const std::string &quantity, Expressions &members, const char *unit, const std::string &meaning)
  {
    for (std::size_t i = 0; i < 3; ++i)
      section.expression(quantity + (quantity.empty() ? "" : " ") + "xyz"[i], members[i], unit).means(meaning);
  }
} // namespace apps
