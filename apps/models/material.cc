#include "apps/models/material.h"

#include "apps/text/nearest_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace apps
{
  void LinkLaw::check() const
  {
    chosen().check();
    if (contacts != nullptr)
      constants.at(contacts->name())->check();
  }

  namespace
  {
    void check_material(const NamedMaterial &material, const base::EntryPath &section)
    {
      if (!dem::is_material_name(material.name))
        section.refuse(dem::material_name_rule() + std::string("."));
      try
        {
          material.law.check();
        }
      catch (const base::InputError &refusal)
        {
          section.refuse_within(refusal.what());
        }
    }
  } // namespace

  void MaterialSection::check(const base::EntryPath &root, const int dimension) const
  {
    const base::EntryPath materials_section = root.at("Materials");
    if (named.empty())
      {
        only.check();
        if (!interfaces.empty())
          root.at("Interfaces").refuse("the scene has no section Materials to join.");
        if (!regions.empty())
          root.at("Regions").refuse("the scene has no section Materials to take their materials from.");
        return;
      }
    if (only.given)
      materials_section.refuse("the scene has a section Material as well. Keep one of the two.");
    for (const NamedMaterial &material : named)
      {
        const base::EntryPath section = materials_section.at(material.name);
        check_material(material, section);
        if (material.law.contacts != named.front().law.contacts)
          section.refuse("Contacts", "all materials of a scene must have the same, as the first of them.");
      }
    check_interfaces(root);
    check_pairs(root);
    try
      {
        materials().bonds(dem::Physics());
        materials().contacts(dem::Physics());
      }
    catch (const base::InputError &refusal)
      {
        materials_section.refuse(refusal.what());
      }
    check_regions(regions, names(), root, dimension);
  }

  void MaterialSection::check_interfaces(const base::EntryPath &root) const
  {
    const std::vector<std::string> known = names();
    for (const MaterialInterface &each : interfaces)
      {
        const base::EntryPath section = root.at("Interfaces").at(each.name);
        for (const auto &[entry, name] : {std::pair{"Material", each.one}, std::pair{"Other material", each.other}})
          if (std::find(known.begin(), known.end(), name) == known.end())
            section.refuse(entry, "is not in section Materials. " + did_you_mean(name, known));
        each.check(section, named);
      }
  }

  void MaterialSection::check_pairs(const base::EntryPath &root) const
  {
    const auto laws = laws_of_pairs();
    const auto at   = [this](const std::int32_t number) -> const NamedMaterial   &{
      return *std::next(named.begin(), number);
    };
    for (std::int32_t one = 0; one < static_cast<std::int32_t>(named.size()); ++one)
      for (std::int32_t other = 0; other < one; ++other)
        if (laws[static_cast<std::size_t>(dem::material_pair(one, other))] == nullptr)
          root.at("Materials")
            .at(at(one).name)
            .refuse("Law", fmt::format("links with {} ({}) have none. Choose it: add to Interfaces a sub-section with "
                                       "Material = {}, Other material = {} and their Law.",
                                       at(other).name, at(other).law.law->name(), at(other).name, at(one).name));
  }

  const MaterialInterface *MaterialSection::between(const std::string &one, const std::string &other) const
  {
    const MaterialInterface *found = nullptr;
    for (const MaterialInterface &each : interfaces)
      if ((each.one == one && each.other == other) || (each.one == other && each.other == one))
        found = &each;
    return found;
  }

  const MaterialInterface *MaterialSection::between(const std::int32_t one, const std::int32_t other) const
  {
    return between(std::next(named.begin(), one)->name, std::next(named.begin(), other)->name);
  }

  std::vector<const dem::LinkLawKind *> MaterialSection::laws_of_pairs() const
  {
    std::vector<const dem::LinkLawKind *> laws;
    std::int32_t                          one = 0;
    for (const NamedMaterial &material : named)
      {
        std::int32_t other = 0;
        for (auto partner = named.begin(); other <= one; ++partner, ++other)
          if (const MaterialInterface *own = between(one, other))
            laws.push_back(own->law_among(named));
          else
            laws.push_back(partner->law.law == material.law.law ? material.law.law : nullptr);
        ++one;
      }
    return laws;
  }

  dem::LinkMaterials MaterialSection::by_law(const dem::LinkLawKind &kind) const
  {
    std::vector<dem::NamedConstants>                 all;
    std::vector<dem::PairConstants>                  pairs;
    std::vector<std::shared_ptr<dem::LinkConstants>> between_them;
    for (const NamedMaterial &material : named)
      all.push_back({material.name, material.law.constants.at(kind.name()).get(), material.density});
    if (named.empty())
      all.push_back({"", only.constants.at(kind.name()).get(), 0});
    for (std::int32_t one = 0; one < static_cast<std::int32_t>(named.size()); ++one)
      for (std::int32_t other = 0; other <= one; ++other)
        if (const MaterialInterface *own = between(one, other))
          {
            between_them.push_back(own->constants_by(kind, named));
            pairs.push_back({one, other, between_them.back().get(), own->bonded});
          }
    return kind.materials(all, pairs);
  }

  dem::LinkMaterials MaterialSection::by_law(const dem::LinkLawKind                      &kind,
                                             const std::vector<const dem::LinkLawKind *> &of_pairs) const
  {
    const dem::LinkConstants                        *any = nullptr; // of this law
    std::vector<dem::NamedConstants>                 all;
    std::vector<dem::PairConstants>                  pairs;
    std::vector<std::shared_ptr<dem::LinkConstants>> between_them;
    for (const NamedMaterial &material : named)
      if (material.law.law == &kind)
        any = material.law.constants.at(kind.name()).get();
    for (const MaterialInterface &each : interfaces)
      if (any == nullptr && each.law_among(named) == &kind)
        any = each.constants.at(kind.name()).get();
    for (const NamedMaterial &material : named)
      all.push_back({material.name, material.law.law == &kind ? material.law.constants.at(kind.name()).get() : any,
                     material.density});
    for (std::int32_t one = 0; one < static_cast<std::int32_t>(named.size()); ++one)
      for (std::int32_t other = 0; other <= one; ++other)
        {
          const MaterialInterface *own = between(one, other);
          if (of_pairs[static_cast<std::size_t>(dem::material_pair(one, other))] != &kind)
            pairs.push_back({one, other, any, true});
          else if (own != nullptr)
            {
              between_them.push_back(own->constants_by(kind, named));
              pairs.push_back({one, other, between_them.back().get(), own->bonded});
            }
        }
    return kind.materials(all, pairs);
  }

  dem::LinkMaterials MaterialSection::materials() const
  {
    if (named.empty())
      {
        const dem::LinkMaterials bonds = by_law(*only.law);
        return only.contacts == nullptr ? bonds : bonds.with_contacts(by_law(*only.contacts));
      }
    const std::vector<const dem::LinkLawKind *> of_pairs = laws_of_pairs();
    std::vector<const dem::LinkLawKind *>       laws;
    std::vector<std::int32_t>                   kinds;
    for (const dem::LinkLawKind *law : of_pairs)
      {
        const auto found = std::find(laws.begin(), laws.end(), law);
        kinds.push_back(static_cast<std::int32_t>(found - laws.begin()));
        if (found == laws.end())
          laws.push_back(law);
      }
    std::vector<dem::LinkMaterials> of_laws;
    if (laws.size() > 1)
      for (const dem::LinkLawKind *law : laws)
        of_laws.push_back(by_law(*law, of_pairs));
    const dem::LinkMaterials bonds =
      laws.size() > 1 ? dem::LinkMaterials::by_pair(of_laws, kinds) : by_law(*laws.front());
    const dem::LinkLawKind *contacts = named.front().law.contacts;
    return contacts == nullptr ? bonds : bonds.with_contacts(by_law(*contacts));
  }

  std::vector<std::string> MaterialSection::names() const
  {
    std::vector<std::string> all;
    for (const NamedMaterial &material : named)
      all.push_back(material.name);
    return all;
  }

  namespace
  {
    /** The packing's materials as the scene numbers them. */
    std::vector<std::int32_t>
    renumbered(const dem::Packing &packing, const std::vector<std::string> &known, const std::string &origin)
    {
      if (packing.material.empty())
        return std::vector<std::int32_t>(packing.size(), 0);
      std::vector<std::int32_t> numbers = packing.material;
      for (std::size_t i = 0; i < numbers.size(); ++i)
        {
          const auto number = static_cast<std::size_t>(numbers[i]);
          if (packing.material_names.empty())
            {
              if (number >= known.size())
                throw base::InputError(
                  fmt::format("{}: particle {}: material {}: the scene has {}, numbered from 0: {}.", origin, i + 1,
                              number, known.size(), fmt::join(known, ", ")));
              continue;
            }
          const std::string &name  = packing.material_names.at(number);
          const auto         found = std::find(known.begin(), known.end(), name);
          if (found == known.end())
            throw base::InputError(
              fmt::format("{}: particle {}: material \"{}\" is not in the scene's section Materials. {}", origin, i + 1,
                          name, did_you_mean(name, known)));
          numbers[i] = static_cast<std::int32_t>(found - known.begin());
        }
      return numbers;
    }

    /** Two particles of different materials; nothing if all are alike. */
    void refuse_several(const dem::Packing &packing, const std::string &origin)
    {
      const auto &m     = packing.material;
      const auto  other = std::find_if(m.begin(), m.end(), [&](const std::int32_t n) { return n != m.front(); });
      if (other == m.end())
        return;
      const auto called = [&](const std::int32_t number) {
        return packing.material_names.empty() ? std::to_string(number) :
                                                packing.material_names.at(static_cast<std::size_t>(number));
      };
      throw base::InputError(fmt::format("{}: its particles are of several materials ({}, {}), and the scene has one. "
                                         "Give each a sub-section of its name in a section Materials, in place of "
                                         "Material.",
                                         origin, called(m.front()), called(*other)));
    }
  } // namespace

  void MaterialSection::assign(dem::Packing &packing, const int dimension, const std::string &origin) const
  {
    number(packing, dimension, origin);
    require_all(packing, origin);
  }

  void MaterialSection::number(dem::Packing &packing, const int dimension, const std::string &origin) const
  {
    if (named.empty())
      {
        refuse_several(packing, origin);
        packing.material.clear();
        packing.material_names.clear();
        return;
      }
    const std::vector<std::string> known   = names();
    std::vector<std::int32_t>      numbers = renumbered(packing, known, origin);
    number_by_regions(regions, known, packing.centre, dimension, numbers);
    packing.material       = std::move(numbers);
    packing.material_names = known;
  }

  void MaterialSection::require_all(const dem::Packing &packing, const std::string &origin) const
  {
    const std::vector<std::string> known   = names();
    const auto                    &numbers = packing.material;
    for (std::size_t k = 0; k < known.size(); ++k)
      if (std::find(numbers.begin(), numbers.end(), static_cast<std::int32_t>(k)) == numbers.end())
        throw base::InputError(origin + ": no particle is of the material \"" + known[k] +
                               "\". Take it out of section Materials, or check regions and units (metres).");
  }
} // namespace apps
