#include "dem/specimen/rank_shares.h"

#include "dem/specimen/core.h"
#include "dem/specimen/inside.h"

namespace dem
{
  namespace
  {
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
    append_ends(ends, bonds);
    append_ends(ends, contacts);
    return ends;
  }

  std::vector<RankShare> share_out(const ObservedSpecimen &specimen, const std::size_t ranks)
  {
    const SpecimenCore &core = core_of(specimen);
    return share_out(core.particles.count, living_ends(core.bonds, core.contacts), ranks);
  }
} // namespace dem
