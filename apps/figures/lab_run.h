#pragma once

#include "apps/models/loading.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/results/life_cycle.h"
#include "apps/results/run_request.h"
#include "apps/results/run_work.h"
#include "apps/results/warning.h"
#include "apps/specimens/specimen_packing.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace apps
{
  /**
   * The work of a scene of laboratory tests: one after the other, each on a fresh specimen.
   *
   * In the result folder, besides what every run has (run_files.h): packing.h5, what each test writes, and at the end curve.png.
   *
   * @tparam Test one of the tests (uniaxial/lab_test.h, quasi_static/lab_test.h), with its Model, Result and Report. A Report is made of
   * request, model, results, the last test and the wall clock.
   */
  template <typename Test>
  class LabRun : public RunWork
  {
  public:
    using Model  = typename Test::Model;
    using Result = typename Test::Result;

    LabRun(const RunRequest &requested, const Model &what)
      : request(requested)
      , model(what)
    {
    }

    /** Throws as Scene::run(). */
    RunResult execute() { return LifeCycle(request, model.longest_without_checkpoint(), *this).execute(); }

  private:
    void prepare() override
    {
      packing = model.packing();
      make_test();
      test->settle();
    }

    void reopen(const std::filesystem::path &folder) override { packing = kept_packing(folder); }

    void keep_files(const std::filesystem::path &folder, const bool fresh) override
    {
      location = folder;
      if (!fresh) // the state says which test is under way
        return;
      keep_packing(packing, folder);
      test->open(folder);
    }

    bool whole_on_each_rank() const override { return true; }
    void begin(const Record &) override {}

    void                                   visit_state(RunState &state) override;
    std::vector<postprocess::SeriesColumn> series_columns() const override { return Test::series_columns(model); }
    std::string                            size() const override { return test->size(); }
    std::string                            stage() const override { return name_of(test->result.load); }
    double                                 done() const override { return test->done(); }
    std::string                            details() const override { return test->details(); }
    bool                                   finished() const override { return complete.size() == model.loads().size(); }

    void advance(const Record &record) override
    {
      if (!test->finished())
        {
          test->advance();
          record(test->row());
        }
      if (test->finished() && !interrupted_on_any_rank()) // else the resumed run completes it
        complete_test();
    }

    typename Test::Report report(const double wall_seconds) const
    {
      return {request, model, complete, *test, wall_seconds};
    }

    RunFindings findings(const postprocess::CsvTable &, const double wall_seconds) override
    {
      const typename Test::Report found = report(wall_seconds);
      return {found.summary(), found.text(), test->specimen_at_end()};
    }

    void write_results(const std::filesystem::path &folder, const postprocess::CsvTable &) override
    {
      on_first_rank([&] { warn_of_missing("curve.png", report(0).draw_curve(folder / "curve.png")); });
    }

    void make_test()
    {
      const Progress progress("links and grips");
      // A run whose tests are complete, and whose results are not, still has its last one.
      test = std::make_unique<Test>(model, packing, std::min(complete.size(), model.loads().size() - 1));
    }

    void complete_test()
    {
      const Progress progress(stage() + ", results");
      test->complete();
      test->write(location);
      complete.push_back(test->result);
      if (finished())
        return;
      make_test();
      test->settle();
      if (!location.empty())
        test->open(location);
    }

    RunRequest            request;
    Model                 model;
    dem::Packing          packing;
    std::filesystem::path location;
    std::unique_ptr<Test> test;     ///< under way
    std::vector<Result>   complete; ///< of the tests before it
  };

  template <typename Test>
  void LabRun<Test>::visit_state(RunState &state)
  {
    auto tests = static_cast<std::int64_t>(complete.size());
    state.group("tests");
    state.scalar("finished_tests", tests);
    complete.resize(static_cast<std::size_t>(tests));
    for (std::size_t i = 0; i < complete.size(); ++i)
      {
        complete[i].load = model.loads().at(i);
        state.group(std::string("result_") + name_of(complete[i].load));
        complete[i].visit_state(state);
      }
    if (state.reads())
      {
        make_test();
        if (!location.empty())
          test->open(location);
      }
    test->visit_state(state);
    state.group("result_under_way");
    test->result.visit_state(state);
  }
} // namespace apps
