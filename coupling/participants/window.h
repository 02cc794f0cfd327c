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
    double           rest     = window; // not a difference of times, which would round it
    for (int left = steps; rest > rounding * window; left = std::max(left - 1, 1))
      {
        const double longest = participant.stable_step();
        const double needed  = std::ceil(rest / longest * (1 - rounding));
        const double step    = std::min(rest / std::max<double>(left, needed), longest);
        take(step);
        rest -= step;
      }
  }
} // namespace coupling
