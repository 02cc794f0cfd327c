#include "apps/drivers/uniaxial/run.h"

#include "apps/drivers/parts/left_out_of_balance.h"
#include "apps/drivers/parts/specimen_packing.h"
#include "apps/drivers/uniaxial/summary.h"
#include "apps/process/interrupt.h"
#include "apps/results/life_cycle.h"
#include "apps/results/warning.h"
#include "postprocess/packing_io.h"
#include "postprocess/summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace apps
{
  namespace
  {
    constexpr const char *packing_name = "packing.h5";
  } // namespace

  UniaxialRun::UniaxialRun(const RunRequest &asked, const UniaxialModel &what)
    : request(asked)
    , model(what)
  {
  }

  int UniaxialRun::execute() { return LifeCycle(request, model.output.checkpoint_interval, *this).execute(); }

  void UniaxialRun::make_stage()
  {
    const Progress progress("links and grips");
    // A run whose tests are complete, and whose results are not, still has its last one.
    test = std::make_unique<UniaxialStage>(model, packing, std::min(complete.size(), model.loading.tests.size() - 1));
  }

  void UniaxialRun::prepare()
  {
    packing = make_packing(model.source, model.material, model.specimen.physics.dimension);
    make_stage();
    test->settle();
  }

  void UniaxialRun::begin(const std::filesystem::path &folder, const Record &)
  {
    location = folder;
    postprocess::write_packing(packing, folder / packing_name);
    test->open(folder);
  }

  void UniaxialRun::reopen(const std::filesystem::path &folder)
  {
    location = folder;
    packing  = postprocess::read_packing(folder / packing_name);
  }

  void UniaxialRun::visit_state(RunState &state)
  {
    auto tests = static_cast<std::int64_t>(complete.size());
    state.group("tests");
    state.scalar("finished_tests", tests);
    complete.resize(static_cast<std::size_t>(tests));
    for (std::size_t i = 0; i < complete.size(); ++i)
      {
        complete[i].load = model.loading.tests.at(i);
        state.group(std::string("result_") + name_of(complete[i].load));
        complete[i].visit_state(state);
      }
    if (state.reads())
      {
        make_stage();
        test->open(location);
      }
    test->visit_state(state);
    state.group("result_under_way");
    test->result.visit_state(state);
  }

  std::vector<postprocess::SeriesColumn> UniaxialRun::series_columns() const { return UniaxialStage::series_columns(); }

  std::string UniaxialRun::size() const
  {
    return fmt::format("{} particles, {} links", test->result.at_start.particles, test->result.at_start.links);
  }

  std::string UniaxialRun::stage() const { return name_of(test->result.load); }
  double      UniaxialRun::done() const { return test->done(); }
  std::string UniaxialRun::details() const { return test->details(); }
  bool        UniaxialRun::finished() const { return complete.size() == model.loading.tests.size(); }

  void UniaxialRun::advance(const Record &record)
  {
    if (!test->finished() && test->advance())
      record(test->row());
    if (test->finished() && !interrupted()) // else the resumed run completes it
      complete_stage();
  }

  void UniaxialRun::complete_stage()
  {
    const Progress progress(stage() + ", results");
    test->finish();
    test->save_discrete_state(location);
    warn_of_missing("crack picture", test->draw_crack(location));
    complete.push_back(test->result);
    if (finished())
      return;
    make_stage();
    test->settle();
    test->open(location);
  }

  std::string UniaxialRun::finish(const std::filesystem::path &folder, const double wall_seconds)
  {
    const UniaxialReport report{
      request, complete, test->materials, wall_seconds,
      left_out_of_balance(*model.material.materials().bonds(model.specimen.physics), packing.radius)};
    postprocess::write_json(folder / "summary.json", report.summary());
    warn_of_missing("curve.png", report.draw_curve(folder / "curve.png"));
    return report.text();
  }
} // namespace apps
