#pragma once

#include "coupling/promotion/place_motion.h"
#include "dem/network/loaded_network.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace coupling
{
  /** The particles that take part in a structure, out of all of a packing: the others lie in elements alone. */
  struct AwakeParticles
  {
    const dem::LoadedNetwork       &network; ///< its first carriers are these particles, then the joints of a body
    const std::vector<std::size_t> &numbers; ///< of these in the packing, ascending
  };

  /**
   * Motion of all particles of a packing as carriers of `whole`: of those in the solid its motion there, of those awake their own.
   * @param in_solid of each particle of the packing
   */
  dem::LoadedMotion motion_of_all(const dem::LoadedNetwork &whole,
                                  const AwakeParticles     &awake,
                                  const dem::LoadedMotion  &of_awake,
                                  const PlaceMotions       &in_solid);

  /** What is known of a structure when elements have become particles, to start the next one from. */
  struct CarriedMotion
  {
    AwakeParticles           before;
    const dem::LoadedMotion &of_before; ///< of the carriers before
    const dem::LoadedMotion &of_all;    ///< motion_of_all() before
    const PlaceMotions      &in_solid;  ///< before, of each particle of the packing
    const PlaceMotions      &joints;    ///< before, at the places of the joints of now
  };

  /**
   * Start of the structure of now: particles that were awake go on, those in the solid move as it does, so that ties are obeyed from the start.
   * @param still_in_solid whether each particle of the packing lies in the solid of now
   */
  dem::LoadedMotion
  start_from(const CarriedMotion &known, const AwakeParticles &now, const PlaceMotions &still_in_solid);

  /** Of each link of now, its number before; none for links between particles of which one was not awake. */
  std::vector<std::optional<std::size_t>> links_before(const AwakeParticles &before, const AwakeParticles &now);
} // namespace coupling
