#pragma once

#include "coupling/participants/participant.h"

#include <algorithm>
#include <cmath>

namespace coupling
{
  /**
   * Take a participant through a window of time: equal steps that end on its end, and more of them from where the participant allows
   * only shorter ones. @param take a step of this length [s]
   */
  template <typename Step>
  void walk_window(const Participant &participant, const double window, const int steps, const Step &take)
  {
    constexpr double rounding = 1e-12;
    const double     end      = participant.time() + window;
    for (int left = steps; end - participant.time() > rounding * window; left = std::max(left - 1, 1))
      {
        const double rest = end - participant.time(), longest = participant.stable_step();
        const double needed = std::ceil(rest / longest * (1 - rounding));
        take(std::min(rest / std::max<double>(left, needed), longest));
      }
  }
} // namespace coupling
