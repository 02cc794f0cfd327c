#include "apps/drivers/quasi_static/run.h"

#include "apps/drivers/parts/specimen_packing.h"
#include "apps/drivers/quasi_static/report.h"
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
  }

  QuasiStaticRun::QuasiStaticRun(const RunRequest &asked, const QuasiStaticModel &what)
    : request(asked)
    , model(what)
  {
  }

  int QuasiStaticRun::execute() { return LifeCycle(request, model.checkpoint_interval, *this).execute(); }

  void QuasiStaticRun::make_stage()
  {
    const Progress progress("links and grips");
    // A run whose tests are complete, and whose results are not, still has its last one.
    test = std::make_unique<QuasiStaticStage>(model, packing, std::min(complete.size(), model.tests.size() - 1));
  }

  void QuasiStaticRun::prepare()
  {
    packing = make_packing(model.source, model.material, model.dimension);
    make_stage();
  }

  void QuasiStaticRun::begin(const std::filesystem::path &folder, const Record &)
  {
    location = folder;
    postprocess::write_packing(packing, folder / packing_name);
    test->open(folder);
  }

  void QuasiStaticRun::reopen(const std::filesystem::path &folder)
  {
    location = folder;
    packing  = postprocess::read_packing(folder / packing_name);
  }

  void QuasiStaticRun::visit_state(RunState &state)
  {
    auto tests = static_cast<std::int64_t>(complete.size());
    state.group("tests");
    state.scalar("finished_tests", tests);
    complete.resize(static_cast<std::size_t>(tests));
    for (std::size_t i = 0; i < complete.size(); ++i)
      {
        complete[i].load = model.tests.at(i);
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

  std::vector<postprocess::SeriesColumn> QuasiStaticRun::series_columns() const
  {
    return QuasiStaticStage::series_columns(model.is_cell());
  }

  std::string QuasiStaticRun::size() const
  {
    return fmt::format("{} particles, {} links", test->particles_in(), test->links_in());
  }

  std::string QuasiStaticRun::stage() const { return name_of(test->result.load); }
  double      QuasiStaticRun::done() const { return test->done(); }
  std::string QuasiStaticRun::details() const { return test->details(); }
  bool        QuasiStaticRun::finished() const { return complete.size() == model.tests.size(); }

  void QuasiStaticRun::advance(const Record &record)
  {
    if (!test->finished())
      {
        test->advance();
        record(test->row());
      }
    if (test->finished() && !interrupted()) // else the resumed run completes it
      complete_stage();
  }

  void QuasiStaticRun::complete_stage()
  {
    const Progress progress(stage() + ", results");
    test->finish();
    warn_of_missing("crack picture", test->draw_crack(location));
    complete.push_back(test->result);
    if (finished())
      return;
    make_stage();
    test->open(location);
  }

  std::string QuasiStaticRun::finish(const std::filesystem::path &folder, const double wall_seconds)
  {
    const QuasiStaticReport report{request,          model,           complete,    test->particles_in(),
                                   test->links_in(), test->materials, wall_seconds};
    postprocess::write_json(folder / "summary.json", report.summary());
    warn_of_missing("curve.png", report.draw_curve(folder / "curve.png"));
    return report.text();
  }
} // namespace apps
