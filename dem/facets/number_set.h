#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace dem
{
  /** Some numbers of many: to note which facets have been seen. Keeps its memory when it is cleared. */
  class NumberSet
  {
  public:
    NumberSet()
      : slot(least_slots, none)
    {
    }
    void clear()
    {
      std::fill(slot.begin(), slot.end(), none);
      count = 0;
    }
    /** @param number not negative @return whether it is new */
    bool add(const std::int32_t number)
    {
      if (2 * count >= slot.size())
        grow();
      std::int32_t &here = slot[place_of(number)];
      if (here == number)
        return false;
      here = number;
      ++count;
      return true;
    }

  private:
    static constexpr std::size_t  least_slots = 256; // a power of two
    static constexpr std::int32_t none        = -1;

    /** Where it is, or would be put. */
    std::size_t place_of(const std::int32_t number) const
    {
      const std::size_t last = slot.size() - 1;
      std::size_t       k    = static_cast<std::size_t>(number) & last;
      while (slot[k] != none && slot[k] != number)
        k = (k + 1) & last;
      return k;
    }
    void grow()
    {
      std::vector<std::int32_t> before(2 * slot.size(), none);
      slot.swap(before);
      for (const std::int32_t number : before)
        if (number != none)
          slot[place_of(number)] = number;
    }

    std::vector<std::int32_t> slot;
    std::size_t               count = 0;
  };
} // namespace dem
