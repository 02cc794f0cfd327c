#include "dem/ranks/in_turn.h"

#include "dem/ranks/ranks.h"

#include <algorithm>
#include <vector>

namespace dem
{
  void pass_along(Ranks &ranks, double *const numbers, const std::size_t count, const std::function<void()> &go_on)
  {
    for (std::size_t r = 0; r < ranks.size(); ++r)
      {
        if (r == ranks.rank())
          go_on();
        std::vector<RankMessage> to_next, from_last;
        if (r == ranks.rank() && r + 1 < ranks.size())
          to_next.push_back({r + 1, std::vector<double>(numbers, numbers + count)});
        if (r + 1 == ranks.rank())
          from_last.push_back({r, std::vector<double>(count)});
        if (r + 1 < ranks.size())
          ranks.exchange(to_next, from_last);
        if (!from_last.empty())
          std::copy_n(from_last.front().numbers.data(), count, numbers);
      }
  }

  void in_turn(Ranks &ranks, double *const numbers, const std::size_t count, const std::function<void()> &go_on)
  {
    pass_along(ranks, numbers, count, go_on);
    std::vector<std::size_t> of_last(ranks.size() + 1, 0);
    of_last.back() = count * sizeof(double);
    ranks.gather(numbers, of_last);
  }
} // namespace dem
