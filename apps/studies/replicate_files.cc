#include "apps/figures/summary_head.h"
#include "apps/process/progress.h"
#include "apps/results/warning.h"
#include "apps/studies/replicate_picture.h"
#include "apps/studies/replicate_statistics.h"
#include "apps/studies/replicates.h"
#include "base/errors.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/summary.h"
#include "postprocess/pictures/drawn_unit.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace apps
{
  namespace
  {
    nlohmann::json json_of(const ReplicatedFigure &figure)
    {
      nlohmann::json json;
      if (figure.determined().empty())
        json = {{"value", nullptr}, {"unit", figure.unit}, {"not_determined", figure.not_determined}};
      else
        json = quantity(figure.mean(), figure.unit);
      json["values"] = nlohmann::json::array();
      for (const std::optional<double> &value : figure.values)
        json["values"].push_back(value ? nlohmann::json(*value) : nlohmann::json(nullptr));
      if (const std::optional<double> deviation = figure.standard_deviation())
        json["standard_deviation"] = *deviation;
      return json;
    }

    /** Of the runs, each once with the numbers of those that say so, and what fails or is missing. */
    std::vector<std::string> doubts_about(const ReplicatedRuns &runs, const std::vector<ReplicatedFigure> &figures)
    {
      std::vector<std::string>                        sentences;
      std::map<std::string, std::vector<std::size_t>> said;
      for (std::size_t k = 0; k < runs.results.size(); ++k)
        if (!runs.messages[k].empty())
          sentences.push_back(fmt::format("replicate {} failed: {}", k + 1, runs.messages[k]));
        else
          for (const std::string &sentence : runs.results[k].warnings())
            said[sentence].push_back(k + 1);
      for (const auto &[sentence, numbers] : said)
        sentences.push_back(
          fmt::format("replicate{} {}: {}", numbers.size() > 1 ? "s" : "", fmt::join(numbers, ", "), sentence));
      for (const ReplicatedFigure &figure : figures)
        if (const std::size_t count = figure.determined().size(); count > 0 && count < runs.results.size())
          sentences.push_back(fmt::format("{}: of {} of {} replicates alone", figure.path, count, runs.results.size()));
      return sentences;
    }

    std::vector<RunResult> succeeded(const ReplicatedRuns &runs)
    {
      std::vector<RunResult> found;
      for (std::size_t k = 0; k < runs.results.size(); ++k)
        if (runs.messages[k].empty())
          found.push_back(runs.results[k]);
      return found;
    }

    /** A row for each run: its seeds, and every figure. */
    postprocess::CsvTable table_of_replicates(const ReplicatedRuns &runs)
    {
      postprocess::CsvTable table;
      const auto            add = [&table](const std::string &name, const std::string &unit) -> std::vector<double>            &{
        table.names.push_back(name);
        table.units.push_back(unit);
        return table.columns.emplace_back();
      };
      std::vector<double> &numbers = add("replicate", "");
      for (std::size_t k = 0; k < runs.results.size(); ++k)
        numbers.push_back(static_cast<double>(k + 1));
      for (const SceneSeed &seed : runs.seeds)
        {
          std::vector<double> &column = add(seed.entry, "");
          for (std::size_t k = 0; k < runs.results.size(); ++k)
            column.push_back(static_cast<double>(seed.value) + static_cast<double>(k));
        }
      for (const ReplicatedFigure &figure : replicated_figures(runs.results))
        {
          std::vector<double> &column = add(figure.path, figure.unit);
          for (const std::optional<double> &value : figure.values)
            column.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
        }
      return table;
    }

    void write_band(const std::filesystem::path &file, const ReplicatedSeries &band)
    {
      postprocess::SeriesWriter writer(file, band.columns);
      for (std::size_t row = 0; row < band.table.rows(); ++row)
        {
          std::vector<double> values;
          for (const std::vector<double> &column : band.table.columns)
            values.push_back(column[row]);
          writer.append(band.tests.empty() ? std::vector<std::string>() : std::vector<std::string>{band.tests[row]},
                        values);
        }
      writer.flush();
    }

    /** Areas and volumes without a prefix, which would have a power, too. */
    postprocess::DrawnUnit unit_in_words(const ReplicatedFigure &figure)
    {
      if (figure.unit.rfind("m^", 0) == 0)
        return {1, " [" + figure.unit + "]"};
      return postprocess::drawn_unit(figure.mean(), figure.unit);
    }

    /** "3.858 MPa, deviation 0.05 MPa (1.3 %), 3.8 to 3.9" */
    std::string line_of(const ReplicatedFigure &figure)
    {
      const std::vector<double> values = figure.determined();
      if (values.empty())
        return fmt::format("{:<28} not determined: {}\n", figure.path, figure.not_determined);
      const auto        drawn  = unit_in_words(figure);
      const std::string unit   = drawn.label.empty() ? "" : " " + drawn.label.substr(2, drawn.label.size() - 3);
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      std::string text         = fmt::format("{:<28} {:.4g}{}", figure.path, drawn.scale * figure.mean(), unit);
      if (const std::optional<double> deviation = figure.standard_deviation(); deviation && *deviation > 0)
        text += fmt::format(", deviation {:.2g}{} ({:.1f} %), {:.4g} to {:.4g}", drawn.scale * *deviation, unit,
                            100 * *deviation / std::fabs(figure.mean()), drawn.scale * *least, drawn.scale * *most);
      return text + "\n";
    }
  } // namespace

  nlohmann::json summary_of(const CheckedScene &scene, const RunRequest &request, const ReplicatedRuns &runs)
  {
    nlohmann::json summary                    = summary_head(request, scene.kind);
    summary["requested"]["replicates"]        = scene.replicates;
    const std::vector<ReplicatedFigure> found = replicated_figures(runs.results);
    for (const ReplicatedFigure &figure : found)
      summary["figures"][nlohmann::json::json_pointer("/" + figure.path)] = json_of(figure);
    summary["warnings"] = doubts_about(runs, found);
    summary["cost"]     = {{"runs", runs.results.size()},
                           {"failed", runs.failed()},
                           {"wall_seconds", std::accumulate(runs.seconds.begin(), runs.seconds.end(), 0.0)}};
    for (std::size_t k = 0; k < runs.results.size(); ++k)
      {
        nlohmann::json run = {{"folder", folder_of_replicate("", static_cast<long>(k)).string()},
                              {"changes", changes_of_replicate(runs.seeds, static_cast<long>(k))},
                              {"wall_seconds", runs.seconds[k]}};
        if (!runs.messages[k].empty())
          run["message"] = runs.messages[k];
        summary["replicates"].push_back(run);
      }
    return summary;
  }

  void write_replicates(const std::filesystem::path &folder,
                        const CheckedScene          &scene,
                        const nlohmann::json        &summary,
                        const ReplicatedRuns        &runs)
  {
    const std::vector<RunResult>       whole = succeeded(runs);
    std::vector<postprocess::CsvTable> series;
    std::optional<ReplicatedSeries>    band;
    for (const RunResult &run : whole)
      series.push_back(run.series);
    if (!abscissa_of_band(series.front()).empty())
      try
        {
          band = replicated_series(series);
          write_band(folder / "series.csv", *band);
        }
      catch (const base::InputError &problem)
        {
          warn_of_missing("series.csv", problem.what());
        }
    postprocess::write_text(folder / "replicates.csv", postprocess::csv_text(table_of_replicates(runs)));
    warn_of_missing("replicates.png", draw_replicates(folder / "replicates.png", scene, whole, band));
    postprocess::write_json(folder / "summary.json", summary);
  }

  std::string words_of(const ReplicatedRuns &runs)
  {
    std::string text = fmt::format("replicates   {}, {} failed, {} together\n", runs.results.size(), runs.failed(),
                                   duration_text(std::accumulate(runs.seconds.begin(), runs.seconds.end(), 0.0)));
    const std::vector<ReplicatedFigure> found = replicated_figures(runs.results);
    for (const ReplicatedFigure &figure : found)
      text += line_of(figure);
    return text + warning_lines(doubts_about(runs, found));
  }
} // namespace apps
