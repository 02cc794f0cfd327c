#pragma once

#include "dem/model/particles.h"
#include "dem/specimen/results.h"

namespace dem
{
  class ObservedSpecimen;

  /** What a reader of a picture takes for broken. */
  struct Crack
  {
    /** Damage from which on a link counts as cracked: it carries a twentieth at most of what it would carry undamaged. */
    static constexpr double damage = 0.95;

    std::size_t links         = 0; ///< cohesive ones that the specimen was made with
    std::size_t cracked       = 0; ///< of them, damaged beyond that or deleted
    std::size_t broken        = 0; ///< of them, deleted
    double      area          = 0; ///< of a crack through the bulk that would cut as much link area [m^2]
    double      area_at_grips = 0; ///< of it, what has an end held by a grip [m^2]

    /** A crack lies at a grip: a tenth of it at least, more than stray links there. The strength is then the grip's doing. */
    bool touches_grip() const { return area_at_grips > 0.1 * area; }
  };

  /**
   * A plane cut of unit area through isotropic links severs the link area n <A L>/2 in space and 2 n <A L>/pi in the plane, n their
   * number per volume (Buffon). The area of a crack is the severed link area over that: right for one crack through the bulk, whatever
   * its direction; a crushed band counts as many cracks.
   */
  Crack measure_crack(const ParticleOutput &particles, const LinkOutput &links, const ParticleShape &shape);
  /** Of a specimen as it is. All of the ranks that share it call this and learn it; none has all links for it. */
  Crack measure_crack(const ObservedSpecimen &specimen);
} // namespace dem
