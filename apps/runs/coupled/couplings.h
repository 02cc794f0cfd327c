#pragma once

#include "apps/models/contact_law.h"
#include "apps/runs/continuum/model.h"
#include "apps/runs/coupled/bond.h"
#include "apps/runs/particles/groups.h"
#include "base/entry_path.h"
#include "coupling/surface/surface_coupling.h"

#include <functional>
#include <list>
#include <string>
#include <vector>

namespace apps
{
  /** Sub-section of "Couplings": particles on a part of the boundary of the solid. */
  struct CouplingSection
  {
    std::string              name;
    std::vector<std::string> boundaries; ///< names of parts; none: all of it
    std::vector<std::string> groups;     ///< names; none: all particles
    ContactLaw               contact;
    bool                     pressure     = false;                          ///< on areas, not at points
    double                   skin         = 0;                              ///< [m]; 0: by the size of the facets
    coupling::Spreading      spreading    = coupling::Spreading::automatic; ///< of points
    double                   energy_limit = 0.01; ///< that it may make, over the largest energy
    BondSection              bond;

    /** Packing numbers, sorted; none: all. @pre validated */
    std::vector<std::size_t> particles(const ParticleGroups &of_all) const;
  };

  /** Section "Couplings". */
  struct CouplingsSection
  {
    std::list<CouplingSection> couplings;

    /** @param alone nothing else couples. @throws base::InputError where nothing is coupled, or a group that is not there */
    void check(const base::EntryPath &root, const GroupNames &groups, bool alone) const;
    /** @param same whether two names are of one boundary. @throws base::InputError where two would push a particle from one face, twice */
    void refuse_shared(const ParticleGroups                                                  &groups,
                       const std::function<bool(const std::string &a, const std::string &b)> &same) const;
  };
} // namespace apps
