#pragma once

#include "dem/network/stiffness_operator.h"
#include "dem/ranks/bricks.h"
#include "dem/ranks/ranks.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /** Particles whose products are added up one after the other; their sums are then added in their order. */
  constexpr std::int64_t particles_per_sum = 128;
  static_assert(particles_per_brick % particles_per_sum == 0, "no such sum is divided between ranks");

  /**
   * The particles of a linear system on which one of several ranks works (doc/theory/ranks.md, 7): whole bricks along the operator's order.
   * Fields have their full size on each rank and are up to date there for its own particles. Those of others that its links end in, its
   * ghosts, are received before the stiffness is applied. Without ranks all particles are its own and nothing is sent.
   *
   * All ranks make the same calls in the same order.
   */
  class RowShare
  {
  public:
    /** @param ranks null: this process alone; otherwise they outlive this object */
    RowShare(const StiffnessOperator &stiffness, Ranks *ranks);

    ParticleRange own() const { return range; }

    /** Bring a field up to date for the ghosts. */
    void receive(Fields &x);
    /** Bring a field up to date for all particles. */
    void gather(Fields &x) const;
    /** Let all ranks know all sums. @param sums of particles_per_sum particles each, a number per lane, of which each rank has its own */
    void gather_sums(base::Column &sums) const;

  private:
    void find_messages(const StiffnessOperator &stiffness);
    /** Each rank's part of a column with so many numbers per particle, or per group of particles. */
    void gather(base::Column &column, std::int64_t particles, std::size_t numbers) const;

    Ranks                                 *ranks;
    std::vector<std::int64_t>              begin; ///< particle of each rank, and behind the last
    ParticleRange                          range;
    std::vector<RankMessage>               out, in;        ///< one for each rank that something goes to or comes from
    std::vector<std::vector<std::int32_t>> sent, received; ///< particles of each message, ascending
  };
} // namespace dem
