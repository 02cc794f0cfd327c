#pragma once

#include "apps/models/region.h"
#include "apps/runs/particles/group_names.h"
#include "base/entry_path.h"
#include "dem/model/packing.h"

#include <list>
#include <map>
#include <string>
#include <vector>

namespace apps
{
  /** Particles by the name of their group: packing numbers, sorted. */
  using ParticleGroups = std::map<std::string, std::vector<std::size_t>, OrderOfNames>;

  /** Sub-section of "Groups": particles that other sections speak of by its name. */
  struct GroupSection
  {
    enum class Members
    {
      region,
      layer,
      file
    };

    std::string name;
    Members     members = Members::region;
    Region      region;
    int         axis      = 2;
    bool        high      = false; ///< the layer at the end of the largest coordinate
    double      thickness = 0;     ///< of the layer [m]
    std::string file;

    /** @throws base::InputError. */
    void                     check(const base::EntryPath &section, int dimension) const;
    std::vector<std::size_t> find(const dem::Packing &packing, int dimension) const;
  };

  /** Section "Groups". */
  struct GroupsSection
  {
    std::list<GroupSection> groups;

    /** @param names known already; those of this section are added. @throws base::InputError. */
    void check(const base::EntryPath &root, int dimension, GroupNames &names) const;
    /** Add the groups of this section, and that of all. @throws base::InputError for a group without particles */
    void find(const dem::Packing &packing, int dimension, ParticleGroups &found) const;
  };

  /** "all 175, top 25" */
  std::string text_of(const ParticleGroups &groups);
} // namespace apps
