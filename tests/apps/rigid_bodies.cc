// Rigid bodies of scenes: convex shapes filled with pebbles, shapes around particles that are there, refusals.
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  const std::string tumbling = places::sources() + "/apps/scenes/tumbling_bodies.prm";

  /** A plate of discs on a line: those in a trapezium, or all, are a rigid body that falls freely, pushed at its side. */
  const std::string plate = R"(set Kind = particles
subsection Physics
  set Dimension = 2
end
subsection Specimen
  set Source    = file
  set File      = discs.txt
  set Density   = 2000
  set Thickness = 0.01
end
subsection Material
  set Law = linear
  subsection linear
    set Effective modulus = 1e7
  end
end
subsection Clumps
  subsection stone
    set Corners = 0, 0; 0.04, 0; 0.03, 0.02; 0, 0.02
    set Pebbles = inside
  end
end
subsection Gravity
  set Acceleration        = 0, 0, 0
  set Initial equilibrium = none
end
subsection Forces
  subsection stone
    set Force x = 0.1
  end
end
subsection Probes
  subsection speed
    set Quantity  = velocity
    set Group     = stone
    set Component = x
  end
end
subsection Time
  set End time = 1e-4
  set Damping  = 0
end
subsection Output
  set Samples   = 10
  set Snapshots = 0
end
)";

  /** A square grid of discs of 1 mm that nearly touch, 20 by 20. */
  std::string grid()
  {
    std::string text;
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 20; ++i)
        text += std::to_string(0.001 + 0.00205 * i) + " " + std::to_string(0.001 + 0.00205 * j) + " 0 0.001\n";
    return text;
  }
} // namespace

TEST_CASE("Bodies filled with pebbles weigh on a floor what their shapes weigh, and come to rest on a face",
          "[apps][particles][slow]")
{
  const ScratchFolder      folder;
  std::vector<std::string> changes = {"Output/Snapshots=0"};
  for (const std::string body : {"tetrahedron", "octahedron", "brick"})
    changes.insert(changes.end(),
                   {"Probes/" + body + "_height/Quantity=position", "Probes/" + body + "_height/Group=" + body,
                    "Probes/" + body + "_height/Component=z"});
  const Results found = results_of(folder, tumbling, changes);
  // Cube of 20 mm, tetrahedron (edge 20 sqrt 2), octahedron (edge 15 sqrt 2), brick of 30 mm x 15 mm x 10 mm.
  const double volume = 8e-6 + std::pow(0.02 * std::sqrt(2.0), 3) / (6 * std::sqrt(2.0)) +
                        std::sqrt(2.0) / 3 * std::pow(0.015 * std::sqrt(2.0), 3) + 4.5e-6;
  const double weight = 2650 * volume * 9.81;
  CHECK(std::fabs(found.series.column("weight").back()) == Approx(weight).epsilon(1e-3));
  CHECK(found.balance_error() < 1e-3);
  // From a face to the centre of each, up to what is left between face and pebbles.
  const auto lies_at = [&](const char *probe, const double height) {
    INFO(probe);
    CHECK(found.series.column(probe).back() == Approx(height).margin(2e-4));
  };
  lies_at("height", 0.01);
  lies_at("tetrahedron_height", 0.01 / std::sqrt(3.0));
  lies_at("octahedron_height", 0.015 / std::sqrt(3.0));
  lies_at("brick_height", 0.005);
}

TEST_CASE("A shape takes the particles inside it, or those of a group, with its own mass", "[apps][particles]")
{
  const ScratchFolder folder;
  folder.file("discs.txt", grid());
  folder.file("x.prm", plate);
  const double area = 0.5 * (0.04 + 0.03) * 0.02, mass = 2000 * area * 0.01;
  // A force on each pebble: their number is that of the centres inside the trapezium.
  int pebbles = 0;
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 20; ++i)
      {
        const double x = 0.001 + 0.00205 * i, y = 0.001 + 0.00205 * j;
        pebbles += y <= 0.02 && x <= 0.04 - 0.5 * y;
      }
  // A force of 0.1 N on each for the time of the run: velocities are those half a step before.
  const auto acceleration = [&](const std::vector<std::string> &changes) {
    const Results found = results_of(folder, "x.prm", changes);
    const auto   &time = found.series.column("time"), &speed = found.series.column("speed");
    return (speed.back() - speed[1]) / (time.back() - time[1]);
  };
  const double inside = acceleration({});
  CHECK(inside == Approx(0.1 * pebbles / mass).epsilon(1e-3));
  CHECK(acceleration({"Clumps/stone/Mass=" + std::to_string(2 * mass)}) == Approx(0.5 * inside).epsilon(1e-3));
  CHECK(acceleration({"Clumps/stone/Pebbles=group", "Groups/stone/Shape=box", "Groups/stone/Lower=0, 0, 0",
                      "Groups/stone/Upper=0.02, 0.02, 0"}) == Approx(0.1 * 100 / mass).epsilon(1e-2));
}

TEST_CASE("A body whose particles are given a turn turns as a whole, and gauges read the body", "[apps][particles]")
{
  const ScratchFolder folder;
  // The brick alone moves, far from all others: 30 mm x 15 mm x 10 mm.
  const std::vector<std::string> still = {"Gravity/Acceleration=0, 0, 0",
                                          "Initial velocity/cube/Velocity x=0",
                                          "Time/Damping=0",
                                          "Time/End time=2e-4",
                                          "Output/Samples=4",
                                          "Output/Snapshots=0",
                                          "Probes/turning/Quantity=kinetic energy",
                                          "Probes/turning/Group=brick"};
  const double mass = 2650 * 4.5e-6, I = mass / 12 * (0.03 * 0.03 + 0.01 * 0.01), energy = 0.5 * I * 1e4;
  CHECK(energy == Approx(4.969e-3).epsilon(1e-3));
  for (const std::vector<std::string> &field :
       {std::vector<std::string>{"Initial velocity/brick/Velocity z=-100*(x-0.04)"},
        std::vector<std::string>{"Initial velocity/brick/Velocity z=-100*(x-0.04)",
                                 "Initial velocity/brick/Velocity x=100*(z-0.03)"},
        std::vector<std::string>{"Initial velocity/brick/Spin y=100"}})
    {
      std::vector<std::string> changes = still;
      changes.insert(changes.end(), field.begin(), field.end());
      const Results found = results_of(folder, tumbling, changes);
      for (const char *column : {"turning", "energy_kinetic"})
        for (const double value : found.series.column(column))
          CHECK(value == Approx(energy).epsilon(1e-6));
    }
}

TEST_CASE("The place of a body is that of its shape, wherever its particles lie", "[apps][particles]")
{
  const ScratchFolder folder;
  folder.file("discs.txt", grid());
  folder.file("x.prm", plate);
  const Results found =
    results_of(folder, "x.prm",
               {"Forces/stone/Force x=0", "Initial velocity/stone/Velocity y=0.3", "Probes/x/Quantity=position",
                "Probes/x/Group=stone", "Probes/x/Component=x", "Probes/way/Quantity=displacement",
                "Probes/way/Group=stone", "Probes/way/Component=y"});
  // A square of 30 by 20 mm and a triangle of 10 by 20 beside it.
  const double centre = (6 * 0.015 + 1 * (0.03 + 0.01 / 3)) / 7;
  for (const double x : found.series.column("x"))
    CHECK(x == Approx(centre).epsilon(1e-12));
  CHECK(found.series.column("way").back() == Approx(0.3 * found.series.column("time").back()).epsilon(1e-9));
}

TEST_CASE("Bodies that are none are refused with the place", "[apps][particles][S14]")
{
  const ScratchFolder folder;
  folder.file("discs.txt", grid());
  folder.file("x.prm", plate);
  const auto refused = [&](const std::string &scene, const std::vector<std::string> &changes, const char *words) {
    is_refused(folder, scene, changes, words);
  };
  const std::string body = "More particles/cube/";
  refused(tumbling, {body + "Corners=0, 0, 0; 1, 0, 0; 0, 1, 0"}, "at least 4 corners");
  refused(tumbling, {body + "Corners=0, 0, 0; 1, 0, 0; 0, 1, 0; 1, 1, 0"}, "in one plane");
  refused(tumbling, {body + "Corners=0, 0; 1, 0, 0"}, "corner 1, \"0, 0\": expected three coordinates");
  refused(tumbling, {body + "Radius=0.02"}, "Take smaller ones");
  refused("x.prm", {"Clumps/stone/Corners=0, 0; 0.04, 0; 0.01, 0.005; 0, 0.02"}, "not convex at corner 3");
  refused("x.prm", {"Clumps/stone/Corners=1, 1; 2, 1; 1, 2"}, "the centres of 0 particles lie in the shape");
  refused("x.prm", {"Clumps/stone/Corners="}, "there is no shape to lie inside of");
  refused("x.prm", {"Groups/stone/Shape=sphere", "Groups/stone/Centre=0, 0, 0", "Groups/stone/Radius=1"},
          "there is a group of this name already");
  refused("x.prm", {"Motion/stone/Velocity x=1"}, "Motion/stone: particle 1 is a pebble of a clump");
  refused(tumbling, {"Motion/brick/Turn y=1"}, "Motion/brick: particle ");
}
