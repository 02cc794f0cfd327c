// What columns cost that are made anew again and again, as those of contacts are whenever particles meet.
#include "base/column.h"

#include <catch2/catch.hpp>

#include <set>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33) // mallinfo2

TEST_CASE("Columns that are made anew, each time longer, take a few times the memory that they hold", "[dem]")
{
  constexpr int             columns = 20, rounds = 2000, longer = 8;
  const std::size_t         before = mallinfo2().arena + mallinfo2().hblkhd;
  std::vector<base::Column> held(columns);
  std::set<int>             others; // small blocks that stay, as those of a log, lie between
  for (int round = 1; round <= rounds; ++round)
    {
      std::vector<base::Column> anew;
      for (int i = 0; i < columns; ++i)
        anew.emplace_back(longer * round);
      held = std::move(anew);
      others.insert(round);
    }
  const std::size_t taken = mallinfo2().arena + mallinfo2().hblkhd - before;
  CHECK(taken < 5 * columns * held[0].size() * sizeof(double)); // were freed blocks of no use, fifty times
}

#endif

TEST_CASE("Columns begin at the boundaries that vectors and huge pages like, whatever their length", "[dem]")
{
  for (const std::size_t length : {1, 7, 100, 4096, 262143, 262144, 1000000})
    {
      const base::Column column(length, 1.0);
      const auto         place = reinterpret_cast<std::uintptr_t>(column.data());
      CHECK(place % 64 == 0);
      if (length * sizeof(double) >= (std::size_t(2) << 20))
        CHECK(place % (std::size_t(2) << 20) == 0);
      CHECK(column.back() == 1.0);
    }
}
