#include "dem/facets/shared_surfaces.h"

#include "dem/ranks/in_turn.h"

#include <algorithm>
#include <cstring>

namespace dem
{
  namespace
  {
    /** What is gathered consists of whole doubles. */
    constexpr std::size_t word = sizeof(double);

    void put(const std::vector<RunningSum> &sums, std::vector<double> &numbers)
    {
      double *at = numbers.data();
      for (const RunningSum &sum : sums)
        if (sum.count > 0)
          {
            std::memcpy(at, sum.words, word * sum.count);
            at += sum.count;
          }
    }

    void take(const std::vector<RunningSum> &sums, const std::vector<double> &numbers)
    {
      const double *at = numbers.data();
      for (const RunningSum &sum : sums)
        if (sum.count > 0)
          {
            std::memcpy(sum.words, at, word * sum.count);
            at += sum.count;
          }
    }
  } // namespace

  SharedSurfaces::SharedSurfaces(
    Ranks &all, const std::int32_t first, const std::int32_t last, std::int64_t &sent, std::int64_t &sent_bytes)
    : ranks(&all)
    , first_own(first)
    , last_own(last)
    , messages(&sent)
    , bytes(&sent_bytes)
  {
  }

  void SharedSurfaces::count_sent(const std::size_t more) const
  {
    ++*messages;
    *bytes += static_cast<std::int64_t>(more);
  }

  double SharedSurfaces::largest(double number) const
  {
    if (!alone())
      ranks->largest(&number, 1);
    return number;
  }

  void SharedSurfaces::append_all(const void                                           *own,
                                  const std::size_t                                     bytes_of_line,
                                  const std::size_t                                     lines,
                                  const std::function<void(const void *, std::size_t)> &append) const
  {
    const std::vector<std::int64_t> count = of_each(static_cast<std::int64_t>(lines));
    std::vector<std::size_t>        begin = {0};
    for (const std::int64_t of : count)
      begin.push_back(begin.back() + (bytes_of_line * static_cast<std::size_t>(of) + word - 1) / word * word);
    std::vector<double> all(begin.back() / word);
    auto               *bytes_of_all = reinterpret_cast<char *>(all.data());
    if (lines > 0)
      std::memcpy(bytes_of_all + begin[ranks->rank()], own, bytes_of_line * lines);
    if (begin.back() > 0)
      {
        count_sent(begin[ranks->rank() + 1] - begin[ranks->rank()]);
        ranks->gather(all.data(), begin);
      }
    for (std::size_t r = 0; r < count.size(); ++r)
      append(bytes_of_all + begin[r], static_cast<std::size_t>(count[r]));
  }

  void SharedSurfaces::in_turn(const std::vector<RunningSum>  &sums,
                               const std::vector<std::size_t> &by,
                               const std::function<void()>    &add) const
  {
    if (by.empty())
      return;
    std::size_t length = 0;
    for (const RunningSum &sum : sums)
      length += sum.count;
    std::vector<double> numbers(length);
    put(sums, numbers);
    if (std::binary_search(by.begin(), by.end(), ranks->rank())) // to the next one, or from the last to all
      count_sent(word * length);
    dem::in_turn(*ranks, by, numbers.data(), length, [&] {
      take(sums, numbers);
      add();
      put(sums, numbers);
    });
    take(sums, numbers);
  }
} // namespace dem
