#pragma once

#include <functional>

namespace performance
{
  /**
   * Instructions that some work takes on one thread, counted one by one in a copy of this process: the same on a busy machine, in a
   * virtual one without counters, and for instructions that no emulator knows. Slow: a microsecond or more for each.
   * @return 0 where the system does not let a process trace its child
   */
  double instructions_of(const std::function<void()> &work);
} // namespace performance
