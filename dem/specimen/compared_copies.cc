// An audit: what two ranks compute of a link is the same on both (doc/theory/ranks.md, 3).

#include "base/errors.h"
#include "dem/core/simd.h"
#include "dem/model/column_memory.h"
#include "dem/specimen/shared_work.h"

#include <cstring>
#include <string>

namespace dem
{
  namespace
  {
    /** What the links of some packs remember, and do, one pack after the other. */
    std::vector<double> contents_of(const LinkSet &links, const std::vector<std::int32_t> &packs)
    {
      std::vector<double> numbers;
      for (const std::int32_t pack : packs)
        each_column_of_state(links, [&](const base::Column &column, const std::size_t of_line) {
          const auto length = static_cast<std::ptrdiff_t>(of_line * pack_size);
          numbers.insert(numbers.end(), column.begin() + length * pack, column.begin() + length * (pack + 1));
        });
      return numbers;
    }

    /** The ends of one of a pack's links that is there, by the numbers that files have. */
    std::string named(const LinkSet &links, const std::int32_t pack, const Particles &particles)
    {
      std::size_t line = static_cast<std::size_t>(pack) * pack_size;
      while (static_cast<std::size_t>(links.first[line]) >= particles.count)
        ++line; // no pack of idle lines alone has a copy
      const auto number = [&](const std::int32_t end) {
        return std::to_string(particles.number[static_cast<std::size_t>(end)] + 1);
      };
      return number(links.first[line]) + " and " + number(links.second[line]);
    }
  } // namespace

  void SharedWork::compare_copies(const LinkSet &links, const SetShare &share, const Particles &particles)
  {
    std::vector<std::vector<std::int32_t>> copied(size()); // packs of each owner
    for (const LinkPart &part : links.parts)
      if (!part.own)
        for (std::size_t pack = part.begin / pack_size; pack < part.end / pack_size; ++pack)
          copied[owner_of_block(share, part.block)].push_back(static_cast<std::int32_t>(pack));
    const auto               wanted = ranks->deliver(copied);
    std::vector<RankMessage> to_others, of_owners;
    for (std::size_t r = 0; r < size(); ++r)
      {
        if (!wanted[r].empty())
          to_others.push_back({r, contents_of(links, wanted[r])});
        if (!copied[r].empty())
          of_owners.push_back({r, contents_of(links, copied[r])});
      }
    const std::vector<RankMessage> here = of_owners;
    ranks->exchange(to_others, of_owners);
    for (std::size_t m = 0; m < here.size(); ++m)
      {
        const std::vector<std::int32_t> &packs  = copied[here[m].rank];
        const std::size_t                length = here[m].numbers.size() / packs.size();
        for (std::size_t k = 0; k < packs.size(); ++k)
          if (std::memcmp(&here[m].numbers[k * length], &of_owners[m].numbers[k * length], length * sizeof(double)) !=
              0)
            throw base::NumericalError("audit of ranks: rank " + std::to_string(rank()) +
                                       " has not the same of a link as rank " + std::to_string(here[m].rank) +
                                       ", to which it belongs: the one between particles " +
                                       named(links, packs[k], particles) + ", or one beside it.");
      }
  }
} // namespace dem
