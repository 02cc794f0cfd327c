#include "dem/observation/specimen_damage.h"

namespace dem
{
  CohesiveDamage cohesive_damage(const LinkOutput &links)
  {
    CohesiveDamage result;
    for (std::size_t l = 0; l < links.ends.size(); ++l)
      if (links.kind[l] != LinkOutput::contact)
        {
          result.ends.push_back(links.ends[l]);
          result.links.push_back({links.load[l].branch.normalized(), links.strength_damage[l]});
          result.contact.push_back(links.load[l].contact);
        }
    return result;
  }
} // namespace dem
