#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
  /** How many links (or contacts) the particles have. */
  struct Coordination
  {
    std::vector<std::int32_t> of_particle; ///< links of each particle; one to its own periodic image counts twice
    std::vector<std::int64_t> particles;   ///< particles[z]: how many have z links
    double                    mean = 0;    ///< z, 2 links/particles
    /** Without floaters and rattlers of one link, which carry nothing: (2 links - N_1)/(N - N_0 - N_1) (Thornton, 2000). */
    double mechanical = 0;

    /** Particles with at most this many links. */
    std::int64_t with_at_most(std::size_t links) const;
  };

  /** @param ends of each link, particle numbers below `particles` @throws std::invalid_argument for another number */
  Coordination coordination(const std::vector<std::array<std::size_t, 2>> &ends, std::size_t particles);
} // namespace dem
