#pragma once

#include "dem/ranks/of_each_rank.h"
#include "dem/ranks/ranks.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace dem
{
  /** Numbers that are summed up over contacts in their order: places of words of eight bytes, and how many. */
  struct RunningSum
  {
    void       *words;
    std::size_t count;
  };

  /**
   * How one of several ranks takes part in what particles and surfaces do to each other (doc/theory/ranks.md, 3): it finds the contacts of
   * its own particles, and sums go from rank to rank, so that they have the order, and the bits, of one. Alone, all particles are its own.
   */
  class SharedSurfaces
  {
  public:
    SharedSurfaces() = default;
    /**
     * @param first own particle @param last behind the own particles, which are a range of their order by ranks
     * @param messages, bytes counts of what this rank sends, added to
     */
    SharedSurfaces(Ranks &ranks, std::int32_t first, std::int32_t last, std::int64_t &messages, std::int64_t &bytes);

    bool         alone() const { return ranks == nullptr; }
    std::size_t  rank() const { return alone() ? 0 : ranks->rank(); }
    std::int32_t first() const { return first_own; }
    std::int32_t last() const { return last_own; }
    bool         owns(const std::int32_t particle) const { return particle >= first_own && particle < last_own; }

    double largest(double number) const;
    /** What each rank has of something. @pre not alone */
    template <typename Record>
    std::vector<Record> of_each(const Record &own) const
    {
      count_sent(sizeof(Record));
      return of_each_rank(*ranks, own);
    }
    /** Lines of a list, copied byte by byte: one rank's after the other's. */
    template <typename Line>
    std::vector<Line> of_all(std::vector<Line> own) const
    {
      if (alone())
        return own;
      std::vector<Line> all;
      append_all(own.data(), sizeof(Line), own.size(), [&](const void *lines, const std::size_t count) {
        const Line *from = static_cast<const Line *>(lines);
        all.insert(all.end(), from, from + count);
      });
      return all;
    }
    /**
     * Sums go from one rank to the next of those that have something to add, and all have what comes out. @pre not alone
     * @param by ranks that add to them, ascending, the same on all
     */
    void in_turn(const std::vector<RunningSum>  &sums,
                 const std::vector<std::size_t> &by,
                 const std::function<void()>    &add) const;

  private:
    void count_sent(std::size_t more) const;
    void append_all(const void                                           *own,
                    std::size_t                                           bytes_of_line,
                    std::size_t                                           lines,
                    const std::function<void(const void *, std::size_t)> &append) const;

    Ranks        *ranks     = nullptr;
    std::int32_t  first_own = 0, last_own = std::numeric_limits<std::int32_t>::max();
    std::int64_t *messages = nullptr, *bytes = nullptr;
  };
} // namespace dem
