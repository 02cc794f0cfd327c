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
   * The particles of a linear system on which one of several ranks works (doc/theory/ranks.md, 7): whole bricks along the system's order.
   * Fields have their full size on each rank and are up to date there for its own particles. Those of others that its links end in, its
   * ghosts, are received before the stiffness is applied. A field has as many numbers of each particle as is said at the start. Without ranks all particles are its own and nothing is sent.
   *
   * All ranks make the same calls in the same order.
   */
  class RowShare
  {
  public:
    /** Of fields of all lanes. @param ranks null: this process alone; otherwise they outlive this object */
    RowShare(const StiffnessOperator &stiffness, Ranks *ranks);
    /** @param numbers of a field for each particle */
    RowShare(std::size_t particles, const LinkEnds &links, std::size_t numbers, Ranks *ranks);

    ParticleRange own() const { return range; }
    /** Particles of others that its links end in, ascending. */
    std::vector<std::int32_t> ghosts() const;

    /** Bring a field up to date for the ghosts. */
    void receive(Fields &x);
    /** Bring a field up to date for all particles. */
    void gather(Fields &x) const;
    /** Let all ranks know all sums. @param sums of particles_per_sum particles each, a number per lane, of which each rank has its own */
    void gather_sums(base::Column &sums) const;
    /** Let all ranks know a column with so many numbers for each group of particles. @param particles of a group, which no boundary divides */
    void gather(base::Column &column, std::int64_t particles, std::size_t numbers) const;
    /** The same for some particles. @param rows ascending @param numbers of each, in the rows' order */
    void gather_rows(base::Column &column, const std::vector<std::int32_t> &rows, std::size_t numbers) const;
    /** Whether something is so on all ranks. */
    bool everywhere(bool here) const;

  private:
    void find_messages(const LinkEnds &links);
    void add_message(std::size_t                             rank,
                     std::vector<std::int32_t>               particles,
                     std::vector<RankMessage>               &messages,
                     std::vector<std::vector<std::int32_t>> &lists) const;

    std::size_t                            field_size; ///< numbers of a particle
    Ranks                                 *ranks;
    std::vector<std::int64_t>              begin; ///< particle of each rank, and behind the last
    ParticleRange                          range;
    std::vector<RankMessage>               out, in;        ///< one for each rank that something goes to or comes from
    std::vector<std::vector<std::int32_t>> sent, received; ///< particles of each message, ascending
  };
} // namespace dem
