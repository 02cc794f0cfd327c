#include "apps/commands/command.h"
#include "apps/process/exit_status.h"
#include "apps/results/folder_reading.h"
#include "apps/results/series_panels.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace apps
{
  namespace
  {
    struct PlotOptions
    {
      std::string              folder, horizontal, picture;
      std::vector<std::string> verticals;
      bool                     together = false;
    };

    std::vector<postprocess::PlotPanel> panels_requested(const PlotOptions           &options,
                                                         const postprocess::CsvTable &series)
    {
      const std::string horizontal = options.horizontal.empty() ? abscissa_of(series) : options.horizontal;
      if (options.verticals.empty() && options.horizontal.empty())
        return panels_of_series(series);
      if (options.verticals.empty())
        throw base::InputError("-x wants columns to draw over it: -y A,B,...");
      if (options.together)
        return {panel_of_columns(series, horizontal, options.verticals)};
      std::vector<postprocess::PlotPanel> panels;
      for (const std::string &vertical : options.verticals)
        panels.push_back(panel_of_columns(series, horizontal, {vertical}));
      return panels;
    }

    int draw_series(const PlotOptions &options)
    {
      const postprocess::CsvTable series = read_result(options.folder).series;
      if (series.names.empty())
        throw base::InputError(options.folder + ": this run has no series.csv.");
      const std::filesystem::path picture = options.picture.empty() ?
                                              std::filesystem::path(options.folder) / "plot.png" :
                                              std::filesystem::path(options.picture);
      const std::string           problem = postprocess::plot(picture, panels_requested(options, series));
      if (!problem.empty())
        throw base::InputError(picture.string() + ": " + problem);
      fmt::print("{}\n", picture.string());
      return exit_success;
    }
  } // namespace

  void add_plot(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<PlotOptions>();
    CLI::App  &command = *program.add_subcommand("plot", "Draw the series of a run, again and with other columns");
    command.footer(
      "Without -x and -y: every column that changes, over time. Columns by their names in series.csv, without units.");
    command.add_option("folder", options->folder, "Results of a run")->required()->type_name("DIR");
    command.add_option("-x", options->horizontal, "Column to draw over; default: time")->type_name("NAME");
    command.add_option("-y", options->verticals, "Columns to draw, each in a panel of its own")
      ->delimiter(',')
      ->type_name("A,B,...");
    command.add_flag("--together", options->together, "Columns of one unit in one panel");
    command.add_option("-o,--output", options->picture, "The picture; default: DIR/plot.png")->type_name("FILE.png");
    command.callback([options, &chosen] { chosen = [options] { return draw_series(*options); }; });
  }
} // namespace apps
