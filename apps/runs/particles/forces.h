#pragma once

#include "apps/runs/particles/groups.h"
#include "apps/text/vector_formula.h"
#include "base/entry_path.h"
#include "dem/specimen/specimen.h"

#include <list>
#include <string>
#include <vector>

namespace apps
{
  /** Sub-section of "Forces": on each particle of a group. */
  struct GroupForce
  {
    std::string group;
    Expressions force; ///< [N]
  };

  /** Section "Forces": that push particles from outside. */
  struct ForcesSection
  {
    std::list<GroupForce> forces;

    /** @throws base::InputError. */
    void check(const base::EntryPath &root, int dimension, const GroupNames &names) const;
  };

  /** Pushes the particles of a specimen as a scene says. Both must outlive it. */
  class AppliedForces
  {
  public:
    AppliedForces(dem::Specimen &specimen, const ForcesSection &section, const ParticleGroups &groups);

    bool empty() const { return forces.empty(); }
    /** Forces where the particles are now. */
    void apply();

  private:
    dem::Specimen          *specimen;
    std::vector<GroupForce> forces;
    const ParticleGroups   *groups;
  };
} // namespace apps
