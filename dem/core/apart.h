#pragma once

#include "dem/core/inline.h"

namespace dem
{
  /**
   * The same pointer, of which the compiler does not know that it is. Places that only one side of a branch needs it would otherwise
   * reckon before the branch, for both sides and one by one, as the other side has some like them.
   */
  template <typename T>
  BRECCIA_KERNEL T *apart(T *pointer)
  {
    __asm__("" : "+r"(pointer));
    return pointer;
  }
} // namespace dem
