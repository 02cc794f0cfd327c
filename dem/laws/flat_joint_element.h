#pragma once

#include "dem/core/simd.h"

namespace dem
{
  /** What an element of a flat joint answers along the link, over its modulus and its area: stress, and moments about its centroid. */
  template <typename T>
  struct ElementPush
  {
    T stress;             ///< tension positive
    T moment_1, moment_2; ///< over R, against the bends b1, b2
    T energy;             ///< stored
  };

  /**
   * A bonded element: linear in the gap at its centroid and in the bends.
   *
   * @param gap    at the centroid, over the reference length of the link
   * @param b1, b2 change of the gap over one radius, of the bending about axis 1 and 2: gap(x) = g + b1 x2 - b2 x1
   * @param own    second moment about the centroid, over A R^2
   */
  template <typename T>
  BRECCIA_KERNEL ElementPush<T> bonded_element(const T &gap, const T &b1, const T &b2, const T &own)
  {
    return {gap, own * b1, own * b2, T(0.5) * (gap * gap + own * (b1 * b1 + b2 * b2))};
  }

  /** An unbonded element of a disk: closed or open as its centroid is. */
  template <typename T>
  BRECCIA_KERNEL ElementPush<T> free_element(const T &gap)
  {
    const T closed = minimum(gap, T(0.0));
    return {closed, T(0.0), T(0.0), T(0.5) * closed * closed};
  }

  /**
   * An unbonded element of a segment: the part of it that is closed pushes, with the linear stress of the gap. Its force and moment
   * derive from the energy, also where the end of the closed part moves through it.
   */
  template <typename T>
  BRECCIA_KERNEL ElementPush<T> free_segment_element(const T &gap, const T &b2, const T &half_width)
  {
    const T    bend = half_width * maximum(b2, T(0.0) - b2);
    const T    low = gap - bend, high = gap + bend; // at the ends
    const auto mixed  = low < T(0.0) && high > T(0.0);
    const T    part   = select(mixed, (T(0.0) - low) / (T(2.0) * select(mixed, bend, T(1.0))), T(0.0)); // closed, of it
    const T    push   = T(0.5) * low * part;
    const T    lever  = half_width * (T(1.0) - T(2.0 / 3) * part);
    const T    side   = select(b2 > T(0.0), T(-1.0), T(1.0));
    const auto closed = high <= T(0.0);
    const T    own    = half_width * half_width * T(1.0 / 3);
    ElementPush<T> answer;
    answer.stress   = select(closed, gap, push);
    answer.moment_1 = T(0.0);
    answer.moment_2 = select(closed, own * b2, side * push * lever);
    answer.energy   = select(closed, T(0.5) * (gap * gap + own * b2 * b2), T(1.0 / 6) * low * low * part);
    return answer;
  }
} // namespace dem
