// The shipped scenes of bodies in contact against closed forms and published values, through the program.
#include "tests/verification/scene_results.h"

#include <cmath>

TEST_CASE("Three balls: the published example's momentum and energy, and what it keeps", "[verification][contact]")
{
  // J. Stransky (2018), example contact1: masses 8828.43, 8828.43 and 70627.42 kg.
  const SceneResults found  = results_of("three_balls");
  const auto        &series = found.series;
  CHECK(series.column("momentum_x").front() == Approx(-5 * 8828.43).epsilon(1e-6));
  CHECK(series.column("momentum_y").front() == Approx(520877.2).epsilon(1e-6));
  CHECK(series.column("energy_start").front() == Approx(2.480788e6).epsilon(1e-6));
  const double linear = 520877.2;
  for (std::size_t row = 0; row < series.columns[0].size(); ++row)
    for (const char *axis : {"x", "y", "z"})
      {
        const auto &p = series.column(std::string("momentum_") + axis);
        const auto &l = series.column(std::string("angular_momentum_") + axis);
        REQUIRE(std::fabs(p[row] - p.front()) < 1e-10 * linear);
        REQUIRE(std::fabs(l[row] - l.front()) < 1e-10 * linear); // metres
      }
  CHECK(found.summary["energy"]["balance_error"].get<double>() < 1e-3);
  CHECK(series.column("balls_dissipated").back() > 1e5);
  CHECK(series.column("balls_pairs").back() == 0); // they part
  CHECK(found.figure("peak_force") > 1e6);
}

TEST_CASE("Three balls with the published form of the force: momentum, and energy within 5 %",
          "[verification][contact]")
{
  const SceneResults found =
    results_of("three_balls", {"Contacts/balls/Form=penalty", "Contacts/balls/Energy limit=0.05"});
  const auto &p = found.series.column("momentum_y");
  CHECK(std::fabs(p.back() - p.front()) < 1e-10 * p.front());
  CHECK(std::fabs(found.series.column("energy_residual").back()) < 0.05 * 2.480788e6);
  CHECK(found.series.column("balls_pairs").back() == 0);
}

TEST_CASE("Two balls meet as Hertz has it, the closer the smaller their elements", "[verification][contact][slow]")
{
  // Johnson (1985), 4.2 and 11.4.
  double force[2], time[2];
  for (const int level : {2, 3})
    {
      const std::string  refinements = "Refinements=" + std::to_string(level);
      const SceneResults found =
        results_of("colliding_balls", {"Mesh/Balls/left/" + refinements, "Mesh/Balls/right/" + refinements,
                                       level == 2 ? "Contacts/balls/Stiffness=3e15" : "Contacts/balls/Stiffness=6e15"});
      force[level - 2] = std::fabs(found.summary["figures"]["peak_force"]["relative_error"].get<double>());
      time[level - 2]  = std::fabs(found.summary["figures"]["contact_time"]["relative_error"].get<double>());
      CHECK(found.summary["energy"]["balance_error"].get<double>() < 1e-3);
    }
  INFO("errors of the force " << force[0] << ", " << force[1] << ", of the time " << time[0] << ", " << time[1]);
  CHECK(std::log2(force[0] / force[1]) > 1);
  CHECK(std::log2(time[0] / time[1]) > 1);
  CHECK(force[1] < 0.04);
  CHECK(time[1] < 0.02);
}
