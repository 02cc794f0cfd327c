#include "apps/results/run_report.h"

#include "apps/process/mpi_session.h"
#include "apps/results/run_result.h"
#include "apps/results/series_panels.h"
#include "apps/results/warning.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/scratch_folder.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace fs = std::filesystem;

  const char *const report_name = "report.html";

  namespace
  {
    using Rows = std::vector<std::vector<std::string>>;

    std::string number_word(const double value) { return fmt::format("{:.6g}", value + 0.0); } // no sign of a zero

    std::string word_of(const nlohmann::json &value)
    {
      return value.is_number_float() ? number_word(value.get<double>()) :
             value.is_string()       ? value.get<std::string>() :
                                       value.dump();
    }

    /** Numbers and words of an object, in its order; a unit that it has stands above them. */
    Rows table_of(const nlohmann::json &object, const std::string &head)
    {
      const std::string unit = object.value("unit", "");
      Rows              rows = {{head, unit.empty() ? "value" : "value [" + unit + "]"}};
      for (const auto &[name, value] : object.items())
        if (name == "unit")
          continue;
        else if (!value.is_structured())
          rows.push_back({name, word_of(value)});
        else if (value.is_object() && value.contains("value"))
          rows.push_back({name, word_of(value["value"]) + " " + value.value("unit", "")});
      return rows;
    }

    void add_table(postprocess::HtmlPage &page, const RunResult &result, const char *name, const char *heading)
    {
      if (!result.summary.contains(name) || !result.summary[name].is_object())
        return;
      page.heading(heading);
      page.table(table_of(result.summary[name], name));
    }

    void add_question(postprocess::HtmlPage &page, const RunRequest &request, const nlohmann::json &summary)
    {
      const nlohmann::json requested = summary.value("requested", nlohmann::json::object());
      page.heading("Request");
      page.paragraph(fmt::format("Scene {} of kind {}, computed by Breccia {}.", request.scene_file,
                                 requested.value("kind", ""), summary.value("version", "")));
      std::vector<std::string> changes;
      for (const std::string &change : requested.value("overrides", std::vector<std::string>()))
        changes.push_back("changed: " + change);
      page.list(changes);
      add_scene(page, request.scene_text, request.inputs);
      page.paragraph("The same bits again: breccia run report.html -o FOLDER");
    }

    void add_figures(postprocess::HtmlPage &page, const RunResult &result)
    {
      Rows rows = {{"figure", "value", "unit"}};
      for (const std::string &name : result.figures())
        {
          const Figure figure = result.figure(name);
          rows.push_back({name, figure.value ? number_word(*figure.value) : figure.not_determined, figure.unit});
        }
      page.heading("Figures");
      page.table(rows);
    }

    void add_panels(postprocess::HtmlPage                     &page,
                    const std::vector<postprocess::PlotPanel> &panels,
                    const std::string                         &what,
                    const std::string                         &caption)
    {
      if (panels.empty())
        return;
      const postprocess::ScratchFolder scratch("report");
      const std::string                problem = postprocess::plot(scratch / "panels.png", panels);
      warn_of_missing(what + " in " + report_name, problem);
      page.picture(scratch / "panels.png", caption);
    }

    void add_energy(postprocess::HtmlPage &page, const RunResult &result)
    {
      add_table(page, result, "energy", "Energy");
      const auto panels = panels_of_energies(result.series);
      if (!result.summary.contains("energy") && !panels.empty())
        page.heading("Energy");
      add_panels(page, panels, "the energies",
                 "Where the energy has come from and where it is; beside it what the balance is off by");
    }

    void add_curves(postprocess::HtmlPage &page, const postprocess::CsvTable &series)
    {
      const auto panels = panels_of_columns(series);
      if (!panels.empty())
        page.heading("Series");
      add_panels(page, panels, "the series", "Every column of series.csv that changes, energies apart");
    }

    void add_pictures(postprocess::HtmlPage &page, const fs::path &folder)
    {
      std::vector<fs::path> pictures;
      for (const auto &entry : fs::directory_iterator(folder))
        if (entry.is_regular_file() && entry.path().extension() == ".png")
          pictures.push_back(entry.path());
      std::sort(pictures.begin(), pictures.end());
      if (!pictures.empty())
        page.heading("Pictures");
      for (const fs::path &picture : pictures)
        page.picture(picture, picture.stem().string());
    }
  } // namespace

  std::string name_in(const std::string &scene_text, const InputFile &input)
  {
    const std::string whole = fs::absolute(input.file).lexically_normal().string();
    return scene_text.find(whole) != std::string::npos ? whole : input.file;
  }

  void add_scene(postprocess::HtmlPage &page, const std::string &scene_text, const std::vector<InputFile> &inputs)
  {
    page.scene(scene_text);
    for (const InputFile &input : inputs)
      page.attach(input.entry, name_in(scene_text, input), input.file);
  }

  std::string page_of(const RunRequest &request, const RunResult &result)
  {
    postprocess::HtmlPage          page("Run of " + fs::path(request.scene_file).filename().string());
    const std::vector<std::string> warnings = result.warnings();
    page.heading("Warnings");
    page.list(warnings);
    if (warnings.empty())
      page.paragraph("None.");
    add_figures(page, result);
    add_question(page, request, result.summary);
    add_energy(page, result);
    add_table(page, result, "cost", "Cost");
    page.folded("summary.json", result.summary.dump(2));
    add_curves(page, result.series);
    add_pictures(page, result.folder);
    return page.text();
  }

  void RunReport::ends(const RunResult &result)
  {
    if (result.end == RunResult::End::complete && !result.folder.empty() && is_first_rank())
      postprocess::write_text(result.folder / report_name, page_of(request, result));
  }
} // namespace apps
