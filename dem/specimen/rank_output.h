#pragma once

#include "dem/specimen/results.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dem
{
  class ObservedSpecimen;

  /**
   * What one of several ranks shows of a specimen (Specimen::share_among()), without hearing from the others: its own particles, and the links,
   * contacts, broken links and glue whose first ends they are. What all ranks show together is ObservedSpecimen::particles() and links(), to the
   * last bit; each particle and each link is shown by one rank. Before the first step, when every rank has all, and of a specimen that is not shared,
   * bricks are shared out evenly.
   */
  struct RankOutput
  {
    RankOutput() = default;
    /** @param rank this one, from 0 @param ranks so many; of one it is everything */
    RankOutput(const ObservedSpecimen &specimen, std::size_t rank, std::size_t ranks);

    ParticleOutput            particles; ///< as they follow each other along the curve
    std::vector<std::int64_t> number;    ///< of each in the packing

    /** Ends of links, and particles with glue, are places in `points`. */
    LinkOutput links;
    std::vector<std::int64_t>
      line; ///< of each link, then of glue: ascends over all ranks in the order of ObservedSpecimen::links()
    /** The particles, then those of others to which links lead: where they are, their displacements and radii. */
    ParticleOutput            points;
    std::vector<std::int64_t> number_of_point; ///< in the packing

    bool several_materials = false; ///< whether particles of the specimen have them, and links pairs of them
    bool glued             = false; ///< whether anything was glued, here or elsewhere
  };
} // namespace dem
