#include "dem/core/kernel_vectors.h"

#include "dem/core/vector_width.h"

namespace dem
{
  int bytes_of_kernel_vectors() { return vector_bytes; }
} // namespace dem
