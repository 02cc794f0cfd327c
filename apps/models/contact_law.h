#pragma once

#include "base/entry_path.h"
#include "dem/laws/linear_contact.h"
#include "dem/laws/registry.h"

#include <map>
#include <memory>
#include <string>

namespace apps
{
  /** How particles touch a wall or the surface of a body: linear contacts, or another law that has nothing but contacts. */
  struct ContactLaw
  {
    dem::LinearContactParameters                               linear;
    const dem::LinkLawKind                                    *other = nullptr; ///< nullptr: linear
    std::map<std::string, std::shared_ptr<dem::LinkConstants>> constants;       ///< of every other law, by its name

    /** From code: a law by its constants, e.g. dem::HertzMindlinParameters. */
    template <typename Parameters>
    void choose(const Parameters &parameters)
    {
      using Law            = typename Parameters::Law;
      other                = dem::find_link_law(Law::name);
      constants[Law::name] = dem::LinkLawKindOf<Law>::constants_of(parameters);
    }
    /** @throws base::InputError for constants that the law cannot have */
    void               check(const base::EntryPath &at) const;
    dem::LinkMaterials materials() const;
  };
} // namespace apps
