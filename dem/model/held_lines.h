#pragma once

#include "dem/model/links.h"

#include <algorithm>
#include <cstddef>

namespace dem
{
  /** Some lines of a set in a row. */
  struct LinkRange
  {
    std::size_t begin = 0, end = 0;
  };

  inline LinkRange all_lines(const LinkSet &links) { return {0, links.count}; }

  /** Call use(link) for the living among some lines, ascending. */
  template <typename Use>
  void each_living(const LinkSet &links, const LinkRange &lines, const Use &use)
  {
    for (std::size_t l = lines.begin; l < std::min(lines.end, links.count); ++l)
      if (links.is_alive(l))
        use(l);
  }

  /** The same for all of which this process has the state: among several ranks its own, and copies of others (doc/theory/ranks.md, 3). */
  template <typename Use>
  void each_held(const LinkSet &links, const Use &use)
  {
    if (!links.in_parts)
      return each_living(links, all_lines(links), use);
    for (const LinkPart &part : links.parts)
      each_living(links, {part.begin, part.end}, use);
  }
} // namespace dem
