#include "dem/model/materials.h"

#include "base/errors.h"
#include "dem/model/laws_by_pair.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

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
      return std::make_shared<LawsByPair>(bonds_by_kind(physics, dimension), kinds);
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
                                   " are sought in different ways and cannot be in one specimen. Choose one law "
                                   "for the contacts of all materials (Contacts = linear).");
        }
      return std::make_shared<LawsByPair>(std::move(laws), kinds);
    }

    std::vector<std::shared_ptr<const LinkLaw>> bonds_by_kind(const Physics &physics,
                                                              const int      dimension) const override
    {
      std::vector<std::shared_ptr<const LinkLaw>> laws;
      for (const auto &each : bonding)
        laws.push_back(each->bonds(physics, dimension));
      return laws;
    }
    std::vector<std::int32_t> kinds_of_bonds() const override { return kinds; }

    std::vector<std::shared_ptr<const Concept>> bonding, touching;
    std::vector<std::int32_t>                   kinds;
  };

  /** Bonds of materials, and those of joints through them. */
  struct LinkMaterials::Jointed : LinkMaterials::Concept
  {
    Jointed(std::shared_ptr<const Concept> of_materials,
            std::shared_ptr<const Concept> of_joints,
            const std::size_t              material_pairs,
            const std::size_t              joints)
      : whole(std::move(of_materials))
      , cut(std::move(of_joints))
      , kinds(whole->kinds_of_bonds())
    {
      kinds.resize(material_pairs, 0);
      const std::int32_t last = kinds.empty() ? 0 : *std::max_element(kinds.begin(), kinds.end());
      kinds.resize(material_pairs + joints, last + 1);
    }
    std::shared_ptr<const LinkLaw> bonds(const Physics &physics, const int dimension) const override
    {
      std::vector<std::shared_ptr<const LinkLaw>> laws = whole->bonds_by_kind(physics, dimension);
      laws.push_back(cut->bonds(physics, dimension));
      return std::make_shared<LawsByPair>(std::move(laws), kinds);
    }
    std::shared_ptr<const LinkLaw> contacts(const Physics &physics, const int dimension) const override
    {
      return whole->contacts(physics, dimension);
    }

    std::shared_ptr<const Concept> whole, cut;
    std::vector<std::int32_t>      kinds; ///< of all pairs
  };

  LinkMaterials LinkMaterials::jointed(std::shared_ptr<const Concept> of_joints, const std::size_t count) const
  {
    LinkMaterials all = *this;
    all.bonding =
      std::make_shared<Jointed>(bonding, std::move(of_joints), static_cast<std::size_t>(material_pairs()), count);
    all.joint_count = count;
    return all;
  }

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
    if (!packing.cuts.empty() && packing.periodic_cell)
      throw base::InputError("Joints: they cut through a body, and a periodic cell has no end to them.");
    for (const JointCut &cut : packing.cuts)
      if (cut.joint < 0 || static_cast<std::size_t>(cut.joint) >= materials.joints() || !(cut.area > 0))
        throw std::logic_error("a cut of a packing is of no joint, or without area");
  }

  // tan(atan()) might miss equal ones by a bit
  double mean_friction(const double a, const double b)
  {
    return a == b ? a : std::tan(mean(std::atan(a), std::atan(b)));
  }
} // namespace dem
