// What of a specimen is whose (doc/theory/ranks.md, 3).

#include "dem/core/memory_pages.h"
#include "dem/core/simd.h"
#include "dem/model/column_memory.h"
#include "dem/ranks/exchange_cost.h"
#include "dem/ranks/of_each_rank.h"
#include "dem/ranks/shares.h"
#include "dem/specimen/rank_shares.h"
#include "dem/specimen/shared_work.h"

#include <algorithm>
#include <utility>

namespace dem
{
  namespace
  {
    constexpr std::size_t numbers_of_ghost = bytes_per_ghost / sizeof(double);

    /** Blocks of each law of a set. */
    std::vector<std::pair<std::size_t, std::size_t>> blocks_of_laws(const LinkSet &links)
    {
      std::vector<std::pair<std::size_t, std::size_t>> of;
      if (links.first_block.empty())
        of.emplace_back(0, links.blocks());
      for (std::size_t k = 0; k + 1 < links.first_block.size(); ++k)
        of.emplace_back(links.first_block[k], links.first_block[k + 1]);
      return of;
    }
  } // namespace

  std::size_t SharedWork::owner_of(const std::int32_t particle) const
  {
    return static_cast<std::size_t>(std::upper_bound(particle_begin.begin() + 1, particle_begin.end() - 1, particle) -
                                    (particle_begin.begin() + 1));
  }

  std::size_t SharedWork::owner_of_block(const SetShare &share, const std::size_t block) const
  {
    for (const auto &begin : share.block_begin)
      if (block < begin.back())
        return static_cast<std::size_t>(std::upper_bound(begin.begin() + 1, begin.end() - 1, block) -
                                        (begin.begin() + 1));
    return size() - 1;
  }

  void SharedWork::choose_ranges(const Particles &particles, const LinkSet &bonds, const LinkSet &contacts)
  {
    const LinkEnds ends = living_ends(bonds, contacts);
    brick_begin.clear();
    if (skewed)
      {
        std::vector<std::int64_t> work = work_of_bricks(particles.count, ends);
        for (std::size_t b = 0; b < work.size() / 2; ++b)
          work[b] *= 3;
        brick_begin = even_ranges(work, size());
      }
    else
      {
        for (const RankShare &share : dem::share_out(particles.count, ends, size()))
          brick_begin.push_back(share.first_brick);
        brick_begin.push_back(particle_blocks(particles.count));
      }
    particle_begin.clear();
    for (const std::size_t brick : brick_begin)
      particle_begin.push_back(static_cast<std::int32_t>(std::min(brick * particles_per_brick, particles.count)));
  }

  /** A block belongs to the rank of its first link's first end. */
  void SharedWork::share_out(LinkSet &links, SetShare &share) const
  {
    share.block_begin.clear();
    links.parts.clear();
    for (const auto &[first_block, end_block] : blocks_of_laws(links))
      {
        std::vector<std::size_t> begin(size() + 1, end_block);
        begin.front()          = first_block;
        const std::size_t used = std::min(end_block, links.first.size() / links_per_block);
        for (std::size_t r = 1; r < size(); ++r)
          {
            begin[r] = begin[r - 1];
            while (begin[r] < used && owner_of(links.first[begin[r] * links_per_block]) < r)
              ++begin[r];
          }
        for (std::size_t b = begin[rank()]; b < begin[rank() + 1]; ++b)
          links.parts.push_back(links.part_of_block(b));
        share.block_begin.push_back(std::move(begin));
      }
    append_copies(links, share);
    take_small_pages_of_others(links, share);
    links.in_parts = true;
    share.stale = share.lean = false;
    share.since_read         = 0;
    share.borrowed.clear();
  }

  void SharedWork::append_copies(LinkSet &links, const SetShare &share) const
  {
    std::vector<std::size_t> packs;
    const auto               note = [&](const std::size_t l) {
      if (owner_of_block(share, l / links_per_block) != rank())
        packs.push_back(l / pack_size);
    };
    for (std::int32_t i = first(); i < last(); ++i)
      {
        const auto at = static_cast<std::size_t>(i);
        for (std::int32_t o = links.own_begin[at]; o < links.own_begin[at + 1]; ++o)
          note(links.own(o));
        for (std::int32_t o = links.other_begin[at]; o < links.other_begin[at + 1]; ++o)
          note(static_cast<std::size_t>(links.others[static_cast<std::size_t>(o)]));
      }
    std::sort(packs.begin(), packs.end());
    packs.erase(std::unique(packs.begin(), packs.end()), packs.end());
    for (const std::size_t pack : packs)
      {
        const std::size_t begin = pack * pack_size, block = begin / links_per_block;
        if (LinkPart *last = links.parts.empty() ? nullptr : &links.parts.back();
            last && !last->own && last->end == begin && last->block == block)
          last->end += pack_size;
        else
          links.parts.push_back({begin, begin + pack_size, block, false});
      }
    std::sort(links.parts.begin(), links.parts.end(),
              [](const LinkPart &a, const LinkPart &b) { return a.begin < b.begin; });
  }

  void SharedWork::find_ghosts(const Particles                 &particles,
                               const LinkSet                   &bonds,
                               const LinkSet                   &contacts,
                               const std::vector<std::int32_t> &ends_of_gone)
  {
    ghosts.assign(size(), {});
    std::vector<std::int32_t>       needed = ends_of(bonds, bonds.parts, particles.count);
    const std::vector<std::int32_t> others = ends_of(contacts, contacts.parts, particles.count);
    needed.insert(needed.end(), others.begin(), others.end());
    for (std::size_t at = 0; at < ends_of_gone.size(); at += 2)
      if (owns(ends_of_gone[at]))
        needed.push_back(ends_of_gone[at + 1]);
    std::sort(needed.begin(), needed.end());
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
    for (const std::int32_t particle : needed)
      if (!owns(particle))
        ghosts[owner_of(particle)].push_back(particle);
    sent = ranks->deliver(ghosts);
    out.clear();
    in.clear();
    for (std::size_t r = 0; r < size(); ++r)
      for (const auto &[particles_of, messages_of] : {std::pair(&sent, &out), std::pair(&ghosts, &in)})
        if (const std::size_t count = (*particles_of)[r].size(); count > 0)
          messages_of->push_back({r, std::vector<double>(numbers_of_ghost * count)});
  }

  void SharedWork::plan(Particles                       &particles,
                        LinkSet                         &bonds,
                        LinkSet                         &contacts,
                        ContactSearch                   &search,
                        const std::vector<std::int32_t> &by_all,
                        const std::vector<std::int32_t> &moved_by_all,
                        const std::vector<std::int32_t> &ends_of_gone)
  {
    if (bonds.in_parts && contacts.in_parts)
      return;
    const bool anew = !bonds.in_parts;
    if (anew)
      {
        choose_ranges(particles, bonds, contacts);
        share_out(bonds, of_bonds);
        take_small_pages_of_others(particles);
      }
    share_out(contacts, of_contacts);
    find_ghosts(particles, bonds, contacts, ends_of_gone);
    const double most = largest_work(bonds, contacts);
    if (anew)
      work_when_chosen = most;
    uneven = most > most_uneven * work_when_chosen;
    if (!anew)
      return; // contacts may soon be made again
    // All this before the step takes up memory for forces, motion and what else begins as zeros.
    hold_own(bonds, of_bonds);
    hold_own(contacts, of_contacts);
    hold_own(particles, by_all, moved_by_all);
    hold_own(search);
    planned_anew = true;
    if (bonds.streams || contacts.streams)
      give_back_freed();
  }

  void SharedWork::change_ranges(const std::int64_t step, LinkSet &bonds, LinkSet &contacts)
  {
    skewed         = skewed != moves_ranges(step);
    bonds.in_parts = contacts.in_parts = false;
  }

  double SharedWork::largest_work(const LinkSet &bonds, const LinkSet &contacts) const
  {
    std::int64_t own = updates_per_particle * (last() - first());
    for (const LinkSet *links : {&bonds, &contacts})
      for (const LinkPart &part : links->parts)
        own += static_cast<std::int64_t>(part.end - part.begin);
    std::int64_t largest = 0, all = 0;
    for (const std::int64_t of_rank : of_each_rank(*ranks, own))
      {
        largest = std::max(largest, of_rank);
        all += of_rank;
      }
    return static_cast<double>(largest) * static_cast<double>(size()) / static_cast<double>(all);
  }

  std::vector<RankWork>
  SharedWork::work(const LinkSet &bonds, const LinkSet &contacts, const SurfaceContacts &surfaces) const
  {
    RankWork own;
    own.particles     = last() - first();
    own.wall_contacts = surfaces.count_of(first(), last());
    for (const LinkSet *links : {&bonds, &contacts})
      for (const LinkPart &part : links->parts)
        (part.own ? own.links : own.copies) +=
          std::count(links->living.begin() + static_cast<std::ptrdiff_t>(part.begin),
                     links->living.begin() + static_cast<std::ptrdiff_t>(part.end), std::uint8_t{1});
    for (std::size_t r = 0; r < size(); ++r)
      {
        own.ghosts += static_cast<std::int64_t>(ghosts[r].size());
        own.neighbours += ghosts[r].empty() && sent[r].empty() ? 0 : 1;
      }
    own.messages = messages;
    own.bytes    = bytes;
    return of_each_rank(*ranks, own);
  }

  std::vector<RankMemory>
  SharedWork::memory(const Particles &particles, const LinkSet &bonds, const LinkSet &contacts) const
  {
    RankMemory own;
    own.now      = static_cast<std::int64_t>(resident_bytes(particles, {&bonds, &contacts}));
    own.in_steps = in_steps > 0 ? in_steps : own.now;
    return of_each_rank(*ranks, own);
  }
} // namespace dem
