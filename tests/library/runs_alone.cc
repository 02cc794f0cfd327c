// The library `runs` alone: a model that a program fills is checked and run where no reader of scenes is linked.
#include "apps/results/run_state.h"
#include "apps/runs/particles/run.h"
#include "tests/library/ball_in_code.h"

#include <catch2/catch.hpp>

namespace
{
  /** A checkpoint that keeps nothing. */
  struct Nowhere
  {
    void group(const std::string &) {}
    template <typename Values>
    void column(const std::string &, Values &)
    {
    }
    void column_in_parts(const std::string &, std::size_t, const base::StateVisitor::Tell &) {}
    void read_in_parts(const std::string &, const base::StateVisitor::Take &) {}
    template <typename Value>
    void scalar(const std::string &, Value &)
    {
    }
  };
} // namespace

TEST_CASE("model is checked and run by the library that knows no text of scenes", "[runs]")
{
  const apps::ParticlesModel model = library_tests::ball_in_code();
  REQUIRE_NOTHROW(model.check({}));
  const apps::RunResult result = run(model, apps::RunRequest());

  // Thrown at 1 m/s onto a floor 0.1 mm below, without weight: down at that speed, and up at the restitution of the glass.
  const std::vector<double> &time = result.series.column("time"), &height = result.series.column("height");
  REQUIRE(time.size() == 51);
  CHECK(height[2] == Approx(library_tests::start - time[2]).epsilon(1e-9));
  const double rebound = (height[50] - height[40]) / (time[50] - time[40]);
  CHECK(rebound == Approx(library_tests::glass().restitution).epsilon(0.005));
}

TEST_CASE("a checkpoint does not change what a run says of its speed", "[runs]")
{
  const apps::ParticlesModel  model = library_tests::ball_in_code();
  apps::ParticlesRun          run({}, model);
  apps::RunWork              &work   = run;
  const apps::RunWork::Record record = [](const apps::SeriesRow &) {};
  Nowhere                     nowhere;
  apps::WholeState<Nowhere>   saved(nowhere, false);
  work.prepare();
  work.begin(record);
  for (int row = 0; row < 3; ++row)
    work.advance(record);
  const std::string before = work.details();
  CHECK_THAT(before, Catch::Contains(" steps/s") && !Catch::Contains(" 0 steps/s"));
  work.visit_state(saved);
  CHECK(work.details() == before);
}
