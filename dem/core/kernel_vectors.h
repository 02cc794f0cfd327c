#pragma once

namespace dem
{
  /** Bytes of the vectors that the kernels in use are compiled for: 64, 32 or 16. Of several libraries the loader takes one. */
  int bytes_of_kernel_vectors();
} // namespace dem
