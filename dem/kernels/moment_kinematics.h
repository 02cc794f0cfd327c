#pragma once

#include "dem/kernels/kinematics.h"

namespace dem
{
  /** Motion of a pair over one step, what a link with moments needs. */
  template <typename T>
  struct MomentPairMotion
  {
    Vec<T, 3> branch;       ///< l1 = x_K - x_J at the end of the step [m]
    Vec<T, 3> increment;    ///< l1 - l0 [m]
    Vec<T, 3> arm_rotation; ///< (d_J/L) tau_J theta_J + (d_K/L) tau_K theta_K
    Vec<T, 3> spin;         ///< half the sum of tau theta of both ends
    Vec<T, 3> turned;       ///< theta_K - theta_J
  };

  /**
   * A link with moments in one step: what carries its vectors, each across the link, from the start to the end, exactly objective
   * (doc/theory/shear-kinematics.md, 4).
   *
   * Rotation of the pair = turn about n0 by the angle whose half has the tangent (spin . n)/2, then the smallest rotation n0 -> n1; the
   * one and the other without trigonometric functions, and with one division for both. The smallest rotation of a vector across n0 is
   * the projection onto the plane across n1 along n0 + n1. It takes out what a displacement or a rotation of the step, measured at its
   * middle, has along the link, and what rounding has left there.
   */
  template <typename T>
  class TurningLink
  {
  public:
    Vec<T, 3> direction;     ///< n1, from the first end to the second
    T         length;        ///< at the end of the step [m]
    T         length_before; ///< at its start [m]
    Vec<T, 3> slip;          ///< displacement of the contact point in the step over the reference length, any direction

    /** @param inverse_reference 1/L0 [1/m] */
    BRECCIA_KERNEL TurningLink(const MomentPairMotion<T> &m, const T &inverse_reference)
    {
      const Vec<T, 3> before = m.branch - m.increment, middle = negative_multiply_add(T(0.5), m.increment, m.branch);
      length                  = square_root(dot(m.branch, m.branch));
      length_before           = square_root(dot(before, before));
      const T         lengths = T(1.0) / (length * length_before);
      const Vec<T, 3> n0      = (lengths * length) * before;
      direction               = (lengths * length_before) * m.branch;
      sum                     = n0 + direction;
      const T along           = T(1.0) + dot(n0, direction);
      const T half_tangent    = T(0.25) * dot(m.spin, sum);
      const T squares         = multiply_add(half_tangent, half_tangent, T(1.0));
      const T both            = T(1.0) / (along * squares);
      inverse_along           = both * squares;
      const T sine            = T(2.0) * half_tangent * (both * along);
      cosine                  = negative_multiply_add(half_tangent, sine, T(1.0));
      axis                    = sine * n0;
      slip                    = inverse_reference * (m.increment - cross(m.arm_rotation, middle));
    }

    /** A vector across the link, turned with the pair, and what the step adds to it (any direction). */
    BRECCIA_KERNEL Vec<T, 3> carried(const Vec<T, 3> &vector, const Vec<T, 3> &added) const
    {
      return across(multiply_add(cosine, vector, cross(axis, vector)) + added);
    }

    /** A vector across the link, turned with the pair. */
    BRECCIA_KERNEL Vec<T, 3> turned(const Vec<T, 3> &vector) const
    {
      return across(multiply_add(cosine, vector, cross(axis, vector)));
    }

    /** What of a displacement or rotation at the middle of the step lies across the link, carried to the end. */
    BRECCIA_KERNEL Vec<T, 3> across(const Vec<T, 3> &v) const
    {
      return negative_multiply_add(inverse_along * dot(direction, v), sum, v);
    }
    /** And along it. */
    BRECCIA_KERNEL T along(const Vec<T, 3> &v) const { return inverse_along * dot(sum, v); }

  private:
    Vec<T, 3> sum;           ///< n0 + n1
    Vec<T, 3> axis;          ///< sine of the turn about the link times n0
    T         cosine;        ///< of the turn about the link
    T         inverse_along; ///< 1/(1 + n0.n1)
  };
} // namespace dem
