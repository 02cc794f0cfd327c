#pragma once

#include "dem/model/held_lines.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"

namespace dem
{
  /** Two particles that are pressed into each other. */
  struct DeepestOverlap
  {
    double       depth = 0; ///< how much nearer their centres are than without force, over the smaller radius [-]
    std::int32_t first = 0, second = 0;

    /** Laws are made for overlaps that are small beside the particles; past this the answer is in doubt. */
    static constexpr double doubtful = 0.3;
    /** The centre of the smaller one is inside the larger one: next they pass through each other. */
    static constexpr double gone_through = 1.0;
  };

  /**
   * The deepest among particles that touch without a bond: contacts, and bonds that broke in their place. The distance without force
   * is that of surfaces that touch, or where the law makes contacts without force where they are, that at their birth.
   */
  DeepestOverlap deepest_overlap(const Particles &particles, const LinkSet &bonds, const LinkSet &contacts);
  /** The same of some contacts, or bonds that broke in their place, where one is deeper than what was found before. */
  void find_deeper_contact(const Particles &particles,
                           const LinkSet   &contacts,
                           const LinkRange &lines,
                           DeepestOverlap  &deepest);
  void
  find_deeper_bond(const Particles &particles, const LinkSet &bonds, const LinkRange &lines, DeepestOverlap &deepest);
} // namespace dem
