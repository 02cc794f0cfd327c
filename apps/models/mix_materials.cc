#include "apps/models/mix_materials.h"

#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>
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

    const NamedMaterial &material_called(const MaterialSection &materials, const std::string &name)
    {
      return *std::find_if(materials.named.begin(), materials.named.end(),
                           [&name](const NamedMaterial &one) { return one.name == name; });
    }

    /** Links between mortar and aggregate, with constants that no longer depend on which materials they join. */
    MaterialInterface interface_of(const MixSection &mix, const MaterialSection &materials)
    {
      const NamedMaterial &mortar        = material_called(materials, mix.mortar),
                          &aggregate     = material_called(materials, mix.aggregate);
      const MaterialInterface *own       = materials.between(mix.mortar, mix.aggregate);
      const auto               constants = [](const NamedMaterial &of, const dem::LinkLawKind &kind) {
        return dem::NamedConstants{of.name, of.law.constants.at(kind.name()).get()};
      };
      MaterialInterface made;
      made.law    = own != nullptr ? own->law_among(materials.named) : mortar.law.law;
      made.bonded = own == nullptr || own->bonded;
      for (const dem::LinkLawKind *kind : {made.law, mortar.law.contacts})
        if (kind != nullptr)
          made.constants[kind->name()] = own != nullptr ?
                                           own->constants_by(*kind, materials.named) :
                                           kind->mean_of(constants(mortar, *kind), constants(aggregate, *kind));
      return made;
    }

    /** The interfaces of one name for another. */
    std::list<MaterialInterface>
    renamed(std::list<MaterialInterface> all, const std::string &from, const std::string &to)
    {
      all.remove_if([&](const MaterialInterface &each) { return each.one != from && each.other != from; });
      for (MaterialInterface &each : all)
        for (std::string *name : {&each.one, &each.other})
          if (*name == from)
            *name = to;
      return all;
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

  MaterialSection with_copies(const MixSection &mix, const MaterialSection &materials, const std::size_t numbers)
  {
    MaterialSection   all       = materials;
    MaterialInterface interface = interface_of(mix, materials);
    NamedMaterial     copy      = material_called(materials, mix.aggregate);
    for (std::int32_t k = 1; all.named.size() < numbers; ++k)
      {
        copy.name = aggregate_name(mix, k);
        all.named.push_back(copy);
        all.interfaces.splice(all.interfaces.end(), renamed(materials.interfaces, mix.aggregate, copy.name));
        interface.other = copy.name;
        for (std::int32_t before = 0; before < k; ++before)
          {
            interface.one = aggregate_name(mix, before);
            all.interfaces.push_back(interface);
          }
      }
    return all;
  }

  dem::LinkMaterials mix_materials(const MixSection &mix, const LinkLaw &mortar, const std::size_t numbers)
  {
    const dem::LinkMaterials bonds = by_law(mix, mortar, *mortar.law, numbers);
    return mortar.contacts == nullptr ? bonds : bonds.with_contacts(by_law(mix, mortar, *mortar.contacts, numbers));
  }
} // namespace apps
