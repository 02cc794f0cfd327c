#include "dem/model/materials.h"

#include "base/errors.h"
#include "dem/model/laws_by_pair.h"

#include <cmath>

namespace dem
{
  std::vector<double> LinkMaterials::densities(const double otherwise) const
  {
    std::vector<double> found;
    for (const double own : density)
      found.push_back(own > 0 ? own : otherwise);
    return found;
  }

  LinkMaterials LinkMaterials::with_contacts(const LinkMaterials &other) const
  {
    if (other.size() != size())
      throw base::InputError("Contacts: there are " + std::to_string(size()) +
                             " materials, but contacts are given for " + std::to_string(other.size()) + ".");
    LinkMaterials both = *this;
    both.touching      = other.touching;
    return both;
  }

  /** The law of each pair of materials, whatever its kind. */
  struct LinkMaterials::ByPair : LinkMaterials::Concept
  {
    ByPair(const std::vector<LinkMaterials> &of_laws, std::vector<std::int32_t> kinds_of_pairs)
      : kinds(std::move(kinds_of_pairs))
    {
      for (const LinkMaterials &each : of_laws)
        {
          bonding.push_back(each.bonding);
          touching.push_back(each.touching);
        }
    }
    std::shared_ptr<const LinkLaw> bonds(const Physics &physics, const int dimension) const override
    {
      std::vector<std::shared_ptr<const LinkLaw>> laws;
      for (const auto &each : bonding)
        laws.push_back(each->bonds(physics, dimension));
      return std::make_shared<LawsByPair>(std::move(laws), kinds);
    }
    std::shared_ptr<const LinkLaw> contacts(const Physics &physics, const int dimension) const override
    {
      std::vector<std::shared_ptr<const LinkLaw>> laws;
      for (const auto &each : touching)
        {
          laws.push_back(each->contacts(physics, dimension));
          if (laws.back()->waits() != laws.front()->waits())
            throw base::InputError(std::string("Contacts: those of law ") + laws.front()->name() + " and of law " +
                                   laws.back()->name() +
                                   " are looked for in different ways and cannot be in one specimen. Choose one law "
                                   "for the contacts of all materials (Contacts = linear).");
        }
      return std::make_shared<LawsByPair>(std::move(laws), kinds);
    }

    std::vector<std::shared_ptr<const Concept>> bonding, touching;
    std::vector<std::int32_t>                   kinds;
  };

  LinkMaterials LinkMaterials::by_pair(const std::vector<LinkMaterials> &of_laws,
                                       const std::vector<std::int32_t>  &kinds)
  {
    LinkMaterials all = of_laws.front();
    all.bonding = all.touching = std::make_shared<ByPair>(of_laws, kinds);
    std::vector<bool> unbonded(kinds.size(), false);
    for (std::size_t pair = 0; pair < kinds.size(); ++pair)
      {
        const LinkMaterials &own = of_laws.at(static_cast<std::size_t>(kinds[pair]));
        unbonded[pair]           = (!own.unbonded.empty() && own.unbonded[pair]) || !own.bonds(Physics())->bonds();
      }
    const bool any = std::find(unbonded.begin(), unbonded.end(), true) != unbonded.end();
    all.unbonded   = any ? unbonded : std::vector<bool>();
    return all;
  }

  void check_materials(const Packing &packing, const LinkMaterials &materials)
  {
    for (std::size_t i = 0; i < packing.material.size(); ++i)
      if (packing.material[i] < 0 || static_cast<std::size_t>(packing.material[i]) >= materials.size())
        throw base::InputError("particle " + std::to_string(i + 1) +
                               ": material = " + std::to_string(packing.material[i]) + ": " +
                               std::to_string(materials.size()) + " given, numbered from 0.");
  }

  // tan(atan()) might miss equal ones by a bit
  double mean_friction(const double a, const double b)
  {
    return a == b ? a : std::tan(mean(std::atan(a), std::atan(b)));
  }
} // namespace dem
