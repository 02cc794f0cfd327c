#include "dem/core/memory_pages.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace dem
{
#ifdef __linux__
  namespace
  {
    std::uintptr_t page_size()
    {
      static const auto size = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
      return size;
    }

    /** Of the whole pages in between. */
    void advise(void *const begin, void *const end, const int advice)
    {
      const std::uintptr_t page  = page_size();
      const std::uintptr_t first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page;
      const std::uintptr_t last  = reinterpret_cast<std::uintptr_t>(end) / page * page;
      if (last > first)
        madvise(reinterpret_cast<void *>(first), last - first, advice); // refused: the memory stays, and what is in it
    }
  } // namespace

  void give_back(void *const begin, void *const end) { advise(begin, end, MADV_DONTNEED); }

  void give_back(base::Column &column, const std::size_t begin, const std::size_t end)
  {
    advise(column.data() + begin, column.data() + end, MADV_DONTNEED);
  }

  void take_small_pages(base::Column &column, const std::size_t begin, const std::size_t end)
  {
    advise(column.data() + begin, column.data() + end, MADV_NOHUGEPAGE);
  }

  std::size_t resident_bytes(const base::Column &column)
  {
    const std::uintptr_t page  = page_size();
    const auto           first = reinterpret_cast<std::uintptr_t>(column.data()) / page * page;
    const auto           last  = reinterpret_cast<std::uintptr_t>(column.data() + column.size());
    const std::size_t    bytes = sizeof(double) * column.size();
    if (bytes == 0)
      return 0;
    std::vector<unsigned char> in_memory((last - first + page - 1) / page);
    if (mincore(reinterpret_cast<void *>(first), last - first, in_memory.data()) != 0)
      return bytes;
    std::size_t pages = 0;
    for (const unsigned char each : in_memory)
      pages += each & 1U;
    return std::min(bytes, pages * page);
  }
#else
  void        give_back(void *, void *) {}
  void        give_back(base::Column &, std::size_t, std::size_t) {}
  void        take_small_pages(base::Column &, std::size_t, std::size_t) {}
  std::size_t resident_bytes(const base::Column &column) { return sizeof(double) * column.size(); }
#endif

#ifdef __GLIBC__
  // Libraries may tell the allocator to keep large blocks among the small ones (SuperLU_DIST does, when it is loaded).
  void give_back_freed() { malloc_trim(0); }
#else
  void        give_back_freed() {}
#endif

  void assign_zeros(base::Column &column, const std::size_t n)
  {
    constexpr std::size_t at_once = std::size_t(4) << 20; // as many are written before they are given back
    column.clear();
    column.reserve(n);
    for (std::size_t begin = 0; begin < n; begin += at_once)
      {
        const std::size_t end = std::min(begin + at_once, n);
        column.resize(end, 0.0);
        if (n > at_once)
          give_back(column, begin, end);
      }
  }
} // namespace dem
