#pragma once

#include "dem/core/simd.h"
#include "dem/core/vector.h"

#include <cmath>

namespace dem
{
  /** sin(t)/t and (1 - cos t)/t^2 of a rotation angle t, given t^2: the two coefficients of Rodrigues' formula. */
  template <typename T>
  struct RotationCoefficients
  {
    T sine, versine;
  };

  /** Rotations up to 0.01 rad in a step (hardly ever exceeded) take a short series; beyond, the functions themselves. */
  constexpr double series_angle_squared = 1e-4;

  inline RotationCoefficients<double> exact_rotation_coefficients(const double angle_squared)
  {
    const double angle = std::sqrt(angle_squared), half_sine = std::sin(0.5 * angle);
    return {std::sin(angle) / angle, 2.0 * half_sine * half_sine / angle_squared};
  }

  /** Put the exact coefficients where the angle is too large for the series. */
  template <typename T>
  BRECCIA_RARE void replace_large_rotations(const T &angle_squared, RotationCoefficients<T> &c)
  {
    const auto large = angle_squared > T(series_angle_squared);
    const T    safe  = select(large, angle_squared, T(1.0));
    c.sine = select(large, each_lane(safe, [](const double a) { return exact_rotation_coefficients(a).sine; }), c.sine);
    c.versine =
      select(large, each_lane(safe, [](const double a) { return exact_rotation_coefficients(a).versine; }), c.versine);
  }

  /** Taylor series to t^6, remainder below 1e-21 for angles of the series; larger angles, lane by lane, the exact functions. */
  template <typename T>
  BRECCIA_KERNEL RotationCoefficients<T> rotation_coefficients(const T &angle_squared)
  {
    const T   &s      = angle_squared;
    const auto series = [&](const double c0, const double c1, const double c2, const double c3) {
      const T inner = negative_multiply_add(s, T(c3), T(c2));
      return negative_multiply_add(s, negative_multiply_add(s, inner, T(c1)), T(c0));
    };
    RotationCoefficients<T> c{series(1.0, 1.0 / 6, 1.0 / 120, 1.0 / 5040),
                              series(0.5, 1.0 / 24, 1.0 / 720, 1.0 / 40320)};
    if (any(s > T(series_angle_squared)))
      replace_large_rotations(s, c);
    return c;
  }

  /**
 * tan(t/2)/(t/2): the factor by which a rotation vector is stretched so that its cross product with the half-step branch gives
 * the displacement of a rigid rotation exactly (Hughes and Winget, 1980).
 */
  template <typename T>
  BRECCIA_KERNEL T half_tangent_factor(const RotationCoefficients<T> &c, const T &angle_squared)
  {
    return c.sine / (T(1.0) - T(0.5) * angle_squared * c.versine);
  }

  /** Rotate v by the rotation vector t (Rodrigues): v + a t x v + b t x (t x v). */
  template <typename T>
  BRECCIA_KERNEL Vec<T, 3> rotate(const RotationCoefficients<T> &c, const Vec<T, 3> &t, const Vec<T, 3> &v)
  {
    const Vec<T, 3> once = cross(t, v);
    return multiply_add(c.versine, cross(t, once), multiply_add(c.sine, once, v));
  }

  /** Inverses of two numbers by one division, which takes a processor as long as many products. */
  template <typename T>
  struct Inverses
  {
    T first, second;

    BRECCIA_KERNEL Inverses(const T &a, const T &b)
    {
      const T both = T(1.0) / (a * b);
      first        = both * b;
      second       = both * a;
    }
  };

  /**
 * Carry v, perpendicular to the unit vector a, by the smallest rotation that takes a to the unit vector b.
 *
 * For v.a = 0 the minimal rotation Q(a -> b) v = v - (a + b) (b.v)/(1 + a.b). @pre a != -b
 * @param inverse 1/(1 + a.b)
 */
  template <typename T>
  BRECCIA_KERNEL Vec<T, 3> transport(const Vec<T, 3> &a, const Vec<T, 3> &b, const T &inverse, const Vec<T, 3> &v)
  {
    return negative_multiply_add(dot(b, v) * inverse, a + b, v);
  }

  template <typename T>
  BRECCIA_KERNEL Vec<T, 3> transport(const Vec<T, 3> &a, const Vec<T, 3> &b, const Vec<T, 3> &v)
  {
    return transport(a, b, T(1.0) / (T(1.0) + dot(a, b)), v);
  }

  /** What rounding leaves of a vector along a unit direction is taken out. */
  template <typename T>
  BRECCIA_KERNEL Vec<T, 3> across(const Vec<T, 3> &direction, const Vec<T, 3> &v)
  {
    return negative_multiply_add(dot(direction, v), direction, v);
  }

  /** A tangential vector at n0, carried to n1, and what the step adds to it there. @param inverse 1/(1 + n0.n1) */
  template <typename T>
  BRECCIA_KERNEL Vec<T, 3>
  carried(const Vec<T, 3> &n0, const Vec<T, 3> &n1, const T &inverse, const Vec<T, 3> &vector, const Vec<T, 3> &added)
  {
    return across(n1, transport(n0, n1, inverse, vector) + added);
  }

  /** Motion of a pair of particles over one step, what the shear update needs. */
  template <typename T>
  struct PairMotion
  {
    Vec<T, 3> branch;        ///< l1 = x_K - x_J at the end of the step [m]
    Vec<T, 3> increment;     ///< l1 - l0 [m]
    Vec<T, 3> mean_rotation; ///< half the sum of the two rotation vectors of the step
    Vec<T, 3> arm_rotation;  ///< (d_J/L) tau_J theta_J + (d_K/L) tau_K theta_K
  };

  /** Unit directions and length of a link at the end of the step. */
  template <typename T>
  struct LinkFrame
  {
    Vec<T, 3> direction;     ///< n1, from the first end to the second
    T         length;        ///< [m]
    Vec<T, 3> increment;     ///< of the shear vectors in this step, added after they were turned
    T         length_before; ///< at the start of the step [m]
  };

  /**
 * Advance tangential link vectors by one step, exactly objective (doc/theory/shear-kinematics.md, 1).
 *
 * Rotates each vector of `shear` with the pair and adds the tangential displacement of the contact point over the reference
 * length. Under any rigid motion of the pair the stored vectors turn with it and nothing is added, whatever the size of the step.
 *
 * @param inverse_reference 1/L0 [1/m]
 * @param shear  in: at the start of the step, perpendicular to n0; out: at its end, perpendicular to n1
 * @tparam rotations the particles spin; otherwise rotation vectors are not looked at
 */
  template <bool rotations, typename T, int stored>
  BRECCIA_KERNEL LinkFrame<T>
                 advance_shear(const PairMotion<T> &m, const T &inverse_reference, Vec<T, 3> (&shear)[stored])
  {
    const Vec<T, 3> l0 = m.branch - m.increment;
    const Vec<T, 3> lm = negative_multiply_add(T(0.5), m.increment, m.branch);
    const T L0 = square_root(dot(l0, l0)), Lm = square_root(dot(lm, lm)), L1 = square_root(dot(m.branch, m.branch));
    const Inverses<T> inverse(L0 * L1, Lm);
    const Vec<T, 3>   n1 = (inverse.first * L0) * m.branch, nm = inverse.second * lm;
    Vec<T, 3>         n0 = (inverse.first * L1) * l0;
    Vec<T, 3>         du = m.increment;
    if constexpr (rotations)
      du = du - cross(m.arm_rotation, lm);
    du = across(nm, du);
    if constexpr (rotations)
      {
        const auto c = rotation_coefficients(dot(m.mean_rotation, m.mean_rotation));
        n0           = rotate(c, m.mean_rotation, n0);
        for (auto &vector : shear)
          vector = rotate(c, m.mean_rotation, vector);
      }
    const Inverses<T> along(T(1.0) + dot(n0, n1), T(1.0) + dot(nm, n1));
    const auto        added = inverse_reference * transport(nm, n1, along.second, du);
    for (auto &vector : shear)
      vector = carried(n0, n1, along.first, vector, added);
    return {n1, L1, added, L0};
  }

  /**
 * Advance shear vectors by the first-order update in common use, with radii as arms (doc/theory/shear-kinematics.md, 3): only to
 * compare with programs that do so. A rigid rotation leaves shear behind, and vectors drift off the plane across the link.
 *
 * @param arm_ratio (r_J + r_K)/L
 * @pre arm_rotation of the motion is (r_J theta_J + r_K theta_K)/(r_J + r_K)
 */
  template <typename T, int stored>
  BRECCIA_KERNEL LinkFrame<T> advance_shear_first_order(const PairMotion<T> &m,
                                                        const T             &arm_ratio,
                                                        const T             &inverse_reference,
                                                        Vec<T, 3> (&shear)[stored])
  {
    const Vec<T, 3> l0 = m.branch - m.increment;
    const T         L0 = square_root(dot(l0, l0)), L1 = square_root(dot(m.branch, m.branch));
    const Vec<T, 3> n0 = (T(1.0) / L0) * l0, n1 = (T(1.0) / L1) * m.branch;
    const Vec<T, 3> turn  = cross(n0, n1) + dot(n0, m.mean_rotation) * n0;
    const Vec<T, 3> du    = arm_ratio * (m.increment - cross(m.arm_rotation, m.branch));
    const Vec<T, 3> added = inverse_reference * (du - dot(n1, du) * n1);
    for (auto &vector : shear)
      vector = vector - cross(vector, turn) + added;
    return {n1, L1, added, L0};
  }

  /** Motion of a pair of discs over one step. */
  template <typename T>
  struct PlanePairMotion
  {
    Vec<T, 2> branch;       ///< l1 = x_K - x_J at the end of the step [m]
    Vec<T, 2> increment;    ///< l1 - l0 [m]
    T         arm_rotation; ///< (d_J/L) tau_J theta_J + (d_K/L) tau_K theta_K
  };

  template <typename T>
  struct PlaneLinkFrame
  {
    Vec<T, 2> direction;
    T         length;
    Vec<T, 1> increment;
    T         length_before;
  };

  /** The same in the plane: shear is a number, positive along the direction turned by +90 degrees, and turns with the pair by itself. */
  template <bool rotations, typename T, int stored>
  BRECCIA_KERNEL PlaneLinkFrame<T>
                 advance_shear(const PlanePairMotion<T> &m, const T &inverse_reference, Vec<T, 1> (&shear)[stored])
  {
    const Vec<T, 2>   lm = negative_multiply_add(T(0.5), m.increment, m.branch);
    const T           L1 = square_root(dot(m.branch, m.branch)), Lm = square_root(dot(lm, lm));
    const Inverses<T> inverse(L1, Lm);
    T                 slip = multiply_subtract(lm.c[0], m.increment.c[1], lm.c[1] * m.increment.c[0]) * inverse.second;
    if constexpr (rotations)
      slip = negative_multiply_add(m.arm_rotation, Lm, slip);
    const Vec<T, 1> added{{inverse_reference * slip}};
    for (auto &value : shear)
      value = value + added;
    const Vec<T, 2> l0 = m.branch - m.increment;
    return {inverse.first * m.branch, L1, added, square_root(dot(l0, l0))};
  }
} // namespace dem
