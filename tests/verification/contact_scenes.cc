// The shipped scenes of bodies in contact against closed forms and published values, through the program.
#include "tests/verification/scene_results.h"

#include <cmath>
#include <string>
#include <vector>

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

namespace
{
  /** Errors of the impact of two balls of so many divisions, beside Hertz (Johnson 1985, 4.2 and 11.4). */
  struct BallErrors
  {
    double force, time;
  };

  BallErrors errors_of_balls(const int divisions)
  {
    // What the layer of contact gives way has to vanish faster than what elements lack: by the fourth power of their size. The gap has
    // room for the nodes off the sphere of the coarsest balls.
    std::vector<std::string> changes = {"Contacts/balls/Stiffness=" +
                                        std::to_string(1.27e16 * std::pow(divisions / 6.0, 4))};
    for (const std::string ball : {"left", "right"})
      {
        changes.push_back("Mesh/Balls/" + ball + "/Divisions=" + std::to_string(divisions));
        if (divisions == 2)
          changes.push_back("Mesh/Balls/" + ball + "/Centre=" + (ball == "left" ? "-" : "") + "0.010005, 0, 0");
      }
    changes.push_back("Motion/End time=" + std::string(divisions == 2 ? "1.1e-4" : "7.5e-5"));
    const SceneResults found = results_of("colliding_balls", changes);
    const auto        &known = found.summary["figures"];
    CHECK(found.summary["energy"]["balance_error"].get<double>() < 1e-5);
    return {known["peak_force"]["relative_error"].get<double>(), known["contact_time"]["relative_error"].get<double>()};
  }
} // namespace

TEST_CASE("Two balls of finite elements meet as Hertz has it: within 2 %, and the closer the smaller their elements",
          "[verification][contact][slow]")
{
  const BallErrors coarse = errors_of_balls(2), middle = errors_of_balls(4), fine = errors_of_balls(6);
  for (const auto &[name, of] : {std::pair("force", &BallErrors::force), std::pair("time", &BallErrors::time)})
    {
      const double first = std::fabs(coarse.*of), second = std::fabs(middle.*of), last = std::fabs(fine.*of),
                   order = std::log(first / last) / std::log(6.0 / 2.0);
      INFO("errors of the " << name << ": " << first << ", " << second << ", " << last << ", order " << order);
      CHECK(second < first);
      CHECK(last < second);
      CHECK(order > 1.2);
      CHECK(order < 4); // nothing vanishes faster than what the layer of contact gives way
      CHECK(last < 0.02);
    }
}
