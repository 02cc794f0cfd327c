#pragma once

#include "dem/core/simd.h"

#include <cstddef>

/**
 * Stores past the caches. A written line is otherwise read from memory first and pushes another one out; where the next reader comes
 * so late that the line would be gone by then, both are lost time. The bits are the same.
 */
namespace dem
{
  /** Bytes of the largest cache that the first processor reaches; 32 MiB where the system does not report it. */
  std::size_t last_level_cache();

  /** Store a whole line past the caches. Other threads see it after finish_streaming(). */
  BRECCIA_KERNEL void stream(const Pack &values, double *to) { values.stream(to); }

  /** Store a line, past the caches or into them. */
  BRECCIA_KERNEL void put(const Pack &values, double *to, const bool streams)
  {
    if (streams)
      stream(values, to);
    else
      store(values, to);
  }

  /** Before the lines that a thread has streamed are read by another one. */
  BRECCIA_KERNEL void finish_streaming()
  {
#ifdef __SSE2__
    _mm_sfence();
#endif
  }
} // namespace dem
