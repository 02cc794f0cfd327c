#pragma once

#include "base/entry_path.h"
#include "dem/laws/registry.h"
#include "dem/laws/scaled_constants.h"

#include <list>
#include <map>
#include <memory>
#include <string>

namespace apps
{
  struct NamedMaterial;

  /** Sub-section of "Interfaces": links between two materials with constants, perhaps a law, of their own. */
  struct MaterialInterface
  {
    /** Where the constants come from. */
    enum class Constants
    {
      own,    ///< the block of the law
      factors ///< the first material's, times `factors` (doc/theory/mesostructure.md, 5)
    };

    std::string             name, one, other; ///< of the section, and of the materials
    const dem::LinkLawKind *law    = nullptr; ///< nullptr: that of the materials
    bool                    bonded = true;
    Constants               from   = Constants::own;
    dem::ConstantFactors    factors;
    std::map<std::string, std::shared_ptr<dem::LinkConstants>> constants; ///< of every law, by its name

    /** Law of its links; with factors that of the first material. nullptr where none is chosen and the materials have different ones. */
    const dem::LinkLawKind *law_among(const std::list<NamedMaterial> &materials) const;

    /**
     * Constants of its links by that law, or by the law of contacts, of which factors change the moduli alone.
     * @pre a material of the list has the name `one` @throws base::InputError for a factor that the law has no constant for
     */
    std::shared_ptr<dem::LinkConstants> constants_by(const dem::LinkLawKind         &kind,
                                                     const std::list<NamedMaterial> &materials) const;

    /** @param section of the interface @throws base::InputError naming the entry */
    void check(const base::EntryPath &section, const std::list<NamedMaterial> &materials) const;
  };
} // namespace apps
