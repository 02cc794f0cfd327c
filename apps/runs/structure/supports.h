#pragma once

#include "apps/runs/particles/groups.h"
#include "apps/text/vector_formula.h"
#include "base/entry_path.h"
#include "dem/network/loaded_network.h"

#include <list>
#include <string>

namespace apps
{
  /** Sub-section of "Supports": a group of particles that is held, or driven in proportion to the load factor. */
  struct ParticleSupport
  {
    std::string group;
    Expressions displacement; ///< at the load factor t [m]
    bool        spins = true;

    /** Whether a component is prescribed. */
    bool drives(const int axis) const { return displacement[static_cast<std::size_t>(axis)].given(); }
  };

  /** Section "Supports". */
  struct ParticleSupportsSection
  {
    std::list<ParticleSupport> supports;

    /** @throws base::InputError for a group or an axis that there is not, or a displacement that is not in proportion to t */
    void check(const base::EntryPath &root, int dimension, const GroupNames &names) const;
    /** @throws base::InputError where two supports drive one particle along the same axis */
    void drive(dem::LoadedNetwork &loaded, const ParticleGroups &groups) const;
  };
} // namespace apps
