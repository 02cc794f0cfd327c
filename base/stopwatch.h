#pragma once

#include <chrono>
#include <ctime>

namespace base
{
  /** Wall-clock time since it was made [s]. */
  class Stopwatch
  {
  public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }

  private:
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  };

  /** Of this process, all threads together, since it began [s]. */
  inline double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
} // namespace base
