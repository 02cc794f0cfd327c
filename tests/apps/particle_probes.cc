// What probes of particles read, what their groups hold and what makes up a row, without the program.
#include "tests/apps/two_balls.h"

#include <catch2/catch.hpp>

using Catch::Contains;

namespace
{
  /** One thrown and spinning, one at rest. */
  struct ThrownBalls : apps_tests::TwoBalls
  {
    explicit ThrownBalls(const std::vector<std::string> &more)
      : TwoBalls({"More particles/large/Centre=0, 0, 0", "More particles/small/Centre=0.09, 0, 0",
                  "Initial velocity/large/Velocity x=0.5", "Initial velocity/large/Spin z=20"},
                 more)
    {
    }
  };
} // namespace

TEST_CASE("A probe of a group reads its centre of mass; distance is from there to the other's", "[apps][particles]")
{
  const ThrownBalls balls({"Probes/both/Quantity=position", "Probes/both/Component=x", "Probes/speed/Quantity=velocity",
                           "Probes/speed/Component=size", "Probes/gap/Quantity=distance", "Probes/gap/Group=large",
                           "Probes/gap/Other group=small", "Probes/gap/Component=x"});
  CHECK(balls.probe("both") == Approx(0.09 / 9).epsilon(1e-14));
  CHECK(balls.probe("speed") == Approx(0.5 * 8 / 9).epsilon(1e-14));
  CHECK(balls.probe("gap") == Approx(0.09).epsilon(1e-14));
}

TEST_CASE("The kinetic energy of a group is of its translation and its spin, and of its own particles only",
          "[apps][particles]")
{
  const ThrownBalls balls({"Probes/thrown/Quantity=kinetic energy", "Probes/thrown/Group=large",
                           "Probes/still/Quantity=kinetic energy", "Probes/still/Group=small"});
  const double      mass = 2500 * 4.0 / 3 * M_PI * 1e-6;
  CHECK(balls.probe("thrown") == Approx(0.5 * mass * (0.25 + 0.4 * 1e-4 * 400)).epsilon(1e-13));
  CHECK(balls.probe("still") == 0);
  CHECK(balls.probe("energy_kinetic") == Approx(balls.probe("thrown")).epsilon(1e-13));
}

TEST_CASE("Where nothing touches, a force is zero and a ratio of forces is no number", "[apps][particles]")
{
  const ThrownBalls balls({"Probes/push/Quantity=force", "Probes/push/Group=small",
                           "Probes/calm/Quantity=unbalanced ratio", "Probes/torn/Quantity=broken links"});
  CHECK(balls.probe("push") == 0);
  CHECK(std::isnan(balls.probe("calm")));
  CHECK(balls.probe("torn") == 0);
}

TEST_CASE("A row has a number for each column, its time first and its energies last", "[apps][particles]")
{
  const ThrownBalls balls({"Probes/speed/Quantity=velocity"});
  const auto        columns = balls.model.columns();
  REQUIRE(balls.body->row().size() == columns.size());
  CHECK(columns.front().name == "time");
  CHECK(columns[1].name == "speed");
  CHECK(columns[1].unit == "m/s");
  CHECK(columns.back().name == "energy_residual");
  CHECK(balls.model.curve_horizontal() == "time");
  CHECK(balls.model.curve_vertical() == "speed"); // the first probe, unless the scene says otherwise
  CHECK(ThrownBalls({}).model.curve_vertical() == "energy_kinetic");
}

TEST_CASE("Groups hold what lies in their region or layer, and all is one of them", "[apps][particles]")
{
  const ThrownBalls balls({"Groups/right/Shape=sphere", "Groups/right/Centre=0.09, 0, 0", "Groups/right/Radius=0.01",
                           "Groups/bottom/Members=layer", "Groups/bottom/Axis=x", "Groups/bottom/Thickness=1e-3"});
  using Members                   = std::vector<std::size_t>;
  const apps::ParticleGroups &all = balls.body->all_groups();
  CHECK(all.at("all") == Members{0, 1});
  CHECK(all.at("right") == Members{1});
  CHECK(all.at("bottom") == Members{0});
  CHECK_THROWS_WITH(ThrownBalls({"Groups/none/Shape=sphere", "Groups/none/Centre=5, 5, 5", "Groups/none/Radius=0.01"}),
                    Contains("Groups/none: no particle's centre lies in it"));
}
