#pragma once

#include "dem/contacts/contact_search.h"
#include "dem/facets/surface_contacts.h"
#include "dem/kernels/particle_pass.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"
#include "dem/ranks/exact_sum.h"
#include "dem/ranks/ranks.h"
#include "dem/specimen/rank_shares.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace dem
{
  /**
   * How ranks share the work of a specimen, and its memory (doc/theory/ranks.md, 3). Each of them moves the particles of its bricks, and
   * updates the blocks of links that begin there, with copies of others that its particles need. Blocks and packs of links are the same on
   * all, so every number has the bits that it has on one.
   *
   * All know which particles and links there are, and what links join. What a link remembers and does, those have who update it, and where a
   * particle is and how it moves, those who move it or update its links; the memory for others' stays reserved, and is given back to the system
   * until something is gathered there. What others have computed is out of date here, or absent, until it is exchanged or gathered.
   *
   * All members but the readings are called by all ranks, in the same order.
   */
  class SharedWork
  {
  public:
    /**
     * @param move_every steps after which ranges of bricks are changed, for tests; 0: only where bonds are sorted out anew. Where they are, what
     * a rank does not have is no number, so that it shows where something reads it, and copies are compared with their owners' in every step,
     * as in builds of the preset `audit`
     */
    SharedWork(std::shared_ptr<Ranks> ranks, std::int64_t move_every);

    // --- What is whose ---

    /**
     * Share out sets of links that have been sorted out anew, if any; where bonds are, others' links and particles take no memory from here on.
     * @pre such a set is up to date, and with bonds all particles are, and the search @param by_all @param moved_by_all as of share_motion()
     * @param ends_of_gone two of each bond that is gone: a rank that shows the first of them knows where the second is
     */
    void plan(Particles                       &particles,
              LinkSet                         &bonds,
              LinkSet                         &contacts,
              ContactSearch                   &search,
              const std::vector<std::int32_t> &by_all,
              const std::vector<std::int32_t> &moved_by_all,
              const std::vector<std::int32_t> &ends_of_gone);
    /** Whether ranges are to be changed before a step, given by its number: in tests, and where contacts have made them uneven. */
    bool changes_ranges(const std::int64_t step) const { return uneven || moves_ranges(step); }
    /** Change them with the next plan(). @pre all is up to date */
    void           change_ranges(std::int64_t step, LinkSet &bonds, LinkSet &contacts);
    bool           planned() const { return !brick_begin.empty(); }
    ParticleBlocks bricks() const { return {brick_begin[rank()], brick_begin[rank() + 1]}; }
    std::int32_t   first() const { return particle_begin[rank()]; }    ///< particle of this rank
    std::int32_t   last() const { return particle_begin[rank() + 1]; } ///< behind its particles
    bool           owns(const std::int32_t particle) const { return particle >= first() && particle < last(); }
    /** Of each rank. */
    std::vector<RankWork> work(const LinkSet &bonds, const LinkSet &contacts, const SurfaceContacts &surfaces) const;
    /** What particles and links take up in each rank. */
    std::vector<RankMemory> memory(const Particles &particles, const LinkSet &bonds, const LinkSet &contacts) const;

    // --- In a step ---

    /** Links have been updated. */
    void links_updated(const Particles &particles, LinkSet &bonds, LinkSet &contacts);
    /** Before links that broke are handled: all learn which blocks have some, and what is in them. */
    void share_events(Particles &particles, LinkSet &bonds, LinkSet &contacts);
    void share_stress_moments(LinkSet &bonds, LinkSet &contacts);
    /**
     * After particles have moved: their sums; places and motions where they are ghosts, or all read them.
     * @param by_all ascending @param moved_by_all that every rank moves, or of which all prescribe how they move
     */
    void share_motion(Particles                         &particles,
                      std::vector<ParticleBlockAccount> &accounts,
                      const std::vector<std::int32_t>   &by_all,
                      const std::vector<std::int32_t>   &moved_by_all);
    /** Forces and moments on some particles. @param of ascending */
    void share_forces(Particles &particles, const std::vector<std::int32_t> &of);
    void share_velocities(Particles &particles, const std::vector<std::int32_t> &of);
    void share_displacements(Particles &particles, const std::vector<std::int32_t> &of); ///< of the last step
    /** Places, motions, velocities and forces: all know these particles until others move. @param of ascending */
    void share_states(Particles &particles, const std::vector<std::int32_t> &of);
    bool knows(std::int32_t particle) const;
    /** For neighbours, each rank for those of its particles. */
    SharedSearch search();
    /** For contacts with surfaces, likewise. */
    SharedSurfaces surfaces() { return {*ranks, first(), last(), messages, bytes}; }
    double         largest(double number) const;
    double         least(const double number) const { return -largest(-number); }

    // --- To read all of it ---

    /** Whether some of it is out of date here, or absent. */
    bool lacks_places() const { return places_stale; }
    bool lacks_particles() const { return places_stale || rates_stale || constants_absent; }
    bool lacks_bonds() const { return of_bonds.stale; }
    bool lacks_contacts() const { return of_contacts.stale; }
    void gather_places(Particles &particles); ///< and the motion of the last step
    /** Particles were put elsewhere, each by its own rank at least. */
    void places_changed() { places_stale = true; }
    /** Some numbers of each particle, one particle after the other. */
    void gather_numbers(double *all, std::size_t of_each);
    void gather_column(base::Column &records) { gather_numbers(records.data(), record_size); }
    /** Where particles began, and their inverse masses. */
    void gather_constants(Particles &particles);
    void gather_particles(Particles &particles);
    /** Where they were when neighbours were last sought. */
    void gather_search(ContactSearch &search);
    void gather_bonds(LinkSet &links) { gather_links(links, of_bonds); }
    void gather_contacts(LinkSet &links) { gather_links(links, of_contacts); }
    void gather_accounts(LinkSet &bonds, LinkSet &contacts);
    /** Hand numbers from rank to rank, each of which goes through its lines of a set; all have what comes out. */
    using OfLines = std::function<void(std::size_t begin, std::size_t end)>;
    void relay_bonds(const LinkSet &bonds, const OfLines &use, double *numbers, std::size_t count);
    void relay_contacts(const LinkSet &contacts, const OfLines &use, double *numbers, std::size_t count);
    void relay_particles(const OfLines &use, double *numbers, std::size_t count);
    /** Of what each rank has added up, the sum. */
    void add_up(ExactSum &sum);
    /** What a rank says of some lines, and how the first takes what is said, in the order of lines. */
    using Tell = std::function<void(std::size_t begin, std::size_t end, std::vector<double> &numbers)>;
    using Take = std::function<void(const std::vector<double> &numbers)>;
    /** Let each rank tell the first of its lines of a set, few at a time, so that none has more of others than these. */
    void tell_first_of_bonds(const LinkSet &bonds, const Tell &tell, const Take &take);
    void tell_first_of_contacts(const LinkSet &contacts, const Tell &tell, const Take &take);
    void tell_first_of_particles(const Tell &tell, const Take &take);
    bool is_first() const { return rank() == 0; }
    /** Tell all ranks one column of a set, of particles' records or of the search, in its order, of few lines at a time. */
    using TakePart = std::function<void(const double *numbers, std::size_t count)>;
    void tell_column_of_bonds(const base::Column &column, const LinkSet &bonds, const TakePart &take);
    void tell_column_of_contacts(const base::Column &column, const LinkSet &contacts, const TakePart &take);
    void tell_records(const base::Column &column, const TakePart &take);
    void tell_places(ContactSearch &search, const TakePart &take);

  private:
    /** What is read at least this often stays where all can read it: giving memory back and taking it again takes time. */
    static constexpr std::int64_t steps_between_readings = 16;

    /** Whose the blocks of a set are. */
    struct SetShare
    {
      std::vector<std::vector<std::size_t>> block_begin;    ///< of each law, of each rank and behind the last
      bool                                  stale = false;  ///< others' blocks are out of date here
      bool                                  lean  = false;  ///< and they have no memory
      std::vector<std::size_t>              borrowed;       ///< but these, in which something happened
      std::int64_t                          since_read = 0; ///< steps since they were made or gathered
    };

    /** A rank may do this much more, over the mean, than when ranges were chosen. */
    static constexpr double most_uneven = 1.1;

    std::size_t rank() const { return ranks->rank(); }
    std::size_t size() const { return ranks->size(); }
    bool moves_ranges(const std::int64_t step) const { return move_every > 0 && step > 0 && step % move_every == 0; }
    void choose_ranges(const Particles &particles, const LinkSet &bonds, const LinkSet &contacts);
    void share_out(LinkSet &links, SetShare &share) const;
    /** Whole packs of others' blocks in which a link ends in a particle of this rank. */
    void append_copies(LinkSet &links, const SetShare &share) const;
    void find_ghosts(const Particles                 &particles,
                     const LinkSet                   &bonds,
                     const LinkSet                   &contacts,
                     const std::vector<std::int32_t> &ends_of_gone);
    /** Work of the rank that has most, over the mean. */
    double largest_work(const LinkSet &bonds, const LinkSet &contacts) const;
    /** For an audit. @throws base::NumericalError naming a link of which this rank has another copy than its owner, to the last bit */
    void compare_copies(const LinkSet &links, const SetShare &share, const Particles &particles);
    /** Each rank's part of columns of so many bytes a block, all gathered. */
    void gather_blocks(void *column, std::size_t bytes_of_block, const SetShare &share);
    void gather_links(LinkSet &links, SetShare &share);
    void gather_column(base::Column &column, std::size_t numbers_of_line, const SetShare &share);
    void relay(const std::vector<std::size_t> &begin, const OfLines &use, double *numbers, std::size_t count);
    void
    relay_lines(const LinkSet &links, const SetShare &share, const OfLines &use, double *numbers, std::size_t count);
    void tell_first(const std::vector<std::size_t> &begin, const Tell &tell, const Take &take);
    void tell_first_of_lines(const LinkSet &links, const SetShare &share, const Tell &tell, const Take &take);
    /** Numbers of one rank to the first, which does not know how many. */
    void send_to_first(std::size_t from, std::vector<double> &numbers);
    /** Lines of a set before those of each rank, and behind the last's, of each law. */
    static std::vector<std::vector<std::size_t>> lines_of_ranks(const LinkSet &links, const SetShare &share);
    /** @param lines of each rank, and behind the last, of each law */
    void tell_column(const base::Column                          &column,
                     std::size_t                                  numbers_of_line,
                     const std::vector<std::vector<std::size_t>> &lines,
                     const TakePart                              &take);
    void tell_column(const base::Column &column, const LinkSet &links, const SetShare &share, const TakePart &take);
    /** Give back the memory of what others have, unless it is read again and again. */
    void take_small_pages_of_others(LinkSet &links, const SetShare &share) const;
    void take_small_pages_of_others(Particles &particles) const;
    void keep_own(LinkSet &links, SetShare &share);
    /** From now on only what this rank updates. */
    void hold_own(LinkSet &links, SetShare &share);
    void drop_others(LinkSet &links);
    void keep_own(Particles                       &particles,
                  const std::vector<std::int32_t> &by_all,
                  const std::vector<std::int32_t> &moved_by_all);
    /** From now on only its particles, what its links need of others, and what all know of some. */
    void hold_own(Particles                       &particles,
                  const std::vector<std::int32_t> &by_all,
                  const std::vector<std::int32_t> &moved_by_all);
    void hold_own(ContactSearch &search) const;
    /** Count a step. @return whether what was made or gathered so many steps ago may go */
    bool may_go(std::int64_t &since_read) const;
    void drop(base::Column &column, std::size_t begin, std::size_t end) const;
    void
    drop_lines(base::Column &column, std::size_t numbers_of_line, const LinkSet &links, const LinkPart &among) const;
    /** Of others but for some. @param kept ascending, some of them several times */
    void drop_particles(base::Column &column, std::size_t numbers_of_each, const std::vector<std::int32_t> &kept) const;
    void gather(void *array, const std::vector<std::size_t> &begin);
    /** Records of some particles of which each rank has its own. @param of ascending @param numbers of each record that count */
    void        gather_records(const std::vector<base::Column *> &columns, const std::vector<std::int32_t> &of);
    std::size_t owner_of(std::int32_t particle) const;
    std::size_t owner_of_block(const SetShare &share, std::size_t block) const;

    std::shared_ptr<Ranks>                 ranks;
    std::int64_t                           move_every;
    bool                                   skewed           = false; ///< ranges are to be uneven
    bool                                   uneven           = false; ///< they have become so
    double                                 work_when_chosen = 1;     ///< largest_work() of them
    std::vector<std::size_t>               brick_begin;              ///< of each rank, and behind the last
    std::vector<std::int32_t>              particle_begin;           ///< likewise
    SetShare                               of_bonds, of_contacts;
    std::vector<std::vector<std::int32_t>> sent, ghosts; ///< particles that each other rank needs, and has for this one
    std::vector<RankMessage>               out, in;      ///< with their places and motions
    std::vector<std::int32_t>              known;        ///< particles of which all have the state, ascending
    std::vector<std::int32_t>              with_masses;  ///< of which all know what prescribes their motion
    bool                                   places_stale = false, rates_stale = false;
    bool                                   lean             = false; ///< others' particles have no memory
    bool                                   constants_absent = false; ///< no rank has what gather_constants() gathers
    std::int64_t                           since_read       = 0;     ///< steps since they were gathered
    bool                                   planned_anew     = false; ///< in this step
    bool                                   given_back       = false; ///< memory, since that in steps was measured
    std::int64_t                           in_steps         = 0; ///< memory that particles and links took up then [B]
    std::int64_t                           messages = 0, bytes = 0;
  };
} // namespace dem
