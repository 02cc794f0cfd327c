#pragma once

#include "dem/laws/flat_joint_opening.h"

#include <cmath>

/** The update of flat joints, for one and for eight side by side; only the source in which they are compiled includes this. */
namespace dem
{
  /** Vectors across the link by their components along the axes of the elements. */
  template <typename T, int m>
  struct JointAxes;

  template <typename T>
  struct JointAxes<T, 3>
  {
    Vec<T, 3> first, second;

    template <typename S>
    BRECCIA_KERNEL JointAxes(const S &state, const Vec<T, 3> &direction)
      : first(state.axis[0])
      , second(cross(direction, state.axis[0]))
    {
    }
    /** Of slip, and of rotation about the axes. */
    BRECCIA_KERNEL Vec<T, 2> slip(const Vec<T, 3> &v) const { return {{dot(v, first), dot(v, second)}}; }
    BRECCIA_KERNEL Vec<T, 2> turn(const Vec<T, 3> &v) const { return slip(v); }
    BRECCIA_KERNEL Vec<T, 3> of_slip(const Vec<T, 2> &v) const { return v[0] * first + v[1] * second; }
    BRECCIA_KERNEL Vec<T, 3> of_turn(const Vec<T, 2> &v) const { return of_slip(v); }
  };

  /** In the plane axis 1 lies in it, and axis 2 is z. */
  template <typename T>
  struct JointAxes<T, 1>
  {
    template <typename S>
    BRECCIA_KERNEL JointAxes(const S &, const Vec<T, 2> &)
    {
    }
    BRECCIA_KERNEL Vec<T, 2> slip(const Vec<T, 1> &v) const { return {{v[0], T(0.0)}}; }
    BRECCIA_KERNEL Vec<T, 2> turn(const Vec<T, 1> &v) const { return {{T(0.0), v[0]}}; }
    BRECCIA_KERNEL Vec<T, 1> of_slip(const Vec<T, 2> &v) const { return {{v[0]}}; }
    BRECCIA_KERNEL Vec<T, 1> of_turn(const Vec<T, 2> &v) const { return {{v[1]}}; }
  };

  /** Of vectors along the axes; in the plane they have the first component only. */
  template <int m, typename T>
  BRECCIA_KERNEL T scalar(const Vec<T, 2> &a, const Vec<T, 2> &b)
  {
    if constexpr (m == 1)
      return a[0] * b[0];
    else
      return dot(a, b);
  }

  /** Sums over the elements: forces over modulus or stress, moments over R, and what the specimen needs. */
  template <typename T>
  struct JointSums
  {
    T             push{0.0}, moment_1{0.0}, moment_2{0.0}; ///< along the link, stresses
    Vec<T, 2>     shear{{T(0.0), T(0.0)}};
    T             twisting{0.0};
    T             released{0.0}, friction{0.0};            ///< per volume A L0
    T             bonded{0.0}, broken{0.0}, lowest{1e300}; ///< lowest: gap of all elements' ends
    Comparison<T> slides{false}, breaks{false};
  };

  /** Whether no element of a bonded joint can break in this step; never says so wrongly, and is exact in the plane. */
  template <typename K, typename T, int m, typename S>
  BRECCIA_KERNEL Comparison<T> joint_is_safe(const K &k, const T &opened, const T &per_radian, const S &state)
  {
    const auto magnitude = [](const T &v) { return maximum(v, T(0.0) - v); };
    T          bend, slip;
    if constexpr (m == 1)
      {
        bend = magnitude(state.number[FlatJoint::turn_2]);
        slip = magnitude(state.number[FlatJoint::slip_1]);
      }
    else
      {
        const Vec<T, 2> bent = joint_turn<m>(state), slid = joint_slip<m>(state);
        bend = square_root(dot(bent, bent));
        slip = square_root(dot(slid, slid));
      }
    const T rim  = T(k.layout->reach) * per_radian;
    const T most = T(k.joint_normal) * (opened + rim * bend);
    if constexpr (m == 3)
      slip = slip + rim * magnitude(state.number[FlatJoint::twist]);
    const T sliding = T(k.joint_shear) * slip;
    return most < T(k.tensile_strength) && sliding < T(k.cohesion) - most * T(k.tan_angle);
  }

  /** One element: breaks or holds, pushes and slides; its state and slip are stored where it is not bonded. */
  template <typename K, typename T, int m, typename S>
  BRECCIA_KERNEL void advance_element(const K                  &k,
                                      const int                 number,
                                      const JointOpening<T, m> &now,
                                      const JointOpening<T, m> &change,
                                      const Comparison<T>      &active,
                                      const S                  &state,
                                      JointSums<T>             &sums)
  {
    const FlatJointLayout          &layout = *k.layout;
    const FlatJointLayout::Element &e      = layout.elements[static_cast<std::size_t>(number)];
    const int                       row    = FlatJoint::elements + FlatJoint::row_width(m) * number;
    const T                         was    = state.rows.get(row);
    const auto                      bonded = active && was < T(0.5);
    const Vec<T, 2>                 moved = now.slip_at(e), added = change.slip_at(e);

    Vec<T, 2> trial, kept;
    kept[0]  = state.rows.get(row + 1);
    kept[1]  = m == 3 ? state.rows.get(row + 2) : T(0.0);
    trial[0] = select(bonded, moved[0], kept[0] + added[0]);
    trial[1] = m == 3 ? select(bonded, moved[1], kept[1] + added[1]) : T(0.0);

    const T    stiff = T(k.joint_normal), shear2 = T(k.joint_shear * k.joint_shear) * scalar<m>(trial, trial);
    const T    stress  = stiff * now.gap_at(e);
    const T    limit   = maximum(T(k.cohesion) - stress * T(k.tan_angle), T(0.0));
    const auto torn    = bonded && stress >= T(k.tensile_strength);
    const auto sheared = bonded && !torn && shear2 >= limit * limit;
    const auto breaks = torn || sheared, holds = bonded && !breaks, loose = active && !holds;

    const ElementPush<T> held = bonded_push(e, now), pushed = free_push(layout, e, now);
    const auto           of   = [&](const T &whole, const T &free) { return select(holds, whole, free); };
    const T              push = of(held.stress, pushed.stress);

    const T         cap    = T(0.0) - T(k.friction) * stiff * pushed.stress;
    const auto      slides = loose && shear2 > cap * cap;
    const T         size   = square_root(select(slides, shear2, T(1.0)));
    const T         keep   = select(slides, cap / size, T(1.0));
    const Vec<T, 2> slip   = keep * trial;

    const T share = select(active, T(e.share), T(0.0));
    sums.push     = sums.push + share * stiff * push;
    sums.moment_2 = sums.moment_2 + share * stiff * (of(held.moment_2, pushed.moment_2) - T(e.x1) * push);
    sums.shear[0] = sums.shear[0] + (share * T(k.joint_shear)) * slip[0];
    if constexpr (m == 3)
      {
        sums.moment_1 = sums.moment_1 + share * stiff * (T(e.x2) * push + of(held.moment_1, pushed.moment_1));
        sums.shear[1] = sums.shear[1] + (share * T(k.joint_shear)) * slip[1];
        sums.twisting = sums.twisting + share * T(k.joint_shear) * (T(e.x1) * slip[1] - T(e.x2) * slip[0]);
      }
    sums.bonded  = sums.bonded + select(holds, T(1.0), T(0.0));
    sums.slides  = sums.slides || slides;
    const T bend = T(layout.half_width) * maximum(now.b2, T(0.0) - now.b2);
    sums.lowest  = minimum(sums.lowest, now.gap_at(e) - bend);

    if (any(slides || breaks))
      {
        // Mean of the stresses before and after times what slipped; of second order in the step.
        const T done  = T(0.5 * k.joint_shear) * scalar<m>(trial - added + slip, trial - slip);
        sums.friction = sums.friction + share * select(breaks, T(0.0), maximum(done, T(0.0)));
        sums.released = sums.released + select(breaks, share * done, T(0.0));
      }
    if (any(breaks))
      {
        // Forces of before and after have each worked over half the step; the rest of what was stored is set free.
        const JointOpening<T, m> before = {now.gap - change.gap, now.b1 - change.b1, now.b2 - change.b2,
                                           now.slip - change.slip, now.twist - change.twist};
        const ElementPush<T>     had    = bonded_push(e, before);
        const T                  worked = (had.stress + pushed.stress) * change.gap_at(e) +
                         (had.moment_1 + pushed.moment_1) * change.b1 + (had.moment_2 + pushed.moment_2) * change.b2;
        sums.released =
          sums.released + select(breaks, share * stiff * (had.energy - pushed.energy + T(0.5) * worked), T(0.0));
        sums.broken = sums.broken + select(breaks, T(1.0), T(0.0));
        sums.breaks = sums.breaks || breaks;
        state.rows.put(row, select(breaks, select(torn, T(1.0), T(2.0)), was));
      }
    if (any(loose))
      {
        state.rows.put(row + 1, select(loose, slip[0], kept[0]));
        if constexpr (m == 3)
          state.rows.put(row + 2, select(loose, slip[1], kept[1]));
      }
  }

  /** What is stored in elements none of which is bonded, over A L0; their slips are those of the state. */
  template <typename K, typename T, int m, typename S>
  BRECCIA_KERNEL T stored_in_loose(const K &k, const JointOpening<T, m> &at, const S &state)
  {
    T sum(0.0);
    for (int number = 0; number < k.layout->size(); ++number)
      {
        const FlatJointLayout::Element &e    = k.layout->elements[static_cast<std::size_t>(number)];
        const int                       row  = FlatJoint::elements + FlatJoint::row_width(m) * number;
        const Vec<T, 2>                 slip = {{state.rows.get(row + 1), m == 3 ? state.rows.get(row + 2) : T(0.0)}};
        sum = sum + T(e.share) * (T(k.joint_normal) * free_push(*k.layout, e, at).energy +
                                  T(0.5) * T(k.joint_shear) * scalar<m>(slip, slip));
      }
    return sum;
  }

  /** What the parts of an update of joints that are not whole have in common. */
  template <typename T, int m>
  struct JointStep
  {
    T                  per;             ///< radius of the joint over the reference length
    Comparison<T>      contact, active; ///< a linear contact stands in its place; elements answer
    JointOpening<T, m> now, change;     ///< at the end of the step, and since its start

    template <typename S>
    BRECCIA_KERNEL JointStep(const LinkMotion<T, m> &motion, const JointAxes<T, m> &axes, const S &state)
      : per(state.number[FlatJoint::radius] * motion.inverse_reference)
      , contact(motion.area > T(0.0) && state.rows.get(FlatJoint::replaced) > T(0.5))
      , active(motion.area > T(0.0) && !contact)
      , now(opening_of<m>(state, motion.strain, per))
    {
      const Vec<T, 2> turning = axes.turn(motion.bending_increment);
      change                  = {motion.strain - motion.strain_before, per * turning[0], per * turning[1],
                                 axes.slip(motion.shear_increment), per * motion.twist_increment};
    }
  };

  template <typename T, int m>
  BRECCIA_KERNEL void
  put_where(const Comparison<T> &where, const T &normal, const Vec<T, m> &shear, LinkForce<T, m> &answer)
  {
    answer.normal = select(where, normal, answer.normal);
    for (int c = 0; c < m; ++c)
      answer.shear[c] = select(where, shear[c], answer.shear[c]);
  }

  /** What the elements sum up to, where not all are bonded. @param parted none is */
  template <typename K, typename T, int m, typename S>
  BRECCIA_KERNEL void put_sums(const K                &k,
                               const LinkMotion<T, m> &motion,
                               const JointAxes<T, m>  &axes,
                               const JointStep<T, m>  &step,
                               const JointSums<T>     &sums,
                               const Comparison<T>    &parted,
                               const S                &state,
                               LinkForce<T, m>        &answer)
  {
    using J                 = FlatJoint;
    const T         section = motion.area * T(k.area_factor), lever = section * state.number[J::radius];
    const auto      mine    = step.active && !(sums.bonded > T(k.layout->size() - 0.5));
    const Vec<T, m> bending = axes.of_turn(Vec<T, 2>{{lever * sums.moment_1, lever * sums.moment_2}});
    put_where(mine, section * sums.push, section * axes.of_slip(sums.shear), answer);
    for (int c = 0; c < m; ++c)
      answer.bending_moment[c] = select(step.contact, T(0.0), select(mine, bending[c], answer.bending_moment[c]));
    answer.twisting_moment = select(step.contact, T(0.0), select(mine, lever * sums.twisting, answer.twisting_moment));
    answer.slides          = mine && sums.slides;

    const auto opens = parted && sums.lowest >= T(0.0) && motion.strain > joint_reach<T>(state);
    answer.event     = (step.active && sums.breaks) || opens;
  }

  /** The linear contacts that stand in the place of joints: their elastic slip is that of the first element. */
  template <typename K, typename T, int m, typename S>
  BRECCIA_KERNEL void advance_contacts(const K                &k,
                                       const LinkMotion<T, m> &motion,
                                       const JointAxes<T, m>  &axes,
                                       const JointStep<T, m>  &step,
                                       const S                &state,
                                       LinkWork<T>            &work,
                                       LinkForce<T, m>        &answer)
  {
    const int       first  = FlatJoint::elements + 1;
    const Vec<T, 2> before = {{state.rows.get(first), m == 3 ? state.rows.get(first + 1) : T(0.0)}};
    Vec<T, 2>       slip   = before + step.change.slip;
    LinkWork<T>     done;
    const auto      force =
      linear_contact_force(k, step.now.gap, motion.area, motion.reference, step.change.slip, slip, done);
    put_where(step.contact, force.normal, axes.of_slip(force.shear), answer);
    work.friction += select(step.contact, done.friction, T(0.0));
    answer.slides = answer.slides || (step.contact && force.slides);
    answer.event  = answer.event || (step.contact && motion.strain > joint_reach<T>(state));
    state.rows.put(first, select(step.contact, slip[0], before[0]));
    if constexpr (m == 3)
      state.rows.put(first + 1, select(step.contact, slip[1], before[1]));
  }

  /**
   * Slid over their length: linear contacts as stiff as the joints take over, with the force that they find. Of a joint that is open, or
   * closed without a rotation, the distance at which it was made stays; of one that is closed in part the distance moves to where it has
   * no force. What is stored cannot grow: the contact stores the square of the mean stress, the elements the mean of its squares.
   */
  template <typename K, typename T, int m, typename S>
  BRECCIA_KERNEL void replace_joints(const K                &k,
                                     const LinkMotion<T, m> &motion,
                                     const JointStep<T, m>  &step,
                                     const JointSums<T>     &sums,
                                     const Comparison<T>    &slid,
                                     S                      &state,
                                     LinkWork<T>            &work)
  {
    using J                = FlatJoint;
    const int       first  = J::elements + 1;
    const T         volume = motion.area * motion.reference;
    const T         normal = T(k.area_factor) * sums.push / T(k.normal);
    const Vec<T, 2> slip   = (T(k.area_factor) / T(k.shear)) * sums.shear;
    const T         kept   = T(0.5) * volume * (T(k.normal) * normal * normal + T(k.shear) * dot(slip, slip));
    const T         had    = motion.area * T(k.area_factor) * motion.reference * stored_in_loose(k, step.now, state);
    work.released += select(slid, had - kept, T(0.0));
    // Without a force, a distance found from it would be wherever the particles happen to be.
    state.number[J::installed] = select(slid && normal < T(0.0), motion.strain - normal, state.number[J::installed]);
    state.rows.put(J::replaced, select(slid, T(1.0), state.rows.get(J::replaced)));
    state.rows.put(first, select(slid, slip[0], state.rows.get(first)));
    if constexpr (m == 3)
      state.rows.put(first + 1, select(slid, slip[1], state.rows.get(first + 1)));
  }

  /**
   * Joints of which at least one is not bonded throughout, or may break. Those among them that are take the answer of a bonded one: so
   * the answer of a joint does not depend on its neighbours in the list.
   */
  template <typename K, typename T, int m, typename S>
  BRECCIA_BRANCH void advance_elements(const K                &k,
                                       const LinkMotion<T, m> &motion,
                                       const JointAxes<T, m>  &axes,
                                       S                      &state,
                                       LinkWork<T>            &work,
                                       LinkForce<T, m>        &answer)
  {
    using J = FlatJoint;
    const JointStep<T, m> step(motion, axes, state);
    JointSums<T>          sums;
    for (int e = 0; e < k.layout->size(); ++e)
      advance_element(k, e, step.now, step.change, step.active, state, sums);

    const T volume = motion.area * T(k.area_factor) * motion.reference;
    work.friction += select(step.active, volume * sums.friction, T(0.0));
    work.released += select(step.active, volume * sums.released, T(0.0));
    state.number[J::bonded] = select(step.active, sums.bonded, state.number[J::bonded]);
    if (any(sums.breaks))
      state.rows.put(J::broken, state.rows.get(J::broken) + sums.broken);
    const auto parted = step.active && sums.bonded < T(0.5);
    put_sums(k, motion, axes, step, sums, parted, state, answer);
    if (any(step.contact))
      advance_contacts(k, motion, axes, step, state, work, answer);

    const Vec<T, 2> &slip = step.now.slip;
    const auto       slid = parted && dot(slip, slip) > T(4.0) * step.per * step.per;
    if (any(slid))
      replace_joints(k, motion, step, sums, slid, state, work);
  }

  template <typename K, typename T, int m>
  BRECCIA_KERNEL LinkForce<T, m>
                 FlatJoint::update(const K &k, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
  {
    if constexpr (m == 3)
      state.number[twist] = state.number[twist] + motion.twist_increment;
    const JointAxes<T, m> axes(state, motion.direction);
    add_to_joint<m>(state, axes.slip(motion.shear_increment), axes.turn(motion.bending_increment));
    const T opened     = motion.strain - state.number[installed];
    const T per_radian = state.number[radius] * motion.inverse_reference;
    const T section    = motion.area * (state.number[radius] * per_radian);

    LinkForce<T, m> answer;
    answer.normal          = (motion.area * T(k.area_factor)) * (T(k.joint_normal) * opened);
    answer.shear           = (motion.area * T(k.area_factor * k.joint_shear)) * axes.of_slip(joint_slip<m>(state));
    answer.bending_moment  = (section * T(k.bending_modulus)) * axes.of_turn(joint_turn<m>(state));
    answer.twisting_moment = m == 3 ? (section * T(k.twisting_modulus)) * state.number[twist] : T(0.0);
    answer.slides = answer.event = Comparison<T>(false);

    const auto bonded_throughout = state.number[bonded] > T(k.layout->size() - 0.5);
    const auto exists            = motion.area > T(0.0);
    const auto safe              = bonded_throughout && joint_is_safe<K, T, m>(k, opened, per_radian, state);
    if (any(exists && !safe))
      advance_elements(k, motion, axes, state, work, answer);
    return answer;
  }
} // namespace dem
