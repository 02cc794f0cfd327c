#pragma once

#include <cfenv>

namespace dem
{
  /**
   * In builds with BRECCIA_TRAP_FPE (preset `audit`), an invalid operation, a division by zero or an
   * overflow from here on raises SIGFPE at the instruction that did it; in other builds this does nothing.
   *
   * Call it first thing in `main`, before threads start: they inherit the setting.
   */
  inline void enable_floating_point_traps()
  {
#ifdef BRECCIA_TRAP_FPE
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW); // glibc; not in the C++ standard
#endif
  }
} // namespace dem
