#include "apps/models/contact_law.h"

namespace apps
{
  namespace
  {
  } // namespace

  void ContactLaw::check(const base::EntryPath &section) const
  {
    try
      {
        if (other)
          constants.at(other->name())->check();
        else
          dem::LinearContactLaw::check(linear);
      }
    catch (const base::InputError &error)
      {
        section.refuse("Law", error.what());
      }
  }

  dem::LinkMaterials ContactLaw::materials() const
  {
    if (!other)
      return linear;
    return other->materials({{"", constants.at(other->name()).get(), 0}});
  }
} // namespace apps
