#include "apps/runs/structure/probes.h"

#include "apps/runs/continuum/probe_column.h"

#include <algorithm>

namespace apps
{
  void DisplacementProbesSection::check(const base::EntryPath &root, const int dimension, const GroupNames &names) const
  {
    for (const DisplacementProbe &probe : probes)
      {
        const base::EntryPath s = root.at("Probes").at(probe.name);
        if (probe.name.find_first_of(",\"") != std::string::npos)
          s.refuse("a name without commas and quotes, please: it is a column of series.csv.");
        names.require(s, "Group", probe.group);
        if (!probe.other.empty())
          names.require(s, "Other group", probe.other);
        if (probe.axis >= dimension)
          s.refuse("Component", "in two dimensions the axes are x and y.");
      }
  }

  const DisplacementProbe *DisplacementProbesSection::find(const std::string &name) const
  {
    const auto found =
      std::find_if(probes.begin(), probes.end(), [&](const DisplacementProbe &probe) { return probe.name == name; });
    return found == probes.end() ? nullptr : &*found;
  }

  std::vector<std::string> DisplacementProbesSection::names() const
  {
    std::vector<std::string> all;
    for (const DisplacementProbe &probe : probes)
      all.push_back(probe.name);
    return all;
  }

  std::vector<postprocess::SeriesColumn> DisplacementProbesSection::columns() const
  {
    std::vector<postprocess::SeriesColumn> all;
    for (const DisplacementProbe &probe : probes)
      all.push_back({column_name(probe.name), "m"});
    return all;
  }

  std::vector<double> DisplacementProbesSection::read(const std::vector<Eigen::Vector3d> &displacement,
                                                      const ParticleGroups               &groups) const
  {
    const auto mean = [&](const std::string &group, const int axis) {
      double      sum     = 0;
      const auto &members = groups.at(group);
      for (const std::size_t i : members)
        sum += displacement[i][axis];
      return sum / static_cast<double>(members.size());
    };
    std::vector<double> values;
    for (const DisplacementProbe &probe : probes)
      values.push_back(mean(probe.group, probe.axis) - (probe.other.empty() ? 0.0 : mean(probe.other, probe.axis)));
    return values;
  }
} // namespace apps
