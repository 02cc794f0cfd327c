#include "dem/specimen/rank_shares.h"

#include "dem/model/column_memory.h"
#include "dem/specimen/core.h"
#include "dem/specimen/inside.h"
#include "dem/specimen/observation.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    double bytes_of(const base::Column &column) { return static_cast<double>(sizeof(double) * column.capacity()); }

    void append_ends(LinkEnds &ends, const LinkSet &links)
    {
      for (std::size_t l = 0; l < links.count; ++l)
        if (links.is_alive(l))
          {
            ends.first.push_back(links.first[l]);
            ends.second.push_back(links.second[l]);
          }
    }
  } // namespace

  LinkEnds living_ends(const LinkSet &bonds, const LinkSet &contacts)
  {
    LinkEnds ends;
    for (auto *of : {&ends.first, &ends.second})
      of->reserve(bonds.alive + contacts.alive);
    append_ends(ends, bonds);
    append_ends(ends, contacts);
    return ends;
  }

  std::vector<RankShare> share_out(const ObservedSpecimen &specimen, const std::size_t ranks)
  {
    const SpecimenCore &core = core_of(specimen);
    return share_out(core.particles.count, living_ends(core.bonds, core.contacts), ranks);
  }

  std::size_t least_bytes(const ObservedSpecimen &specimen, const RankShare &share)
  {
    const SpecimenCore &core = core_of(specimen);
    double              all = static_cast<double>(specimen.bytes()), shared = 0, listed = 0;
    for (const LinkSet *links : {&core.bonds, &core.contacts})
      {
        each_column_of_state(*links, [&](const base::Column &column, std::size_t) { shared += bytes_of(column); });
        listed += static_cast<double>(links->others.size() * sizeof(std::int32_t));
      }
    const double lines = static_cast<double>(core.bonds.alive + core.contacts.alive),
                 owned = static_cast<double>(share.owned), updated = owned + static_cast<double>(share.copied.size());
    double held      = lines > 0 ? (shared * std::min(updated, lines) + listed * std::min(owned, lines)) / lines : 0;
    double of_places = bytes_of(core.particles.reference), of_motion = 0;
    for (const base::Column *column : records_of_places(core.particles))
      of_places += bytes_of(*column);
    for (const base::Column *column : records_of_motion(core.particles))
      of_motion += bytes_of(*column);
    const double own = static_cast<double>(share.end_particle - share.first_particle);
    held += (of_motion * own + of_places * (own + static_cast<double>(share.ghosts.size()))) /
            static_cast<double>(core.particles.count);
    return static_cast<std::size_t>(all - shared - listed - of_motion - of_places + held);
  }

  std::vector<RankMemory> memory_of_ranks(const ObservedSpecimen &specimen)
  {
    const SpecimenCore &core = core_in_parts_of(specimen);
    return core.shares() ? core.shared->memory(core.particles, core.bonds, core.contacts) : std::vector<RankMemory>{};
  }
} // namespace dem
