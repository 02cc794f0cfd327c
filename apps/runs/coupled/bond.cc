#include "apps/runs/coupled/bond.h"

namespace apps
{
  void BondSection::check(const base::EntryPath &coupling) const
  {
    if (law == nullptr)
      return;
    try
      {
        constants.at(law->name())->check();
      }
    catch (const base::InputError &refusal)
      {
        coupling.at("Bond").refuse_within(refusal.what());
      }
  }

  std::shared_ptr<const dem::LinkLaw> BondSection::links(const dem::Physics &physics) const
  {
    if (law == nullptr)
      return nullptr;
    return law->materials({{"", constants.at(law->name()).get(), 0}}).bonds(physics);
  }
} // namespace apps
