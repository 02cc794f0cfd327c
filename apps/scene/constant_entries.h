#pragma once

#include "apps/scene/section.h"

namespace apps
{
  /** Declares the numbers of a link law or a material, which describes itself, in a section of the scene (or of the command line). */
  struct ConstantEntries
  {
    Section &block;

    void operator()(const char  *key,
                    double      &member,
                    const char  *unit,
                    const char  *meaning,
                    const double lower,
                    const double upper,
                    const bool   required) const
    {
      block.number(key, member, unit, Range::between(lower, upper), required ? Need::required : Need::optional)
        .means(meaning);
    }
  };
} // namespace apps
