#include "apps/commands/command.h"
#include "apps/process/exit_status.h"
#include "apps/results/result_folder.h"
#include "apps/studies/analysis_files.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/summary.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <memory>

namespace apps
{
  namespace
  {
    const std::map<std::string, AnalysisModel> models = {{"range", AnalysisModel::range},
                                                         {"anova", AnalysisModel::anova},
                                                         {"linear", AnalysisModel::linear},
                                                         {"quadratic", AnalysisModel::quadratic}};

    const std::map<std::string, NullColumn> treatments = {
      {"factor", NullColumn::factor}, {"pooled", NullColumn::pooled}, {"error", NullColumn::error}};

    struct AnalyseOptions
    {
      std::string              table, response, folder, model = "quadratic", null_as = "factor";
      std::vector<std::string> factors;
      AnalysisOptions          analysis;
    };

    int analyse_table(AnalyseOptions options)
    {
      options.analysis.model   = models.at(options.model);
      options.analysis.null_as = treatments.at(options.null_as);
      const Analysis analysis  = analyse(select(options.table, options.response, options.factors), options.analysis);
      fmt::print("{}", words_of(analysis));
      if (options.folder.empty())
        return exit_success;
      ResultFolder folder(options.folder, ResultFolder::Start::afresh);
      postprocess::write_json(folder.running() / "analysis.json", json_of(analysis));
      postprocess::write_text(folder.running() / "analysis.csv", csv_of(analysis));
      if (analysis.fit())
        postprocess::write_text(folder.running() / "residuals.csv", residuals_csv_of(analysis));
      draw(analysis, folder.running());
      postprocess::write_text(folder.running() / "report.html", report_of(analysis, folder.running()));
      folder.publish();
      fmt::print("\nwritten to {}: report.html, analysis.json, tables and pictures\n", options.folder);
      return exit_success;
    }
  } // namespace

  void add_analyse(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<AnalyseOptions>();
    CLI::App  &command = *program.add_subcommand(
       "analyse", "What a table of runs says: check of the array, ranges, variance, response surface");
    command.add_option("table", options->table, "Runs, one a line; the first line names the columns")
      ->required()
      ->type_name("TABLE.csv");
    command.add_option("--response", options->response, "Column that is explained, with or without its unit")
      ->required()
      ->type_name("NAME");
    command.add_option("--factors", options->factors, "Columns by which it is explained")
      ->required()
      ->delimiter(',')
      ->type_name("A,B,...");
    command
      .add_option(
        "--model", options->model,
        "range: means of levels; anova: analysis of variance; linear or quadratic: surface; default: quadratic")
      ->type_name("quadratic|linear|anova|range")
      ->check(CLI::IsMember(models));
    command
      .add_option("--null", options->analysis.null_column, "The factor that is none: a column to which none was given")
      ->type_name("NAME");
    command
      .add_option("--null-as", options->null_as,
                  "What the null column is taken for in the analysis of variance; default: factor")
      ->type_name("factor|pooled|error")
      ->check(CLI::IsMember(treatments));
    command
      .add_option("-o,--output", options->folder, "Folder for analysis.json, tables and figures; default: only words")
      ->type_name("DIR");
    command.callback([options, &chosen] { chosen = [options] { return analyse_table(*options); }; });
  }
} // namespace apps
