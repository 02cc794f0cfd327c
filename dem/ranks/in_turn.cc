#include "dem/ranks/in_turn.h"

#include "dem/ranks/from_one.h"
#include "dem/ranks/ranks.h"

#include <algorithm>
#include <numeric>

namespace dem
{
  namespace
  {
    std::vector<std::size_t> all_of(const Ranks &ranks)
    {
      std::vector<std::size_t> all(ranks.size());
      std::iota(all.begin(), all.end(), std::size_t(0));
      return all;
    }

    void pass_along_some(Ranks                          &ranks,
                         const std::vector<std::size_t> &by,
                         double *const                   numbers,
                         const std::size_t               count,
                         const std::function<void()>    &go_on)
    {
      for (std::size_t k = 0; k < by.size(); ++k)
        {
          if (by[k] == ranks.rank())
            go_on();
          if (k + 1 == by.size())
            return;
          std::vector<RankMessage> to_next, from_last;
          if (by[k] == ranks.rank())
            to_next.push_back({by[k + 1], std::vector<double>(numbers, numbers + count)});
          if (by[k + 1] == ranks.rank())
            from_last.push_back({by[k], std::vector<double>(count)});
          ranks.exchange(to_next, from_last);
          if (!from_last.empty())
            std::copy_n(from_last.front().numbers.data(), count, numbers);
        }
    }
  } // namespace

  void pass_along(Ranks &ranks, double *const numbers, const std::size_t count, const std::function<void()> &go_on)
  {
    pass_along_some(ranks, all_of(ranks), numbers, count, go_on);
  }

  void in_turn(Ranks &ranks, double *const numbers, const std::size_t count, const std::function<void()> &go_on)
  {
    in_turn(ranks, all_of(ranks), numbers, count, go_on);
  }

  void in_turn(Ranks                          &ranks,
               const std::vector<std::size_t> &by,
               double *const                   numbers,
               const std::size_t               count,
               const std::function<void()>    &go_on)
  {
    pass_along_some(ranks, by, numbers, count, go_on);
    take_from(ranks, by.back(), numbers, count);
  }
} // namespace dem
