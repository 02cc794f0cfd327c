#include "apps/commands/command.h"
#include "apps/process/exit_status.h"
#include "apps/results/folder_reading.h"
#include "apps/results/run_report.h"
#include "apps/results/run_result.h"
#include "apps/scene/kinds/read_scene.h"
#include "base/errors.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/numeric_text.h"

#include <fmt/format.h>

#include <memory>

namespace apps
{
  namespace fs = std::filesystem;

  namespace
  {
    struct ReportOptions
    {
      std::string folder, page;
    };

    /** Of a run; a study has written its own as it ended (apps/studies/study_report.h). */
    std::string page_of_folder(const fs::path &folder)
    {
      if (!holds_a_run(folder) && fs::is_regular_file(folder / report_name))
        return postprocess::numeric_text::read_whole(folder / report_name);
      RunResult          result  = read_result(folder);
      const CheckedScene scene   = read_scene((folder / "scene.prm").string(), {});
      RunRequest         request = request_of(scene);
      request.scene_file         = result.summary.value("scene", request.scene_file);
      return page_of(request, result);
    }

    int write_page(const ReportOptions &options)
    {
      const fs::path page = options.page.empty() ? fs::path(options.folder) / report_name : fs::path(options.page);
      postprocess::write_text(page, page_of_folder(options.folder));
      fmt::print("{}: {} kB\n", page.string(), fs::file_size(page) / 1000);
      return exit_success;
    }
  } // namespace

  void add_report(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<ReportOptions>();
    CLI::App  &command = *program.add_subcommand("report", "A folder of results as one page for a browser");
    command.footer(
      "The page holds its pictures, the scene and the files that the scene names: \"breccia run report.html\" "
      "gives the same bits\nagain. With Output/Report = true a run writes it by itself, and a study always.");
    command.add_option("folder", options->folder, "Results of a run or of a study")->required()->type_name("DIR");
    command.add_option("-o,--output", options->page, "The page; default: DIR/report.html")->type_name("PAGE.html");
    command.callback([options, &chosen] { chosen = [options] { return write_page(*options); }; });
  }
} // namespace apps
