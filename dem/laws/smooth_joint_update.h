#pragma once

#include "dem/core/simd.h"
#include "dem/core/vector.h"
#include "dem/kernels/link_update_types.h"

/** The update of a smooth joint (doc/theory/smooth-joint.md). */
namespace dem::smooth_joint
{
  /** In reference lengths: stresses of smaller openings are rounding, and break nothing that has no strength. */
  constexpr double no_opening = 1e-12;

  /** Constants of a joint as an update takes them. */
  template <typename Number>
  struct Constants
  {
    Number normal, shear;    ///< k_n, k_s [Pa/m]
    Number friction;         ///< mu [-]
    Number dilation;         ///< tan psi [-]
    Number tensile_strength; ///< sigma_t [Pa]
    Number cohesion;         ///< c [Pa]
    Number bond_friction;    ///< growth of the bonded joint's shear strength with pressure [-]
    Number plane[3];         ///< N, unit normal of the joint, which stays as it is
  };

  /** Places of the history. */
  enum Numbers
  {
    mode,    ///< 0: bonded; 1: broken in tension, 2: in shear; 3: never bonded
    opening, ///< elastic [m]
    slid,    ///< length slid while closed [m]
    cosine,  ///< N . n when the link was made [-]: below zero for links whose first end is on the side that N points to
    slip,    ///< elastic, on the joint plane: three components [m]
    count = slip + 3
  };

  template <typename T, int m>
  using State = LinkState<T, m, count, 0, 0>;

  /** Vectors in global axes: of a link in the plane they have two components. */
  template <int m>
  constexpr int axes = m == 3 ? 3 : 2;

  /** A vector whose part along the link is given, and its part across (m components). */
  template <typename T, int m>
  BRECCIA_KERNEL Vec<T, axes<m>> joined(const Vec<T, axes<m>> &direction, const T &along, const Vec<T, m> &across)
  {
    if constexpr (m == 3)
      return multiply_add(along, direction, across);
    else
      return {{along * direction[0] - across[0] * direction[1], along * direction[1] + across[0] * direction[0]}};
  }

  /** The part of a vector across the link. @param along its part along it */
  template <int m, typename T>
  BRECCIA_KERNEL Vec<T, m> part_across(const Vec<T, axes<m>> &direction, const T &along, const Vec<T, axes<m>> &v)
  {
    if constexpr (m == 3)
      return negative_multiply_add(along, direction, v);
    else
      return {{direction[0] * v[1] - direction[1] * v[0]}};
  }

  /**
   * Displacement of the second end against the first in a step, in global axes. Its parts along and across the link are those of half
   * the step: what the ends slip past each other has turned the link by slip/length, and by half of that since.
   */
  template <typename T, int m>
  BRECCIA_KERNEL Vec<T, axes<m>> moved_in(const LinkMotion<T, m> &motion)
  {
    const T         longer      = motion.reference * (motion.strain - motion.strain_before);
    const Vec<T, m> slipped     = motion.reference * motion.shear_increment;
    const Vec<T, m> half_a_turn = (T(0.5) / motion.length) * slipped;
    return joined<T, m>(motion.direction, longer + dot(half_a_turn, slipped),
                        negative_multiply_add(longer, half_a_turn, slipped));
  }

  /** How a joint moved in a step. */
  template <typename T, int m>
  struct Movement
  {
    T               opened;      ///< its part along N [m]
    Vec<T, axes<m>> slip_before; ///< elastic [m]
    Vec<T, axes<m>> slip;        ///< elastic, at the end, if nothing slides [m]
  };

  /** Normal of the joint, from the side of the link's first end to that of the second. */
  template <typename K, typename T, int m>
  BRECCIA_KERNEL Vec<T, axes<m>> plane_normal(const K &k, const T &cosine_at_start)
  {
    const T         side = select(cosine_at_start < T(0.0), T(-1.0), T(1.0));
    Vec<T, axes<m>> N;
    for (int c = 0; c < axes<m>; ++c)
      N[c] = side * T(k.plane[c]);
    return N;
  }

  template <typename T, int m>
  BRECCIA_KERNEL Movement<T, m>
                 movement(const Vec<T, axes<m>> &N, const LinkMotion<T, m> &motion, const State<T, m> &state)
  {
    Movement<T, m> joint;
    for (int c = 0; c < axes<m>; ++c)
      joint.slip_before[c] = state.number[slip + c];
    const auto moved = moved_in(motion);
    joint.opened     = dot(N, moved);
    const auto trial = joint.slip_before + negative_multiply_add(joint.opened, N, moved);
    joint.slip       = negative_multiply_add(dot(N, trial), N, trial);
    return joint;
  }

  template <typename S>
  double slip_squared(const S &state)
  {
    double sum = 0;
    for (int c = 0; c < 3; ++c)
      sum += state.number[slip + c] * state.number[slip + c];
    return sum;
  }
  /** Energy stored in a unit of area [J/m^2]. */
  template <typename K, typename S>
  double stored(const K &k, const S &state)
  {
    const double opened = state.number[opening];
    const double strain = state.number[mode] > 0.5 && opened > 0 ? 0.0 : opened;
    return 0.5 * (k.normal * strain * strain + k.shear * slip_squared(state));
  }

  /**
   * Sliding of a joint without bond: the shear stress is held at mu times the pressure, which the dilation of the step raises (return to
   * Coulomb's cone along the plastic potential of the dilation angle; closed form, as both are linear).
   */
  template <typename K, typename T>
  BRECCIA_KERNEL T length_slid(const K &k, const T &normal, const T &shear)
  {
    return (shear + T(k.friction) * normal) / (T(k.shear) + T(k.friction) * T(k.dilation) * T(k.normal));
  }

  /** The joint at the end of a step in which it did not stay elastic. */
  template <typename T>
  struct Answered
  {
    T             pressed;        ///< normal stress [Pa]
    T             kept;           ///< part of the slip that stays elastic [-]
    Comparison<T> slides, breaks; ///< in this step
  };

  /**
   * Work of the mean of the stresses before and after the step, less what is stored more than before: dissipated by friction, or
   * released by the break. Of opening it counts where the joint dilates or breaks.
   */
  template <typename K, typename T, int m>
  BRECCIA_KERNEL void enter_loss(const K              &k,
                                 const T              &area,
                                 const Movement<T, m> &joint,
                                 const State<T, m>    &before,
                                 const Answered<T>    &after,
                                 LinkWork<T>          &work)
  {
    const T whole   = T(k.normal) * before.number[opening];
    const T was     = select(before.number[mode] < T(0.5), whole, minimum(whole, T(0.0)));
    const T sheared = T(0.5) * T(k.shear) * (T(1.0) - after.kept) *
                      dot(multiply_add(after.kept, joint.slip, joint.slip_before), joint.slip);
    const T pushed = T(0.5) * (was + after.pressed) * (joint.opened - (after.pressed - was) / T(k.normal));
    const T ground = sheared + select(after.pressed < T(0.0), pushed, T(0.0));
    work.friction += area * select(after.slides && !after.breaks, maximum(ground, T(0.0)), T(0.0));
    work.released += area * select(after.breaks, sheared + pushed, T(0.0));
  }

  template <typename K, typename T, int m>
  BRECCIA_KERNEL LinkForce<T, m>
                 update(const K &k, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
  {
    const auto           N      = plane_normal<K, T, m>(k, state.number[cosine]);
    const Movement<T, m> joint  = movement<T, m>(N, motion, state);
    const T              opened = state.number[opening] + joint.opened, normal = T(k.normal) * opened;
    const T              shear2   = T(k.shear) * T(k.shear) * dot(joint.slip, joint.slip);
    const T              least    = T(no_opening) * T(k.normal) * motion.reference;
    const T              strength = maximum(T(k.cohesion) - T(k.bond_friction) * normal, least);
    const auto           whole    = state.number[mode] < T(0.5);
    const auto           torn     = whole && normal >= maximum(T(k.tensile_strength), least);
    const auto           breaks   = torn || (whole && shear2 >= strength * strength);
    const auto           holds    = whole && !breaks;
    const T              carried  = select(holds, normal, minimum(normal, T(0.0)));
    const T              limit    = T(0.0) - T(k.friction) * carried;
    const auto           slides   = !holds && shear2 > limit * limit;

    T kept = T(1.0), closed = opened, pressed = carried;
    if (any(slides || breaks))
      {
        const T    shear   = square_root(select(slides, shear2, T(1.0)));
        const auto grinds  = slides && carried < T(0.0);
        const T    length  = select(grinds, length_slid(k, carried, shear), T(0.0));
        closed             = opened - T(k.dilation) * length;
        pressed            = select(grinds, T(k.normal) * closed, carried);
        kept               = select(slides, (T(0.0) - T(k.friction) * pressed) / shear, T(1.0));
        state.number[slid] = state.number[slid] + length;
        enter_loss<K, T, m>(k, motion.area, joint, state, {pressed, kept, slides, breaks}, work);
        state.number[mode] = select(breaks, select(torn, T(1.0), T(2.0)), state.number[mode]);
      }
    state.number[opening] = closed;
    const auto elastic    = kept * joint.slip;
    for (int c = 0; c < axes<m>; ++c)
      state.number[slip + c] = elastic[c];

    const auto      stress = multiply_add(pressed, N, T(k.shear) * elastic);
    const T         along  = dot(motion.direction, stress);
    LinkForce<T, m> answer;
    answer.normal = motion.area * along;
    answer.shear  = motion.area * part_across<m>(motion.direction, along, stress);
    answer.slides = slides && !breaks;
    answer.event  = breaks;
    return answer;
  }
} // namespace dem::smooth_joint
