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

  /** What has been declared so is that of the start: by place alone, as models demand. */
  inline void by_place_alone(Section &section, const std::string &quantity)
  {
    for (const char axis : {'x', 'y', 'z'})
      section.find_entry(quantity + (quantity.empty() ? "" : " ") + axis)->allowed = "in x, y, z [m], or empty";
  }
} // namespace apps
