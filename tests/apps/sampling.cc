#include "apps/figures/sampling.h"

#include <catch2/catch.hpp>

#include <map>

using apps::OutputSection;
using apps::Sampling;
using apps::StepSampling;

namespace
{
  OutputSection output(const std::int64_t samples, const std::int64_t snapshots)
  {
    OutputSection section;
    section.samples   = samples;
    section.snapshots = snapshots;
    return section;
  }

  /** A checkpoint in memory of whole numbers, which is all that sampling remembers. */
  struct Memory : apps::RunState
  {
    std::map<std::string, std::int64_t> whole;
    bool                                reading = false;

    bool reads() const override { return reading; }
    void group(const std::string &) override {}
    void column(const std::string &, base::Column &) override { FAIL("no column is expected"); }
    void column(const std::string &, std::vector<std::int32_t> &) override { FAIL("no column is expected"); }
    void scalar(const std::string &, double &) override { FAIL("no real number is expected"); }
    void scalar(const std::string &name, std::int64_t &value) override
    {
      if (reading)
        value = whole.at(name);
      else
        whole[name] = value;
    }
  };
} // namespace

TEST_CASE("samples of a motion are even over its duration, and snapshots lie on them", "[apps]")
{
  Sampling         sampling(2.0, output(10, 4));
  std::vector<int> with_snapshot;
  for (int k = 1; k <= 10; ++k)
    {
      REQUIRE_FALSE(sampling.finished());
      CHECK(sampling.next_time() == Approx(0.2 * k).epsilon(1e-15));
      CHECK_FALSE(sampling.take(0.2 * k - 0.01)); // interrupted before
      REQUIRE(sampling.take(0.2 * k + 0.01));     // the step that passed it
      if (sampling.snapshot_due())
        with_snapshot.push_back(k);
    }
  CHECK(sampling.finished());
  CHECK(with_snapshot == std::vector<int>{3, 5, 8, 10});
}

TEST_CASE("a step longer than the interval of samples takes all that it passed as one", "[apps]")
{
  Sampling sampling(1.0, output(100, 1));
  REQUIRE(sampling.take(0.505));
  CHECK(sampling.next_time() == Approx(0.51));
  CHECK_FALSE(sampling.snapshot_due());
  REQUIRE(sampling.take(1.2));
  CHECK(sampling.finished());
  CHECK(sampling.snapshot_due());
}

TEST_CASE("a prescribed end time is reached in spite of rounding, and not otherwise", "[apps]")
{
  const double just_before = 0.1 * (1 - 1e-14);
  CHECK(Sampling(1.0, output(10, 0), 1e-12).take(just_before));
  CHECK_FALSE(Sampling(1.0, output(10, 0)).take(just_before));
}

TEST_CASE("a stop ends sampling with a snapshot, also after it was resumed", "[apps]")
{
  Sampling sampling(1.0, output(10, 1));
  sampling.take(0.3);
  CHECK_FALSE(sampling.snapshot_due());
  sampling.stop();
  CHECK(sampling.finished());
  CHECK(sampling.snapshot_due());

  Memory memory;
  sampling.visit_state(memory);
  memory.reading = true;
  Sampling resumed(1.0, output(10, 1));
  resumed.visit_state(memory);
  CHECK(resumed.finished());
  CHECK(resumed.next_time() == sampling.next_time());
}

TEST_CASE("a test counted in steps has as many snapshots as were requested, even over its samples", "[apps]")
{
  const StepSampling sampling(1000, output(10, 4));
  CHECK(sampling.steps() == 100);
  std::vector<int> with_snapshot;
  for (int sample = 1; sample <= 10; ++sample)
    if (sampling.snapshot_due(sample))
      with_snapshot.push_back(sample);
  CHECK(with_snapshot == std::vector<int>{3, 5, 8, 10});

  CHECK(StepSampling(7, output(10, 0)).steps() == 1); // fewer steps than samples: one each
  CHECK_FALSE(StepSampling(7, output(10, 0)).snapshot_due(10));
}
