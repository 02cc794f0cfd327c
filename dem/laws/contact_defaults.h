#pragma once

#include "dem/kernels/link_law_of.h"

#include <limits>

namespace dem
{
  /** What laws of contacts without bond, moment or damage have in common; whose force is zero by the update itself while nothing touches. */
  struct UndamagedContact : LinkLawDefaults
  {
    static constexpr bool bonds = false, moment = false, breaks_in_place = false, waits = true;

    template <typename Constants, typename S>
    static LinkPhase phase(const Constants &, const LinkGeometry &link, const S &)
    {
      return link.strain > 0 ? LinkPhase::apart : LinkPhase::broken;
    }
    template <typename Constants, typename S>
    static LinkLoss damage(const Constants &, const LinkGeometry &, const S &)
    {
      return {1, 1};
    }

  protected:
    /** @param strength that friction bears [N] @param shear force [N] */
    static LinkExertion friction_used(const double strength, const double shear)
    {
      return {0, shear == 0 ? 0.0 : strength > 0 ? shear / strength : std::numeric_limits<double>::infinity()};
    }
  };
} // namespace dem
