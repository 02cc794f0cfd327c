#pragma once

#include "dem/kernels/particle_pass.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"
#include "dem/ranks/ranks.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace dem
{
  /**
   * How ranks share the work of a specimen (doc/theory/ranks.md, 3). Each of them holds all of it, moves the particles of its bricks, and
   * updates the blocks of links that begin there, with copies of others that its particles need. Blocks and packs of links are the same on
   * all, so every number has the bits that it has on one. What others have computed is out of date here until it is exchanged or gathered.
   *
   * All members but the readings are called by all ranks, in the same order.
   */
  class SharedWork
  {
  public:
    /** @param move_every steps after which ranges of bricks are changed, for tests; 0: only where bonds are sorted out anew */
    SharedWork(std::shared_ptr<Ranks> ranks, std::int64_t move_every);

    // --- What is whose ---

    /** Share out sets of links that have been sorted out anew, if any. @pre such a set is up to date, and with bonds all particles are */
    void plan(const Particles &particles, LinkSet &bonds, LinkSet &contacts);
    /** Whether ranges are to be changed before a step, given by its number. */
    bool changes_ranges(std::int64_t step) const { return move_every > 0 && step > 0 && step % move_every == 0; }
    /** Change them with the next plan(). @pre all is up to date */
    void           change_ranges(LinkSet &bonds, LinkSet &contacts);
    bool           planned() const { return !brick_begin.empty(); }
    ParticleBlocks bricks() const { return {brick_begin[rank()], brick_begin[rank() + 1]}; }
    std::int32_t   first() const { return particle_begin[rank()]; }    ///< particle of this rank
    std::int32_t   last() const { return particle_begin[rank() + 1]; } ///< behind its particles
    bool           owns(const std::int32_t particle) const { return particle >= first() && particle < last(); }
    /** Of each rank. */
    std::vector<RankWork> work(const LinkSet &bonds, const LinkSet &contacts) const;

    // --- In a step ---

    /** Links have been updated. */
    void links_updated();
    /** Before links that broke are handled: all learn which blocks have some, and what is in them. */
    void share_events(Particles &particles, LinkSet &bonds, LinkSet &contacts);
    void share_stress_moments(LinkSet &bonds, LinkSet &contacts);
    /** After particles have moved: their sums; places and motions where they are ghosts, or all read them. @param by_all ascending */
    void share_motion(Particles                         &particles,
                      std::vector<ParticleBlockAccount> &accounts,
                      const std::vector<std::int32_t>   &by_all);
    /** Forces and moments on some particles. @param of ascending */
    void share_forces(Particles &particles, const std::vector<std::int32_t> &of);
    void share_velocities(Particles &particles, const std::vector<std::int32_t> &of);
    /** Places, motions, velocities and forces: all know these particles until others move. @param of ascending */
    void   share_states(Particles &particles, const std::vector<std::int32_t> &of);
    bool   knows(std::int32_t particle) const;
    double largest(double number) const;
    double least(const double number) const { return -largest(-number); }

    // --- To read all of it ---

    void gather_places(Particles &particles); ///< and the motion of the last step
    /** Particles were put elsewhere, each by its own rank at least. */
    void places_changed() { places_stale = true; }
    /** One record of each particle. */
    void gather_column(base::Column &records);
    void gather_particles(Particles &particles);
    void gather_bonds(LinkSet &links) { gather_links(links, of_bonds); }
    void gather_contacts(LinkSet &links) { gather_links(links, of_contacts); }

  private:
    /** Whose the blocks of a set are. */
    struct SetShare
    {
      std::vector<std::vector<std::size_t>> block_begin; ///< of each law, of each rank and behind the last
      bool                                  stale = false;
    };

    std::size_t rank() const { return ranks->rank(); }
    std::size_t size() const { return ranks->size(); }
    void        choose_ranges(const Particles &particles, const LinkSet &bonds, const LinkSet &contacts);
    void        share_out(LinkSet &links, SetShare &share) const;
    /** Whole packs of others' blocks in which a link ends in a particle of this rank. */
    void append_copies(LinkSet &links, const SetShare &share) const;
    void find_ghosts(const Particles &particles, const LinkSet &bonds, const LinkSet &contacts);
    /** Each rank's part of columns of so many bytes a block, all gathered. */
    void gather_blocks(void *column, std::size_t bytes_of_block, const SetShare &share);
    void gather_links(LinkSet &links, SetShare &share);
    void gather(void *array, const std::vector<std::size_t> &begin);
    /** Records of some particles of which each rank has its own. @param of ascending @param numbers of each record that count */
    void        gather_records(const std::vector<base::Column *> &columns, const std::vector<std::int32_t> &of);
    std::size_t owner_of(std::int32_t particle) const;
    std::size_t owner_of_block(const SetShare &share, std::size_t block) const;

    std::shared_ptr<Ranks>                 ranks;
    std::int64_t                           move_every;
    bool                                   skewed = false; ///< ranges are not even
    std::vector<std::size_t>               brick_begin;    ///< of each rank, and behind the last
    std::vector<std::int32_t>              particle_begin; ///< likewise
    SetShare                               of_bonds, of_contacts;
    std::vector<std::vector<std::int32_t>> sent, ghosts; ///< particles that each other rank needs, and has for this one
    std::vector<RankMessage>               out, in;      ///< with their places and motions
    std::vector<std::int32_t>              known;        ///< particles of which all have the state, ascending
    bool                                   places_stale = false, rates_stale = false;
    std::int64_t                           messages = 0, bytes = 0;
  };
} // namespace dem
