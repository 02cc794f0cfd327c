#pragma once

#include "apps/runs/particles/groups.h"
#include "apps/text/corner_list.h"
#include "base/entry_path.h"
#include "dem/genesis/convex_body.h"
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
    CornerList  corners; ///< of the shape that its particles stand for; empty: they are the body
    bool inside = false; ///< particles whose centre lies in the shape; otherwise those of a group that there is already
    double mass = 0;     ///< [kg]; 0: that of the shape, or of its particles together
    double inertia = 0;  ///< about its centre, in the plane [kg m^2]; 0: likewise, in proportion to the mass

    bool has_shape() const { return !corners.empty(); }
    /** @pre has_shape() @throws base::InputError */
    dem::ConvexBody shape(int dimension) const;
  };

  /** Section "Clumps". */
  struct ClumpsSection
  {
    std::list<ClumpSection> clumps;

    /** @param names takes those of shapes whose pebbles lie inside. @throws base::InputError. */
    void check(const base::EntryPath &root, int dimension, GroupNames &names) const;
    /** Add the groups of shapes whose pebbles are what lies inside. @throws base::InputError for one with fewer than three */
    void find_pebbles(const dem::Packing &packing, int dimension, ParticleGroups &found) const;
    /** Whether two particles are of one clump. @param particles how many there are of all */
    std::function<bool(std::size_t, std::size_t)> one_body(const ParticleGroups &groups, std::size_t particles) const;
    /** Before anything is held. @throws base::InputError as dem::Specimen::add_clump(), naming the group */
    void make(dem::Specimen &specimen, const ParticleGroups &groups) const;
  };
} // namespace apps
