#pragma once

#include "dem/core/simd.h"
#include "dem/core/vector.h"

/**
 * What passes between the link kernel and a law in one update: eight links side by side (T = Pack), or one (T = double).
 *
 * Vectors across the link have m components: three in space (global axes, perpendicular to the link), one in the plane (along the
 * direction turned by +90 degrees; moments about z).
 */
namespace dem
{
  /** How a link moved, in its own frame at the end of the step. */
  template <typename T, int m>
  struct LinkMotion
  {
    T         strain;            ///< (length - reference) / reference
    T         strain_before;     ///< the same at the start of the step
    T         length;            ///< distance of the centres [m]
    T         reference;         ///< L0 [m]
    T         inverse_reference; ///< 1/L0 [1/m]
    T         area;              ///< A [m^2]
    T         per_second; ///< one over the length of the step, zero where no time passes [1/s]; of viscous laws only
    Vec<T, m> shear_increment; ///< tangential displacement of this step at the contact point, over the reference length
    Vec<T, m> bending_increment;      ///< relative rotation across the link of this step [rad]; moments only
    Vec<T, m == 3 ? 3 : 2> direction; ///< n, of laws with axes in space, and of directed ones
    T twist_increment; ///< relative rotation about the link of this step, second less first [rad]; moments only
  };

  /**
   * History of a link: numbers; shears (tangential strains, to which the kernel has added the step's increment); bendings (relative
   * rotations across the link [rad], likewise); axes (directions across the link, which turn with the pair). What a law remembers
   * beyond that goes into numbers.
   */
  template <typename T, int m, int numbers_, int shears_, int bendings_, int axes_ = 0>
  struct LinkState
  {
    static constexpr int numbers = numbers_, shears = shears_, bendings = bendings_, axes = axes_;
    static constexpr int columns = numbers + m * (shears + bendings + axes);

    T         number[numbers > 0 ? numbers : 1];
    Vec<T, m> shear[shears > 0 ? shears : 1];
    Vec<T, m> bending[bendings > 0 ? bendings : 1];
    Vec<T, m> axis[axes > 0 ? axes : 1];
  };

  /** What a link answers: on its first end, at the contact point; the second end gets the opposite. */
  template <typename T, int m>
  struct LinkForce
  {
    T             normal;         ///< [N], tension positive
    Vec<T, m>     shear;          ///< [N]
    Vec<T, m>     bending_moment; ///< [N m]; of laws with a moment only
    T             twisting_moment;
    Comparison<T> slides; ///< the shear force was returned to the strength
    Comparison<T> event;  ///< the link broke in this update, or is gone: the specimen looks at it
  };

  /** What updates dissipate and set free [J], summed over links. */
  template <typename T>
  struct LinkWork
  {
    T friction{0.0}; ///< dissipated by sliding
    T damage{0.0};   ///< dissipated by damage, where the state has no closed form for it
    T released{0.0}; ///< stored in bonds at the moment they broke
    T viscous{0.0};  ///< dissipated by dashpots and by overstress
  };
} // namespace dem
