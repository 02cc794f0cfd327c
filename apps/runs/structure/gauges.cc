#include "apps/runs/structure/gauges.h"

#include "apps/runs/continuum/gauge_column.h"

namespace apps
{
  void DisplacementGaugesSection::check(const base::EntryPath &root, const int dimension, const GroupNames &names) const
  {
    for (const DisplacementGauge &gauge : gauges)
      {
        const base::EntryPath s = root.at("Probes").at(gauge.name);
        if (gauge.name.find_first_of(",\"") != std::string::npos)
          s.refuse("a name without commas and quotes, please: it is a column of series.csv.");
        names.require(s, "Group", gauge.group);
        if (!gauge.other.empty())
          names.require(s, "Other group", gauge.other);
        if (gauge.axis >= dimension)
          s.refuse("Component", "in two dimensions the axes are x and y.");
      }
  }

  std::vector<postprocess::SeriesColumn> DisplacementGaugesSection::columns() const
  {
    std::vector<postprocess::SeriesColumn> all;
    for (const DisplacementGauge &gauge : gauges)
      all.push_back({column_name(gauge.name), "m"});
    return all;
  }

  std::vector<double> DisplacementGaugesSection::read(const std::vector<Eigen::Vector3d> &displacement,
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
    for (const DisplacementGauge &gauge : gauges)
      values.push_back(mean(gauge.group, gauge.axis) - (gauge.other.empty() ? 0.0 : mean(gauge.other, gauge.axis)));
    return values;
  }
} // namespace apps
