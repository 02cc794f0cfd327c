#pragma once

#include "dem/ranks/ranks.h"

#include <cstddef>
#include <vector>

namespace dem
{
  /** What each rank has of something, on all. @tparam Record of whole doubles, or integers as wide */
  template <typename Record>
  std::vector<Record> of_each_rank(Ranks &ranks, const Record &own)
  {
    static_assert(sizeof(Record) % sizeof(double) == 0, "what is gathered consists of whole doubles");
    std::vector<Record>      all(ranks.size());
    std::vector<std::size_t> begin;
    for (std::size_t r = 0; r <= ranks.size(); ++r)
      begin.push_back(r * sizeof(Record));
    all[ranks.rank()] = own;
    ranks.gather(all.data(), begin);
    return all;
  }
} // namespace dem
