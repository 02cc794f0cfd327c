#pragma once

namespace coupling
{
  /** A time in which both sides move on, and how many steps of either it holds: one at least of the two takes a single one. */
  struct WindowSteps
  {
    double window    = 0; ///< [s]
    int    particles = 1;
    int    solid     = 1;
  };
} // namespace coupling
