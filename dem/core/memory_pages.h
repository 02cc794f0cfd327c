#pragma once

#include "base/column.h"

#include <cstddef>

namespace dem
{
  /**
   * Give the memory of some numbers of a column back to the system, as far as they fill whole pages: they are zero from then on, and take memory
   * again where they are written. Where the system cannot do so, nothing happens. @param end behind the last
   */
  void give_back(base::Column &column, std::size_t begin, std::size_t end);

  /** The same for memory that nobody reads again. @param end behind the last byte */
  void give_back(void *begin, void *end);

  /** Zeros, as many as n, that take no memory before they are written, where they are many. */
  void assign_zeros(base::Column &column, std::size_t n);

  /** Let numbers of a column take memory page by page, rather than in large pieces of which most may stay empty. */
  void take_small_pages(base::Column &column, std::size_t begin, std::size_t end);

  /**
   * Give memory that was freed, and lies between what is in use, back to the system: what large specimens were made of. Where the system cannot do
   * so, nothing happens.
   */
  void give_back_freed();

  /** Memory that a column takes at present [B]; all of it where the system does not say. */
  std::size_t resident_bytes(const base::Column &column);
} // namespace dem
