#pragma once

#include "dem/model/link_law.h"

#include <limits>

namespace dem
{
  /** What a law does not declare itself: a law derives from this and declares what differs (doc/theory/link-laws.md). */
  struct LinkLawDefaults
  {
    static constexpr bool waits          = false; ///< LinkLawTraits::waits
    static constexpr bool viscous        = false; ///< it has damping_ratio(constants)
    static constexpr bool directed       = false; ///< its update looks at the direction of the link
    static constexpr bool stiffens       = false; ///< LinkLawTraits::stiffens
    static constexpr bool tells_elements = false; ///< it has broken_elements(constants, geometry, state)
    static constexpr bool has_rows       = false; ///< it has rows(), rows_of() and begin_rows()
    static constexpr int  resting_shear =
      -1; ///< place of a shear vector that rests while acts() is false; -1: there is none

    /** LinkLawTraits::rate_dependent, of one pair; of viscous laws. */
    template <typename Constants>
    static bool rate_dependent(const Constants &)
    {
      return false;
    }
    /** Nothing is lost that the pass has not summed up. */
    template <typename Constants, typename S>
    static double damage_dissipation(const Constants &, const LinkGeometry &, const S &)
    {
      return 0;
    }
    /** Opening damages nothing. */
    template <typename Constants, typename S>
    static double damaging_strain(const Constants &, const S &)
    {
      return std::numeric_limits<double>::infinity();
    }
  };
} // namespace dem
