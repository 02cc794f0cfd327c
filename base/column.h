#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace base
{
  /**
   * Allocates at cache-line boundaries, so that eight doubles are always one aligned load; large columns on huge pages where the
   * system grants them, because links reach all over the particle columns and would miss the address cache at every other one.
   */
  template <typename T>
  struct ColumnAllocator
  {
    using value_type                        = T;
    static constexpr std::size_t cache_line = 64;
    static constexpr std::size_t huge_page  = std::size_t(2) << 20;

    ColumnAllocator() = default;
    template <typename U>
    ColumnAllocator(const ColumnAllocator<U> &)
    {
    }

    static std::size_t alignment(const std::size_t n) { return n * sizeof(T) >= huge_page ? huge_page : cache_line; }

    /**
     * A part of a larger block, whose place is kept before it. An aligned block of the system would be simpler, but the GNU C library
     * (2.36) rarely reuses freed ones: a run that allocates columns again and again would keep growing.
     */
    T *allocate(const std::size_t n)
    {
      const std::size_t boundary   = alignment(n);
      void *const block            = ::operator new(n * sizeof(T) + boundary + sizeof(void *));
      const auto            first  = reinterpret_cast<std::uintptr_t>(block) + sizeof(void *);
      const auto            place  = (first + boundary - 1) / boundary * boundary;
      void **const          column = reinterpret_cast<void **>(place);
      column[-1]                   = block;
#ifdef MADV_HUGEPAGE
      if (boundary == huge_page)
        madvise(column, n * sizeof(T), MADV_HUGEPAGE); // a wish: whether it is granted changes speed only
#endif
      return reinterpret_cast<T *>(column);
    }
    void deallocate(T *place, std::size_t) { ::operator delete(reinterpret_cast<void **>(place)[-1]); }

    friend bool operator==(const ColumnAllocator &, const ColumnAllocator &) { return true; }
    friend bool operator!=(const ColumnAllocator &, const ColumnAllocator &) { return false; }
  };

  /** One quantity of all particles or links, contiguous. */
  using Column = std::vector<double, ColumnAllocator<double>>;
} // namespace base
