#include "dem/observation/specimen_damage.h"

namespace dem
{
  LinkDamage damage_of(const LinkOutput &links, const std::size_t l)
  {
    return {links.load[l].branch.normalized(), links.strength_damage[l]};
  }

  CohesiveDamage cohesive_damage(const LinkOutput &links)
  {
    CohesiveDamage result;
    for (std::size_t l = 0; l < links.ends.size(); ++l)
      if (links.kind[l] != LinkOutput::contact)
        {
          result.ends.push_back(links.ends[l]);
          result.links.push_back(damage_of(links, l));
          result.contact.push_back(links.load[l].contact);
        }
    return result;
  }
} // namespace dem
