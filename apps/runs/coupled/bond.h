#pragma once

#include "base/entry_path.h"
#include "dem/laws/registry.h"
#include "dem/model/physics.h"

#include <map>
#include <memory>
#include <string>

namespace apps
{
  /** Sub-section "Bond" of a coupling: particles that are glued to the faces at the start. */
  struct BondSection
  {
    double                  within = 0;       ///< gaps up to this are glued [m]; 0: nothing is
    const dem::LinkLawKind *law    = nullptr; ///< of the glue; none: that of the particles
    std::map<std::string, std::shared_ptr<dem::LinkConstants>> constants; ///< of every law, by its name

    bool given() const { return within > 0; }
    /** Rules between the constants. @throws base::InputError */
    void check(const base::EntryPath &coupling) const;
    /** nullptr: that of the particles. @pre validated */
    std::shared_ptr<const dem::LinkLaw> links(const dem::Physics &physics) const;
  };
} // namespace apps
