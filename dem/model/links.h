#pragma once

#include "base/column.h"
#include "base/state.h"
#include "dem/model/link_law.h"
#include "dem/model/particles.h"
#include "dem/neighbours/cell_list.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
  /** Links that one thread updates in a row; the unit of deterministic sums. Multiple of pack_size. */
  constexpr std::size_t links_per_block = 512;

  /** Numbers of a block's stress moment: nine, filled up to two cache lines. */
  constexpr std::size_t stress_record = 16;

  /**
   * Lines of a block that one of several ranks updates: all of a block that is its own, whose account it keeps; of others whole packs, as copies
   * for the particles that it moves (doc/theory/ranks.md, 3).
   */
  struct LinkPart
  {
    std::size_t begin = 0, end = 0; ///< lines
    std::size_t block = 0;
    bool        own   = true;
  };

  /** What a block of links reports besides forces. Padded to a cache line: one writer each. */
  struct alignas(64) LinkBlockAccount
  {
    double friction = 0;     ///< dissipated by sliding since the start [J]
    double damage   = 0;     ///< dissipated by damage since the start [J], where there is no closed form
    double released = 0;     ///< set free since the start by bonds that broke in their place [J]
    double viscous  = 0;     ///< dissipated by dashpots since the start [J]
    bool   event    = false; ///< in this step some link broke or is gone
  };

  /**
 * Links (or contacts) as columns, sorted by first end, padded to whole blocks; a deleted link stays as a line of area zero until
 * the set is compacted. What their law remembers of each stands in columns that the law declares.
 *
 * Where pairs of materials obey laws of different kinds, the links of one law follow those of the other, each padded to whole
 * blocks: a block has one law.
 */
  struct LinkSet
  {
    std::size_t count    = 0; ///< lines in use, deleted ones included
    std::size_t alive    = 0;
    bool        periodic = false; ///< links reach to images of particles, and their share of stress is summed up
    bool several_pairs = false; ///< particles are of several materials, and each link knows which pair of them it joins
    bool has_moment    = false; ///< they carry moments
    bool moments_apart =
      false; ///< in records of their own; in the plane a moment is one number, and has room beside the force
    bool streams = false; ///< too many for the caches: force records are written past them
    bool fetches_ahead =
      false; ///< too many, with all that a step reads, for the caches: force records are fetched before they are added up
    bool logs_breaks = false; ///< broken ones may stay: `noted` marks those in the crack log

    std::vector<LinkQuantity> quantities;      ///< what the columns of the history are, as the law declares them
    std::vector<std::int32_t> kinds;           ///< of each pair of materials the number of its law; empty: there is one
    std::vector<std::int32_t> first_block;     ///< of each of several laws, and behind the last
    bool                      viscous = false; ///< forces depend on speeds
    std::size_t               padding = 0;     ///< lines between the laws, which are no links

    std::vector<std::int32_t> first,
      second;                        ///< particle numbers in the order of Particles, first < second (<= if periodic)
    std::vector<std::int32_t> image; ///< of the second end, number in the cell's table; only if periodic
    std::vector<std::int32_t> pair;  ///< number of the pair of materials; only with several
    std::vector<std::int32_t> noted; ///< 1: broken, and in the crack log; only where broken links may stay
    base::Column              reference_length; ///< L0 [m]
    base::Column              area;             ///< A [m^2]; 0: deleted
    std::vector<std::uint8_t> living;           ///< 1: there, 0: deleted; all ranks know of each, and not all its area
    std::vector<base::Column> history;          ///< what the law remembers, see `quantities`
    base::Column
      force; ///< records: f on the first end (3) [N] | half l x f (3) [N m] | (r_J - r_K)/L | m_z in the plane
    base::Column
      moment; ///< half records: moment m on the first end at the contact point (3) [N m] | 0; only with moments, in space
    std::vector<LinkBlockAccount> accounts;
    double per_second = 0; ///< one over the length of the step that leads to the next update [1/s]; 0: no time passes
    base::Column
      stress_moments; ///< of each block a record of 16: sum l (x) f by rows (9) [N m] | 0 ..; only if periodic

    bool                  in_parts = false; ///< only its parts are updated; ends when the set is sorted out anew
    std::vector<LinkPart> parts;            ///< ascending

    std::vector<std::int32_t> own_begin;   ///< links whose first end is particle i: own_begin[i] .. own_begin[i + 1]
    std::vector<std::int32_t> owned;       ///< of several laws: these are places in `owned`, which are links, ascending
    std::vector<std::int32_t> other_begin; ///< as own_begin, into `others`
    std::vector<std::int32_t> others;      ///< links whose second end is particle i, ascending

    std::size_t blocks() const { return accounts.size(); }
    bool        is_alive(const std::size_t link) const { return living[link] != 0; }
    /** A bond that broke and stays as a contact. */
    bool is_broken(const std::size_t link) const { return logs_breaks && noted[link] != 0; }
    /** How many of the living are such. */
    std::size_t broken() const;
    /** Lines of links that were deleted. */
    std::size_t deleted() const { return count - padding - alive; }
    /** All lines of links that obey one law. */
    LinkLines whole() const { return {0, blocks(), 0}; }
    /** Lines of a block, the idle ones that fill it up to whole packs included. */
    LinkPart part_of_block(const std::size_t block) const
    {
      return {block * links_per_block, std::min((block + 1) * links_per_block, first.size()), block, true};
    }
    /** The parts that are updated, whole blocks where nothing else is said, by number; and those among lines of one law. */
    LinkPart part(const std::ptrdiff_t number) const
    {
      const auto p = static_cast<std::size_t>(number);
      return in_parts ? parts[p] : part_of_block(p);
    }
    std::pair<std::ptrdiff_t, std::ptrdiff_t> parts_between(const LinkLines &lines) const;
    /** A link by its place between own_begin[i] and own_begin[i + 1]. */
    std::size_t own(const std::int32_t place) const
    {
      return static_cast<std::size_t>(owned.empty() ? place : owned[static_cast<std::size_t>(place)]);
    }
    /** Number of the law of the links of a pair of materials. */
    std::size_t kind_of(const std::int32_t of_pair) const
    {
      return kinds.empty() ? 0 : static_cast<std::size_t>(kinds[static_cast<std::size_t>(of_pair)]);
    }
    /** Number of the pair of materials that a link joins. */
    std::size_t pair_of(const std::size_t link) const { return several_pairs ? pair[link] : 0; }
    std::size_t bytes() const;

    /** Take the columns that links of the law need. */
    void shape_for(const LinkLaw &law, bool in_cell, bool several_materials);
    /** A set without links, of the same columns. */
    LinkSet empty_like() const;
    /** Make room for `n` links of particles numbered below `particles`; all lines are padding between its two extra particles. */
    void resize(std::size_t n, std::size_t particles);
    /** The same for as many links of each law. @return the first line of each */
    std::vector<std::size_t> resize_by_law(const std::vector<std::size_t> &links_of_law, std::size_t particles);
    /** How many laws its links obey. */
    std::size_t laws() const;
    /** Living links of each law. */
    std::vector<std::size_t> alive_by_law() const;
    /** Moment on the first end at the contact point [N m]. */
    Eigen::Vector3d moment_of(std::size_t link) const;
    /** Number of the law of a link. */
    std::size_t kind_of_line(const std::size_t link) const { return kinds.empty() ? 0 : kind_of(pair[link]); }
    /** History of a link as a row of numbers, in the order of `quantities`. */
    void get_history(std::size_t link, std::vector<double> &row) const;
    void set_history(std::size_t link, const std::vector<double> &row);
    /** Sort out which links belong to which particle; from now on all are updated. @pre links of each law sorted by (first, second) */
    void tabulate(std::size_t particles);
    /** The part of it that is about second ends. */
    void list_others();
    /** From now on only particles from .. to - 1 know the links of which they are the second end; of others none is listed. */
    void keep_others_of(std::int32_t from, std::int32_t to);
    /** Copy line `from` of another set to line `to` of this one. */
    void copy_line(const LinkSet &source, std::size_t from, std::size_t to);
    /** Drop deleted lines (order kept); what the blocks have summed up so far moves to the first. */
    void compact(std::size_t particles);
    void remove(std::size_t link);

    void visit_state(base::StateVisitor &visitor, const std::string &name, std::size_t particles);

  private:
    /** Lines from there on are no links. */
    void pad(std::size_t from, std::size_t particles);
    void find_living();
    bool is_padding(const std::size_t l, const std::size_t particles) const
    {
      return first[l] == static_cast<std::int32_t>(particles);
    }
    std::vector<std::int32_t> begins_of(const std::vector<std::int32_t> &ends, std::size_t particles) const;
    std::vector<std::int32_t> listed_by(const std::vector<std::int32_t> &ends,
                                        const std::vector<std::int32_t> &begin) const;
  };

  /** Particles that the lines of some parts end in, ascending; lines of padding end in none. */
  std::vector<std::int32_t> ends_of(const LinkSet &links, const std::vector<LinkPart> &parts, std::size_t particles);

  /** Branch l from the first end to the (image of the) second where the particles are now [m]. */
  inline Eigen::Vector3d branch_of(const Particles &particles, const LinkSet &links, const std::size_t link)
  {
    const Eigen::Vector3d branch = particles.position_of(links.second[link]) - particles.position_of(links.first[link]);
    return links.periodic ? Eigen::Vector3d(branch + particles.cell.offset_of(links.image[link])) : branch;
  }

  /** Fill a set with undamaged links of the law between the pairs, whose memory goes on the way. Images that the cell does not know
   * yet are entered into its table. Where particles have materials, constants are those of the pairs. */
  void make_links(LinkSet                   &links,
                  std::vector<NeighbourPair> pairs,
                  Particles                 &particles,
                  const ParticleShape       &shape,
                  const LinkLaw             &law);
} // namespace dem
