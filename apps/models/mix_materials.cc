#include "apps/models/mix_materials.h"

#include "base/errors.h"

#include <fmt/format.h>

#include <memory>

namespace apps
{
  namespace
  {
    constexpr std::int32_t most_copies =
      16; ///< of aggregates beside each other; the table of pairs goes with their square

    dem::LinkMaterials
    by_law(const MixSection &mix, const LinkLaw &mortar, const dem::LinkLawKind &kind, const std::size_t numbers)
    {
      const std::shared_ptr<dem::LinkConstants> own       = mortar.constants.at(kind.name()),
                                                aggregate = dem::scaled(*own, mix.aggregates),
                                                interface = dem::scaled(*own, mix.interface);
      std::vector<dem::NamedConstants> all                = {{mix.mortar, own.get(), 0}};
      std::vector<dem::PairConstants>  pairs;
      for (std::int32_t one = 1; one < static_cast<std::int32_t>(numbers); ++one)
        {
          all.push_back({aggregate_name(mix, one - 1), aggregate.get(), 0});
          for (std::int32_t other = 0; other < one; ++other)
            pairs.push_back({one, other, interface.get(), true});
        }
      return kind.materials(all, pairs);
    }
  } // namespace

  std::string aggregate_name(const MixSection &mix, const std::int32_t copy)
  {
    if (copy >= most_copies)
      throw base::InputError(
        fmt::format("Specimen/Mix: more than {} aggregates lie so near each other that particles of all are "
                    "linked. Raise Clearance or Distance, or lower the content.",
                    most_copies));
    return copy == 0 ? mix.aggregate : fmt::format("{}+{}", mix.aggregate, copy + 1);
  }

  std::vector<std::string> classes_of_mix(const std::size_t numbers)
  {
    std::vector<std::string> classes;
    for (std::size_t one = 0; one < numbers; ++one)
      for (std::size_t other = 0; other <= one; ++other)
        classes.push_back(one != other ? "interface" : one == 0 ? "mortar" : "aggregate");
    return classes;
  }

  dem::LinkMaterials mix_materials(const MixSection &mix, const LinkLaw &mortar, const std::size_t numbers)
  {
    const dem::LinkMaterials bonds = by_law(mix, mortar, *mortar.law, numbers);
    return mortar.contacts == nullptr ? bonds : bonds.with_contacts(by_law(mix, mortar, *mortar.contacts, numbers));
  }
} // namespace apps
