// The life-cycle of a run, with work that counts: no program, no model.
#include "apps/results/life_cycle.h"

#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "base/errors.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/errors.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** Counts to ten; a row each; its sum is what must not be lost. */
  class Counting : public apps::RunWork
  {
  public:
    int                      stops_at = 0, interrupted_at = 0; ///< 0: never
    std::string              refusal;
    std::vector<std::string> calls;

    void prepare() override
    {
      calls.emplace_back("prepare");
      if (!refusal.empty())
        throw base::InputError(refusal);
    }
    void keep_files(const std::filesystem::path &folder, bool) override
    {
      calls.emplace_back("keep files");
      CHECK(folder.filename() == "running");
    }
    void begin(const Record &record) override
    {
      calls.emplace_back("begin");
      record({{}, {0, 0}, {}});
    }
    void reopen(const std::filesystem::path &) override { calls.emplace_back("reopen"); }
    void visit_state(apps::RunState &state) override
    {
      state.group("counting");
      state.scalar("count", count);
      state.scalar("sum", sum);
    }
    std::vector<postprocess::SeriesColumn> series_columns() const override { return {{"count", ""}, {"sum", "m"}}; }
    std::string                            size() const override { return "ten numbers"; }
    std::string                            stage() const override { return "counting"; }
    double                                 done() const override { return static_cast<double>(count) / 10; }
    std::string                            details() const override { return ""; }
    bool                                   finished() const override { return count >= 10; }
    void                                   advance(const Record &record) override
    {
      if (count + 1 == stops_at)
        throw apps::StoppedShort("cannot count further.");
      sum += static_cast<double>(++count) / 3;
      record({{}, {static_cast<double>(count), sum}, {}});
      if (count == interrupted_at)
        raise(SIGINT);
    }
    void              leave_last_state() override { calls.emplace_back("leave"); }
    apps::RunFindings findings(const postprocess::CsvTable &series, double) override
    {
      calls.emplace_back("findings");
      CHECK(series.column("sum").back() == sum);
      return {{{"figures", {{"sum", {{"value", sum}, {"unit", "m"}}}}}}, "", nullptr};
    }
    void write_results(const std::filesystem::path &folder, const postprocess::CsvTable &) override
    {
      calls.emplace_back("write");
      postprocess::write_text(folder / "sum.txt", std::to_string(sum));
    }

    std::int64_t count = 0;
    double       sum   = 0;
  };

  apps::RunRequest request_in(const std::filesystem::path &folder)
  {
    apps::RunRequest request;
    request.output_folder = folder;
    request.scene_file    = "counting.prm";
    request.scene_text    = "set Kind = counting\n";
    request.deciding_text = request.scene_text;
    return request;
  }

  constexpr double ten_minutes = 600;

  int execute(const apps::RunRequest &request, Counting &work)
  {
    return apps::LifeCycle(request, ten_minutes, work).execute().exit_status();
  }

  using Calls = std::vector<std::string>;
} // namespace

TEST_CASE("A run leaves its series, its scene and its results in place, and nothing under way", "[apps]")
{
  const ScratchFolder folder;
  Counting            work;
  CHECK(execute(request_in(folder / "out"), work) == apps::exit_success);
  CHECK(work.calls == Calls{"prepare", "keep files", "begin", "findings", "write"});
  CHECK(content_of(folder / "out/scene.prm") == "set Kind = counting\n");
  CHECK_THAT(content_of(folder / "out/series.csv"), Catch::StartsWith("count,sum [m]\n0,0\n1,0.333"));
  CHECK(std::filesystem::exists(folder / "out/sum.txt"));
  CHECK_FALSE(std::filesystem::exists(folder / "out/running"));
}

TEST_CASE("A run that is refused leaves no folder", "[apps]")
{
  const ScratchFolder folder;
  Counting            work;
  work.refusal = "no numbers.";
  CHECK_THROWS_AS(execute(request_in(folder / "out"), work), base::InputError);
  CHECK(work.calls == Calls{"prepare"});
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_CASE("A run that stops short keeps its last state, and goes on from it to the same series", "[apps]")
{
  const ScratchFolder folder;
  Counting            whole;
  execute(request_in(folder / "whole"), whole);

  apps::RunRequest request = request_in(folder / "out");
  Counting         first;
  first.stops_at = 5;
  CHECK_THROWS_WITH(execute(request, first), Contains("cannot count further. What was computed until then stands in"));
  CHECK(first.calls == Calls{"prepare", "keep files", "begin", "leave"});
  CHECK(std::filesystem::exists(folder / "out/running/checkpoint.h5"));
  CHECK_FALSE(std::filesystem::exists(folder / "out/sum.txt"));

  Counting again;
  CHECK_THROWS_WITH(execute(request, again), Contains("--resume") && Contains("--restart"));
  CHECK(again.calls.empty());

  request.resume = true;
  Counting rest;
  CHECK(execute(request, rest) == apps::exit_success);
  CHECK(rest.calls == Calls{"reopen", "keep files", "findings", "write"});
  CHECK(rest.sum == whole.sum);
  CHECK(content_of(folder / "out/series.csv") == content_of(folder / "whole/series.csv"));
}

TEST_CASE("A run goes on only from its own scene and its own files", "[apps]")
{
  const ScratchFolder folder;
  apps::RunRequest    request = request_in(folder / "out");
  request.inputs              = {{"Specimen/File", "packing.txt", 7, 4711}};
  Counting first;
  first.stops_at = 5;
  CHECK_THROWS_AS(execute(request, first), base::NumericalError);

  request.resume           = true;
  apps::RunRequest another = request;
  another.deciding_text    = "set Kind = counting\nset To = 20\n";
  Counting rest;
  CHECK_THROWS_AS(execute(another, rest), base::InputError);
  another                  = request;
  another.inputs[0].digest = 4712;
  CHECK_THROWS_WITH(execute(another, rest), Contains("Specimen/File"));
  another                = request;
  another.inputs[0].file = "elsewhere/packing.txt"; // the same content
  CHECK(execute(another, rest) == apps::exit_success);
}

TEST_CASE("A new run may throw away what was interrupted, and earlier results stay until it is complete", "[apps]")
{
  const ScratchFolder folder;
  apps::RunRequest    request = request_in(folder / "out");
  Counting            complete, stopped, short_again, last;
  execute(request, complete);
  const std::string results = content_of(folder / "out/series.csv");
  stopped.stops_at          = 3;
  CHECK_THROWS_AS(execute(request, stopped), base::NumericalError);
  CHECK(content_of(folder / "out/series.csv") == results);
  request.restart = true;
  CHECK(execute(request, last) == apps::exit_success);
  CHECK(last.calls.front() == "prepare");
  CHECK(content_of(folder / "out/series.csv") == results);
}

TEST_CASE("An interrupted run saves where it is, and the rest of it gives the same bits", "[apps]")
{
  const ScratchFolder folder;
  Counting            whole;
  execute(request_in(folder / "whole"), whole);
  const pid_t process = fork(); // signals and flags are a process's own
  if (process == 0)
    {
      apps::catch_interrupts();
      Counting first;
      first.interrupted_at = 4;
      _exit(apps::LifeCycle(request_in(folder / "out"), ten_minutes, first).execute().exit_status());
    }
  int status = 0;
  waitpid(process, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == apps::exit_interrupted);
  apps::RunRequest request = request_in(folder / "out");
  request.resume           = true;
  Counting rest;
  CHECK(execute(request, rest) == apps::exit_success);
  CHECK(rest.sum == whole.sum);
  CHECK(content_of(folder / "out/series.csv") == content_of(folder / "whole/series.csv"));
}

TEST_CASE("A run that a program takes from state to state, and stops, leaves the files of one that goes by itself",
          "[apps]")
{
  const ScratchFolder folder;
  Counting            whole;
  execute(request_in(folder / "whole"), whole);

  apps::RunRequest request = request_in(folder / "out");
  {
    Counting        first;
    apps::LifeCycle steps(request, ten_minutes, first);
    steps.start();
    for (int n = 0; n < 4; ++n)
      CHECK(steps.go_on());
    steps.interrupt();
    const apps::RunResult part = steps.finish();
    CHECK(part.exit_status() == apps::exit_interrupted);
    CHECK(part.series.column("count") == std::vector<double>{0, 1, 2, 3, 4});
    CHECK_THAT(part.go_on, Contains("--resume"));
  }
  request.resume = true;
  Counting        rest;
  apps::LifeCycle steps(request, ten_minutes, rest);
  steps.start();
  int taken = 0;
  while (steps.go_on())
    ++taken;
  CHECK(taken == 6);
  CHECK_FALSE(steps.go_on()); // and may be called again
  CHECK(steps.finish().exit_status() == apps::exit_success);
  for (const char *file : {"series.csv", "sum.txt"})
    CHECK(content_of(folder / "out" / file) == content_of(folder / "whole" / file));
}

TEST_CASE("Two runs do not write to one folder", "[apps]")
{
  const ScratchFolder      folder;
  const apps::ResultFolder locked(folder / "out", apps::ResultFolder::Start::afresh);
  Counting                 work;
  CHECK_THROWS_AS(execute(request_in(folder / "out"), work), postprocess::OutputError);
}

TEST_CASE("A checkpoint is due when the longest interval is over, and not just after one", "[apps]")
{
  apps::CheckpointClock eager(0), calm(1e6);
  CHECK(eager.is_due());
  CHECK_FALSE(calm.is_due());
  bool saved = false;
  calm.save([&saved] { saved = true; });
  CHECK(saved);
  CHECK_FALSE(calm.is_due());
}
