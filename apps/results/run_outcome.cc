#include "apps/results/run_outcome.h"

#include "apps/text/nearest_name.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace
  {
    bool holds(const std::vector<std::string> &names, const std::string &name)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }
  } // namespace

  std::string no_such_figure(const std::string &path, const std::vector<std::string> &known)
  {
    return "there is no figure " + path + ". " + did_you_mean(path, known) +
           fmt::format(" Figures: {}.", known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")));
  }

  void RunOutcome::demand_figure(const std::string &path) const
  {
    if (!holds(figures, path))
      throw base::InputError(no_such_figure(path, figures));
  }

  void RunOutcome::demand_column(const std::string &name) const
  {
    if (!has_column(name))
      throw base::InputError("series.csv has no column " + name + ". " + did_you_mean(name, columns) +
                             fmt::format(" Columns: {}.", fmt::join(columns, ", ")));
  }

  void RunOutcome::set_columns(const std::vector<postprocess::SeriesColumn> &series)
  {
    columns.clear();
    for (const postprocess::SeriesColumn &column : series)
      columns.push_back(column.name);
  }

  bool RunOutcome::has_column(const std::string &name) const { return holds(columns, name); }

  void RunOutcome::add_figures(const std::vector<std::string> &names)
  {
    figures.insert(figures.end(), names.begin(), names.end());
  }

  void RunOutcome::add_figures_of_column(const std::string &name)
  {
    for (const char *part : {"/end", "/largest", "/least"})
      figures.push_back(name + part);
  }
} // namespace apps
