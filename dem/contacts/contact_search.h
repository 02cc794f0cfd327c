#pragma once

#include "base/state.h"
#include "dem/contacts/shared_search.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
  /**
 * Finds pairs of particles that begin to overlap, and searches only when the motion of particles can have made one.
 *
 * Proof by distance: `path` is the sum over steps of the largest displacement of any particle. A pair with gap g cannot close
 * before `path` has grown by g/2. So (1) the list of unlinked pairs nearer than a margin is complete until particles have moved half
 * the margin since it was made, and (2) the list itself need not be visited before `path` has grown by half its smallest gap.
 * At the start all pairs within the interaction ratio are linked, so the first list is empty and its margin is the gap that the ratio
 * leaves between unlinked particles.
 *
 * Where contacts wait, nothing is watched: pairs nearer than the margin are contacts already.
 *
 * In a periodic cell displacements are the fluctuations about the cell's motion; its strain brings a pair closer by its part of their
 * distance, which is below `reach`, the distance of the widest watched pair, from the moment the pair can matter.
 */
  class ContactSearch
  {
  public:
    /**
     * @param start_margin no unlinked pair has a gap below this at the start [m]
     * @param contacts_wait pairs are to be linked as soon as they are watched for, and not only when they overlap
     */
    ContactSearch(const Particles &particles, double start_margin, bool contacts_wait);

    /**
     * Account for one step. @param largest no particle moved further [m] @param strain of the cell in the step, its norm
     * @return whether find_contacts() must be called now
     */
    bool moved(double largest, double strain);

    /** A pair (first, second, image) that is no longer linked: watch it. */
    void watch(const Particles &particles, const std::array<std::int32_t, 3> &pair);

    /**
     * Unlinked pairs that overlap now (all watched ones, where contacts wait), sorted; they are no longer watched.
     * @param search with other ranks, all of which call this; by default alone
     */
    std::vector<NeighbourPair>
    find_contacts(Particles &particles, const LinkSet &bonds, const LinkSet &contacts, const SharedSearch &search = {});

    /** Whether a contact that waits would be made anew if it were dropped now. */
    bool is_near(const Particles &particles, const std::array<std::int32_t, 3> &pair) const;

    std::int64_t searches() const { return neighbour_searches; } ///< how often neighbours were searched so far

    /** Where particles were at the last search, three numbers of each, of those that are known here [m]. */
    base::Column  &places() { return reference; }
    const PairsOf &known() const { return kept; }
    /** Only these are known here from now on. */
    void know(const PairsOf &these) { kept = these; }

    void visit_state(base::StateVisitor &visitor);

  private:
    void   rebuild(Particles &particles, const LinkSet &bonds, const LinkSet &contacts, const SharedSearch &search);
    double largest_displacement(const Particles &particles, const SharedSearch &search) const;
    /** Behind the last particle that is known. */
    std::size_t known_end(const Particles &particles) const
    {
      return std::min(particles.count, static_cast<std::size_t>(kept.end));
    }
    double watched_gap(const Particles &particles, const std::array<std::int32_t, 3> &pair) const;
    /** Not below the distance of a pair that is watched for, of centres [m]. */
    double reach() const { return largest_diameter + std::max(margin, list_margin); }

    bool                      contacts_wait;
    std::vector<std::int32_t> watched;     ///< first, second, image of each pair, flattened
    base::Column              reference;   ///< positions at the last rebuild, three per particle [m]
    PairsOf                   kept;        ///< particles of which it is known
    double                    margin;      ///< gap that unwatched pairs had at least at the last rebuild [m]
    double                    list_margin; ///< margin of the lists to come [m]
    double                    largest_diameter;
    base::Column              reference_base; ///< H at the last rebuild, by columns; empty without a cell [m]
    double                    path = 0, path_of_list = 0; ///< now; not below the largest displacement since the rebuild
    double                    next_update;
    std::int64_t              neighbour_searches = 0;
  };

  /** Distance between the surfaces of two particles (first, second, image of the second), negative when they overlap [m]. */
  double gap(const Particles &particles, const std::array<std::int32_t, 3> &pair);

  /** Whether an undeleted line of the set joins the two (first, second, image of the second). */
  bool joined(const LinkSet &links, const std::array<std::int32_t, 3> &pair);

  /** Put new contacts, at their present distance, among the living ones; deleted lines go. */
  void add_contacts(LinkSet                          &contacts,
                    const std::vector<NeighbourPair> &born,
                    Particles                        &particles,
                    const ParticleShape              &shape,
                    const LinkLaw                    &law);
} // namespace dem
