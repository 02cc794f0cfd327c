#pragma once

#include "dem/laws/flat_joint.h"

#include <type_traits>

namespace dem
{
  /** Slip of a joint's middle along its axes, over the reference length. @tparam m see FlatJoint::State */
  template <int m, typename S>
  BRECCIA_KERNEL auto joint_slip(const S &state)
  {
    using T = std::decay_t<decltype(state.number[0])>;
    if constexpr (m == 3)
      return Vec<T, 2>{{state.number[FlatJoint::slip_1], state.number[FlatJoint::slip_2]}};
    else
      return Vec<T, 2>{{state.number[FlatJoint::slip_1], T(0.0)}};
  }

  /** Its relative rotation about the axes [rad]. */
  template <int m, typename S>
  BRECCIA_KERNEL auto joint_turn(const S &state)
  {
    using T = std::decay_t<decltype(state.number[0])>;
    if constexpr (m == 3)
      return Vec<T, 2>{{state.number[FlatJoint::turn_1], state.number[FlatJoint::turn_2]}};
    else
      return Vec<T, 2>{{T(0.0), state.number[FlatJoint::turn_2]}};
  }

  template <int m, typename S, typename T>
  BRECCIA_KERNEL void add_to_joint(S &state, const Vec<T, 2> &slip, const Vec<T, 2> &turn)
  {
    state.number[FlatJoint::slip_1] = state.number[FlatJoint::slip_1] + slip[0];
    state.number[FlatJoint::turn_2] = state.number[FlatJoint::turn_2] + turn[1];
    if constexpr (m == 3)
      {
        state.number[FlatJoint::slip_2] = state.number[FlatJoint::slip_2] + slip[1];
        state.number[FlatJoint::turn_1] = state.number[FlatJoint::turn_1] + turn[0];
      }
  }

  /** Strain beyond which particles whose joint holds nothing are apart: that at which it was made, or beyond touching. */
  template <typename T, typename S>
  BRECCIA_KERNEL T joint_reach(const S &state)
  {
    return maximum(state.number[FlatJoint::installed] + state.rows.get(FlatJoint::initial_gap), T(0.0));
  }

  /**
   * Where a joint stands: gap in its middle and turns over the radius, as changes of gap over the reference length (doc/theory/flat-joint.md, 3).
   * @tparam m see FlatJoint::State; in the plane all that is about axis 1 or along axis 2 is zero, and ignored
   */
  template <typename T, int m>
  struct JointOpening
  {
    T         gap, b1, b2; ///< of the middle; per radius along axis 2 and against axis 1
    Vec<T, 2> slip;        ///< of the middle
    T         twist;       ///< per radius

    BRECCIA_KERNEL T gap_at(const FlatJointLayout::Element &e) const
    {
      if constexpr (m == 1)
        return gap - T(e.x1) * b2;
      else
        return gap + T(e.x2) * b1 - T(e.x1) * b2;
    }
    BRECCIA_KERNEL Vec<T, 2> slip_at(const FlatJointLayout::Element &e) const
    {
      if constexpr (m == 1)
        return slip;
      else
        return {{slip[0] - T(e.x2) * twist, slip[1] + T(e.x1) * twist}};
    }
  };

  /** @param per_radian radius of the joint over the reference length */
  template <int m, typename S, typename T>
  BRECCIA_KERNEL JointOpening<T, m> opening_of(const S &state, const T &strain, const T &per_radian)
  {
    const Vec<T, 2> turn  = joint_turn<m>(state);
    const T         twist = m == 3 ? per_radian * state.number[FlatJoint::twist] : T(0.0);
    return {strain - state.number[FlatJoint::installed], per_radian * turn[0], per_radian * turn[1],
            joint_slip<m>(state), twist};
  }

  /** What an element that is not bonded answers along the link. */
  template <typename T, int m>
  BRECCIA_KERNEL ElementPush<T>
  free_push(const FlatJointLayout &layout, const FlatJointLayout::Element &e, const JointOpening<T, m> &at)
  {
    return layout.half_width > 0 ? free_segment_element(at.gap_at(e), at.b2, T(layout.half_width)) :
                                   free_element(at.gap_at(e));
  }
  template <typename T, int m>
  BRECCIA_KERNEL ElementPush<T> bonded_push(const FlatJointLayout::Element &e, const JointOpening<T, m> &at)
  {
    return bonded_element(at.gap_at(e), at.b1, at.b2, T(e.own));
  }

} // namespace dem
