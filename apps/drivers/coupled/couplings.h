#pragma once

#include "apps/drivers/continuum/model.h"
#include "dem/laws/linear_contact.h"

#include <list>
#include <string>
#include <vector>

namespace apps
{
  /** Sub-section of "Couplings": particles on a part of the boundary of the solid. */
  struct CouplingSection
  {
    std::string                  name;
    std::string                  boundary; ///< names, separated by commas; "": all of it
    dem::LinearContactParameters contact;
    bool                         pressure     = false; ///< on areas, not at points
    double                       skin         = 0;     ///< [m]; 0: by the size of the facets
    double                       energy_limit = 0.01;  ///< that it may make, over the largest energy

    void                     declare(Section &section);
    std::vector<std::string> boundaries() const;
  };

  /** Section "Couplings". */
  struct CouplingsSection
  {
    std::list<CouplingSection> couplings;

    void declare(Section &root);
    /** @throws dem::InputError where nothing is coupled */
    void validate(const Section &root) const;
  };
} // namespace apps
