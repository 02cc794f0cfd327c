#include "apps/drivers/uniaxial_run.h"

#include "apps/drivers/specimen_packing.h"
#include "apps/drivers/uniaxial_summary.h"
#include "apps/exit_status.h"
#include "apps/interrupt.h"
#include "apps/progress.h"
#include "postprocess/atomic_file.h"
#include "postprocess/checkpoint.h"
#include "postprocess/packing_io.h"
#include "postprocess/summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace apps
{
  namespace
  {
    constexpr const char *scene_name   = "scene.prm";
    constexpr const char *packing_name = "packing.h5";
    constexpr const char *series_name  = "series.csv";

    double seconds_since(const std::chrono::steady_clock::time_point &start)
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    /** A picture that could not be drawn costs the user a line, not the run. */
    void warn(const char *what, const std::string &problem)
    {
      if (!problem.empty())
        fmt::print(stderr, "breccia: warning: no {}: {}\n", what, problem);
    }
  } // namespace

  UniaxialRun::UniaxialRun(const RunRequest &asked, const UniaxialModel &what)
    : request(asked)
    , model(what)
    , start(Clock::now())
    , last_saved(start)
  {
  }

  double UniaxialRun::wall_seconds() const { return seconds_before + seconds_since(start); }

  int UniaxialRun::execute()
  {
    if (request.resume)
      resume();
    else
      begin();
    fmt::print(stderr, "{}: {} particles, {} links; results {} in {}\n", request.scene_file,
               stage->result.at_start.particles, stage->result.at_start.links, request.resume ? "go on" : "grow",
               folder->running().string());
    while (true)
      {
        if (!complete_stage())
          return exit_interrupted;
        finished.push_back(stage->result);
        if (finished.size() == model.loading.tests.size())
          break;
        stage = std::make_unique<UniaxialStage>(model, packing, finished.size());
        stage->settle();
        stage->open(folder->running());
      }
    finish();
    return exit_success;
  }

  void UniaxialRun::begin()
  {
    // All refusals come before the folder is touched.
    packing = make_packing(model.source, model.material, model.specimen.physics.dimension);
    stage   = std::make_unique<UniaxialStage>(model, packing, 0);
    stage->settle();

    folder = std::make_unique<ResultFolder>(request.output_folder, ResultFolder::Start::afresh);
    const std::filesystem::path &location = folder->running();
    postprocess::write_text(location / scene_name, request.scene_text);
    postprocess::write_packing(packing, location / packing_name);
    series = std::make_unique<postprocess::SeriesWriter>(location / series_name, UniaxialStage::series_columns());
    stage->open(location);
  }

  void UniaxialRun::resume()
  {
    folder = std::make_unique<ResultFolder>(request.output_folder, ResultFolder::Start::resume);
    const std::filesystem::path &location = folder->running();

    postprocess::CheckpointReader checkpoint(location / checkpoint_name, request.deciding_text);
    std::int64_t                  tests = 0, rows = 0;
    checkpoint.group("run");
    checkpoint.scalar("finished_tests", tests);
    checkpoint.scalar("series_rows", rows);
    checkpoint.scalar("wall_seconds", seconds_before);
    for (std::int64_t i = 0; i < tests; ++i)
      {
        finished.emplace_back();
        finished.back().load = model.loading.tests.at(static_cast<std::size_t>(i));
        checkpoint.group(std::string("result_") + name_of(finished.back().load));
        finished.back().visit_state(checkpoint);
      }

    packing = postprocess::read_packing(location / packing_name);
    stage   = std::make_unique<UniaxialStage>(model, packing, finished.size());
    stage->open(location);
    stage->visit_state(checkpoint);
    checkpoint.group("result_under_way");
    stage->result.visit_state(checkpoint);
    checkpoint.finish();
    series = std::make_unique<postprocess::SeriesWriter>(location / series_name, UniaxialStage::series_columns(), rows);
  }

  void UniaxialRun::save()
  {
    series->flush();
    postprocess::CheckpointWriter checkpoint(folder->running() / checkpoint_name, request.deciding_text);
    std::int64_t                  tests = static_cast<std::int64_t>(finished.size()), rows = series->rows();
    double                        seconds = wall_seconds();
    checkpoint.group("run");
    checkpoint.scalar("finished_tests", tests);
    checkpoint.scalar("series_rows", rows);
    checkpoint.scalar("wall_seconds", seconds);
    for (UniaxialResult &result : finished)
      {
        checkpoint.group(std::string("result_") + name_of(result.load));
        result.visit_state(checkpoint);
      }
    stage->visit_state(checkpoint);
    checkpoint.group("result_under_way");
    stage->result.visit_state(checkpoint);
    checkpoint.commit();
    last_saved = Clock::now();
  }

  bool UniaxialRun::complete_stage()
  {
    const char *name = name_of(stage->result.load);
    Progress    progress(name);
    while (!stage->finished())
      {
        stage->advance();
        stage->append_row(*series);
        progress.update(stage->done(), stage->details());
        if (interrupted())
          {
            save();
            progress.clear();
            fmt::print(stderr, "breccia: interrupted in {}, state saved. Go on with: breccia run {} --resume\n", name,
                       (folder->running() / scene_name).string());
            return false;
          }
        if (seconds_since(last_saved) > model.output.checkpoint_interval)
          save();
      }
    stage->finish();
    stage->save_discrete_state(folder->running());
    progress.clear();
    warn("crack picture", stage->draw_crack(folder->running()));
    return true;
  }

  void UniaxialRun::finish()
  {
    series->flush();
    const UniaxialReport report{request, finished, stage->materials, wall_seconds()};
    postprocess::write_json(folder->running() / "summary.json", report.summary());
    warn("curve.png", report.draw_curve(folder->running() / "curve.png"));
    folder->publish();
    fmt::print("{}", report.text());
  }
} // namespace apps
