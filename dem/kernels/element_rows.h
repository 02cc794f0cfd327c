#pragma once

#include "base/column.h"
#include "dem/core/simd.h"

#include <cstddef>

namespace dem
{
  /**
   * Further numbers that a link remembers, as many as its law's constants say (of each element of a joint, for instance): looked at
   * and written one by one, by a law that wants them. Of one link: a row of its history.
   */
  template <typename T>
  struct ElementRows
  {
    const double *from = nullptr;
    double       *to   = nullptr; ///< the same row, where it may be written

    double get(const int i) const { return from[i]; }
    void   put(const int i, const double value) const { to[i] = value; }
  };

  /** Of eight links side by side: columns of the history. */
  template <>
  struct ElementRows<Pack>
  {
    base::Column *column = nullptr; ///< the first of them
    std::size_t   link   = 0;       ///< the first of the eight

    BRECCIA_KERNEL Pack get(const int i) const { return load(column[i].data() + link); }
    BRECCIA_KERNEL void put(const int i, const Pack &values) const { store(values, column[i].data() + link); }
  };
} // namespace dem
