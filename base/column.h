#pragma once

#include <cstddef>
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

    T *allocate(const std::size_t n)
    {
      void *place = ::operator new(n * sizeof(T), std::align_val_t(alignment(n)));
#ifdef MADV_HUGEPAGE
      if (alignment(n) == huge_page)
        madvise(place, n * sizeof(T), MADV_HUGEPAGE); // a wish: whether it is granted changes speed only
#endif
      return static_cast<T *>(place);
    }
    void deallocate(T *place, const std::size_t n) { ::operator delete(place, std::align_val_t(alignment(n))); }

    friend bool operator==(const ColumnAllocator &, const ColumnAllocator &) { return true; }
    friend bool operator!=(const ColumnAllocator &, const ColumnAllocator &) { return false; }
  };

  /** One quantity of all particles or links, contiguous. */
  using Column = std::vector<double, ColumnAllocator<double>>;
} // namespace base
