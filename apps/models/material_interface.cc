#include "apps/models/material_interface.h"

#include "apps/models/material.h"
#include "base/errors.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    const NamedMaterial &named_material(const std::list<NamedMaterial> &materials, const std::string &name)
    {
      return *std::find_if(materials.begin(), materials.end(),
                           [&name](const NamedMaterial &material) { return material.name == name; });
    }
  } // namespace

  const dem::LinkLawKind *MaterialInterface::law_among(const std::list<NamedMaterial> &materials) const
  {
    if (law != nullptr)
      return law;
    const dem::LinkLawKind *found = nullptr;
    for (const NamedMaterial &material : materials)
      if (material.name == one || (material.name == other && from == Constants::own))
        {
          if (found != nullptr && found != material.law.law)
            return nullptr;
          found = material.law.law;
        }
    return found;
  }

  std::shared_ptr<dem::LinkConstants> MaterialInterface::constants_by(const dem::LinkLawKind         &kind,
                                                                      const std::list<NamedMaterial> &materials) const
  {
    if (from == Constants::own)
      return constants.at(kind.name());
    const LinkLaw       &base = named_material(materials, one).law;
    dem::ConstantFactors by   = factors;
    if (&kind != base.law) // the law of contacts
      by = {factors.stiffness, 1, 1};
    return dem::scaled(*base.constants.at(kind.name()), by);
  }

  void MaterialInterface::check(const base::EntryPath &section, const std::list<NamedMaterial> &materials) const
  {
    const dem::LinkLawKind *of = law_among(materials);
    if (of == nullptr)
      section.refuse("Law", "the two materials have different ones: choose that of the links between them.");
    if (from == Constants::factors && of != named_material(materials, one).law.law)
      section.refuse("Law", "with Constants = factors it is that of " + one +
                              ", whose constants are multiplied. Leave it out.");
    try
      {
        constants_by(*of, materials)->check();
      }
    catch (const base::InputError &refusal)
      {
        section.refuse_within(refusal.what());
      }
  }
} // namespace apps
