#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace dem
{
  /** Allocates at cache-line boundaries, so that eight doubles are always one aligned load. */
  template <typename T>
  struct CacheLineAllocator
  {
    using value_type                       = T;
    static constexpr std::size_t alignment = 64;

    CacheLineAllocator() = default;
    template <typename U>
    CacheLineAllocator(const CacheLineAllocator<U> &)
    {
    }
    T *allocate(const std::size_t n)
    {
      return static_cast<T *>(::operator new(n * sizeof(T), std::align_val_t(alignment)));
    }
    void deallocate(T *p, std::size_t) { ::operator delete(p, std::align_val_t(alignment)); }

    friend bool operator==(const CacheLineAllocator &, const CacheLineAllocator &) { return true; }
    friend bool operator!=(const CacheLineAllocator &, const CacheLineAllocator &) { return false; }
  };

  /** One quantity of all particles or links, contiguous and aligned to a cache line. */
  using Column = std::vector<double, CacheLineAllocator<double>>;
} // namespace dem
