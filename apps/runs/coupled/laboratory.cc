#include "apps/runs/coupled/laboratory.h"

#include "apps/runs/continuum/probe_column.h"
#include "apps/text/nearest_name.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    void require(const base::EntryPath          &section,
                 const char                     *entry,
                 const std::string              &name,
                 const std::vector<std::string> &names,
                 const char                     *what)
    {
      if (std::find(names.begin(), names.end(), name) == names.end())
        section.refuse(entry, std::string("there is no such ") + what + ". " + did_you_mean(name, names));
    }
  } // namespace

  void LaboratorySection::check(const base::EntryPath  &root,
                                const CouplingsSection &couplings,
                                const LoadsSection     &loads,
                                const int               dimension) const
  {
    if (!given())
      return;
    const base::EntryPath    section = root.at("Laboratory");
    std::vector<std::string> known, points;
    for (const CouplingSection &coupling : couplings.couplings)
      known.push_back(coupling.name);
    for (const auto &point : loads.points)
      points.push_back(point->name);
    require(section, "High coupling", high, known, "section in Couplings");
    require(section, "Low coupling", low, known, "section in Couplings");
    require(section, "High point", high_point, points, "section in Continuum/Points");
    require(section, "Low point", low_point, points, "section in Continuum/Points");
    if (high == low)
      section.refuse("Low coupling", "is that of the high end. Give each end a coupling of its own.");
    if (axis >= dimension)
      section.refuse("Axis", "in two dimensions the axes are x and y.");
  }

  std::vector<postprocess::SeriesColumn> LaboratorySection::columns() const
  {
    if (!given())
      return {};
    return {{"stress", "Pa"}, {"strain", "-"}};
  }

  std::vector<double> LaboratorySection::read(const std::vector<postprocess::SeriesColumn> &columns,
                                              const std::vector<double>                    &values) const
  {
    if (!given())
      return {};
    const std::string along = std::string("_") + "xyz"[axis];
    const auto        value = [&](const std::string &name) {
      const auto found = std::find_if(columns.begin(), columns.end(), [&](const auto &c) { return c.name == name; });
      return values.at(static_cast<std::size_t>(found - columns.begin()));
    };
    const auto force = [&](const std::string &coupling) { return value(column_name(coupling) + "_force" + along); };
    const auto moved = [&](const std::string &point) { return value("displacement_" + column_name(point) + along); };
    return {(force(high) - force(low)) / (2 * area), (moved(low_point) - moved(high_point)) / length};
  }

  dem::UniaxialFigures LaboratorySection::figures(const postprocess::CsvTable &series)
  {
    const std::vector<double> &strain = series.column("strain"), &stress = series.column("stress");
    dem::CurveFigures          curve;
    for (std::size_t row = 0; row < strain.size(); ++row)
      curve.add(strain[row], stress[row]);
    dem::UniaxialFigures found = curve.figures();
    found.peak_passed          = dem::is_past_peak(found, strain.back(), stress.back(), 0);
    return found;
  }
} // namespace apps
