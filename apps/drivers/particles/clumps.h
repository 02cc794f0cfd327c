#pragma once

#include "apps/drivers/particles/groups.h"
#include "apps/scene/section.h"
#include "dem/specimen/specimen.h"

#include <functional>
#include <list>
#include <string>

namespace apps
{
  /** Sub-section of "Clumps": particles of a group that move as one rigid body. */
  struct ClumpSection
  {
    std::string group;
    double      mass = 0; ///< [kg]; 0: that of its particles together
    double      inertia =
      0; ///< about its centre, in the plane [kg m^2]; 0: that of its particles, in proportion to the mass
  };

  /** Section "Clumps". */
  struct ClumpsSection
  {
    std::list<ClumpSection> clumps;

    void declare(Section &root);
    /** @throws base::InputError. */
    void validate(const Section &root, int dimension, const GroupNames &names) const;
    /** Whether two particles are of one clump. @param particles how many there are of all */
    std::function<bool(std::size_t, std::size_t)> one_body(const ParticleGroups &groups, std::size_t particles) const;
    /** Before anything is held. @throws base::InputError as dem::Specimen::add_clump(), naming the group */
    void make(dem::Specimen &specimen, const ParticleGroups &groups) const;
  };
} // namespace apps
