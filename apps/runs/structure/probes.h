#pragma once

#include "apps/runs/particles/groups.h"
#include "base/entry_path.h"
#include "postprocess/files/series.h"

#include <Eigen/Core>

#include <list>
#include <string>
#include <vector>

namespace apps
{
  /** Sub-section of "Probes": the mean displacement of a group of particles, or that against another group. */
  struct DisplacementProbe
  {
    std::string name, group = GroupNames::all, other;
    int         axis = 0;
  };

  /** Section "Probes" of a structure. */
  struct DisplacementProbesSection
  {
    std::list<DisplacementProbe> probes;

    /** @throws base::InputError */
    void check(const base::EntryPath &root, int dimension, const GroupNames &names) const;

    const DisplacementProbe *find(const std::string &name) const; ///< null: there is none of this name
    std::vector<std::string> names() const;

    std::vector<postprocess::SeriesColumn> columns() const;
    /** @param displacement of each particle [m] */
    std::vector<double> read(const std::vector<Eigen::Vector3d> &displacement, const ParticleGroups &groups) const;
  };
} // namespace apps
