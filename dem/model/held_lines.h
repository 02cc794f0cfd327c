#pragma once

#include "dem/model/links.h"

#include <algorithm>
#include <cstddef>
#include <vector>

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

  /** Lines that this process updates among several ranks: its own, and copies of others (doc/theory/ranks.md, 3). */
  inline std::vector<LinkRange> updated_lines(const LinkSet &links)
  {
    if (!links.in_parts)
      return {all_lines(links)};
    std::vector<LinkRange> lines;
    for (const LinkPart &part : links.parts)
      lines.push_back({part.begin, part.end});
    return lines;
  }
} // namespace dem
