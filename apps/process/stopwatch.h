#pragma once

#include <chrono>

namespace apps
{
  /** Wall-clock time since it was made [s]. */
  class Stopwatch
  {
  public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }

  private:
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  };
} // namespace apps
