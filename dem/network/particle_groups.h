#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace dem
{
  /** Sets of particles that are joined directly or through others (union-find); a set is named by its smallest number. */
  class ParticleGroups
  {
  public:
    explicit ParticleGroups(const std::size_t n)
      : parent(n)
    {
      std::iota(parent.begin(), parent.end(), 0);
    }

    std::int32_t group_of(std::int32_t i)
    {
      while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
      return i;
    }

    void join(const std::int32_t a, const std::int32_t b)
    {
      const std::int32_t group_a = group_of(a), group_b = group_of(b);
      parent[std::max(group_a, group_b)] = std::min(group_a, group_b);
    }

  private:
    std::vector<std::int32_t> parent;
  };
} // namespace dem
