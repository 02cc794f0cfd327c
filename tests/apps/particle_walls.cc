// Walls in scenes of kind "particles", through the program: shapes, motion, forces, refusals.
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** A ball of 10 mm, 1 mm above a wall, falls. */
  const std::string above_wall = loose_balls("1e6") + R"(subsection More particles
  subsection ball
    set Centre = 0, 0, 0.011
    set Radius = 0.01
  end
end
subsection Gravity
  set Acceleration        = 0, 0, -9.81
  set Initial equilibrium = none
end
subsection Walls
  subsection floor
    set Shape             = plate
    set Corner            = -1, -1, 0
    set First edge        = 2, 0, 0
    set Second edge       = 0, 2, 0
    set Effective modulus = 1e6
  end
end
subsection Probes
  subsection height
    set Quantity  = position
    set Component = z
  end
  subsection floor
    set Quantity  = wall force
    set Wall      = floor
    set Component = z
  end
  subsection impulse
    set Quantity  = wall impulse
    set Wall      = floor
    set Component = z
  end
  subsection velocity
    set Quantity  = velocity
    set Component = z
  end
end
subsection Time
  set End time    = 0.1
  set Step factor = 0.1
  set Damping     = 0
end
subsection Output
  set Samples   = 1000
  set Snapshots = 0
end
)";
} // namespace

TEST_CASE("A ball bounces on a wall of any shape, which takes its momentum", "[apps][particles][walls]")
{
  const ScratchFolder folder;
  folder.file("x.prm", above_wall);
  folder.file("floor.stl", R"(solid floor
facet normal 0 0 1
outer loop
vertex -1000 -1000 0
vertex 1000 -1000 0
vertex 1000 1000 0
endloop
endfacet
facet normal 0 0 1
outer loop
vertex -1000 -1000 0
vertex 1000 1000 0
vertex -1000 1000 0
endloop
endfacet
endsolid floor
)");
  folder.file("floor.msh", R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 -1 -1 0
2 1 -1 0
3 1 1 0
4 -1 1 0
$EndNodes
$Elements
1
1 3 2 1 1 1 2 3 4
$EndElements
)");
  const double      mass = 2500 * 4.0 / 3 * M_PI * 1e-6;
  const std::string wall = "Walls/floor/";
  // A box whose upper side would lie in the ball
  const auto through_ball = [&](const std::string &open) {
    return std::vector<std::string>{wall + "Shape=box", wall + "Lower=-1, -1, 0", wall + "Upper=1, 1, 0.015",
                                    wall + "Open sides=" + open};
  };
  std::vector<double> heights;
  for (const std::vector<std::string> &changes :
       std::vector<std::vector<std::string>>{{},
                                             {wall + "Shape=plane"},
                                             {wall + "Shape=box", wall + "Lower=-1, -1, -1", wall + "Upper=1, 1, 0"},
                                             through_ball("+z"),
                                             through_ball("z max"),
                                             {wall + "Shape=file", wall + "File=floor.stl", wall + "Scale=1e-3"},
                                             {wall + "Shape=file", wall + "File=floor.msh"}})
    {
      const Results found = results_of(folder, "x.prm", changes);
      CHECK(found.figure("height", "largest") == Approx(0.011).margin(1e-5));
      CHECK(found.figure("height", "least") < 0.01);
      CHECK(found.figure("floor", "least") < 0);
      CHECK(found.balance_error() < 1e-3);
      // momentum of the ball less that of its weight
      const double time = found.series.column("time").back();
      CHECK(found.figure("impulse", "end") ==
            Approx(-mass * (found.figure("velocity", "end") + 9.81 * time)).margin(1e-4 * mass));
      heights.push_back(found.figure("height", "end"));
      std::filesystem::remove_all(folder / "results");
    }
  is_refused(folder, "x.prm", {wall + "Shape=file", wall + "File=floor.stl"}, "m. In mm? Set Scale = 1e-3");
  CHECK(outcome_of(folder, "check", "x.prm", {wall + "Shape=file", wall + "File=floor.stl", wall + "Scale=1"}).status ==
        0);
  for (const double height : heights)
    CHECK(height == Approx(heights.front()).epsilon(1e-9));
}

TEST_CASE("STL as programs write it is read: capital letters, a byte-order mark, a facet without area",
          "[apps][particles][walls]")
{
  const ScratchFolder folder;
  folder.file("x.prm", above_wall);
  const std::string file = "\xEF\xBB\xBFSOLID FLOOR\r\n"
                           "  FACET NORMAL 0 0 1\r\n    OUTER LOOP\r\n      VERTEX -1 -1 0\r\n      VERTEX 1 -1 0\r\n"
                           "      VERTEX 1 1 0\r\n    ENDLOOP\r\n  ENDFACET\r\n"
                           "  FACET NORMAL 0 0 1\r\n    OUTER LOOP\r\n      VERTEX -1 -1 0\r\n      VERTEX 0 0 0\r\n"
                           "      VERTEX 1 1 0\r\n    ENDLOOP\r\n  ENDFACET\r\n"
                           "  FACET NORMAL 0 0 1\r\n    OUTER LOOP\r\n      VERTEX -1 -1 0\r\n      VERTEX 1 1 0\r\n"
                           "      VERTEX -1 1 0\r\n    ENDLOOP\r\n  ENDFACET\r\nENDSOLID FLOOR\r\n";
  folder.file("floor.stl", file);
  const std::vector<std::string> with    = {"Walls/floor/Shape=file", "Walls/floor/File=floor.stl"};
  const Outcome                  outcome = outcome_of(folder, "check", "x.prm", with);
  INFO(outcome.err);
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("walls        floor (2 facets)"));
  CHECK_THAT(outcome.err, Contains("floor.stl: 1 of 3 facets have no area and are left out."));
  const Results found = results_of(folder, "x.prm", with);
  CHECK(found.figure("height", "least") < 0.01);
  CHECK(found.balance_error() < 1e-3);
  folder.file("floor.stl", "solid flat\nvertex 0 0 0\nvertex 1 1 0\nvertex 2 2 0\nendloop\n");
  std::filesystem::remove_all(folder / "results");
  is_refused(folder, "x.prm", with, "floor.stl: none of its triangles has an area", {"check"});
}

TEST_CASE("A wall moves as its formula says, and a force by formula pushes", "[apps][particles][walls]")
{
  const ScratchFolder folder;
  folder.file("x.prm", above_wall);
  const Results pushed = results_of(folder, "x.prm", {"Gravity/Acceleration=0, 0, 0", "Forces/all/Force z=1e-3*t"});
  const double  mass = 2500 * 4.0 / 3 * M_PI * 1e-6, time = pushed.series.column("time").back();
  CHECK(pushed.figure("height", "end") == Approx(0.011 + 1e-3 * time * time * time / (6 * mass)).epsilon(1e-4));
  CHECK(pushed.balance_error() < 1e-3);
  std::filesystem::remove_all(folder / "results");
  const Results lifted = results_of(folder, "x.prm",
                                    {"Walls/floor/Velocity z=0.2*t", "Probes/way/Quantity=wall travel",
                                     "Probes/way/Wall=floor", "Time/Damping=0.3", "Output/Snapshots=3"});
  CHECK(lifted.figure("way", "end") == Approx(0.1 * time * time).epsilon(1e-3));
  CHECK(lifted.figure("height", "end") == Approx(0.01 + 0.1 * time * time).margin(2e-4));
  CHECK(std::filesystem::exists(folder / "results/particles_walls.pvd"));
  const Outcome checked = outcome_of(folder, "check", "x.prm", {});
  CHECK_THAT(checked.out, Contains("walls        floor (2 facets)"));
}

TEST_CASE("Walls that cannot be are refused with the place and the reason", "[apps][particles][walls][S14]")
{
  const ScratchFolder folder;
  folder.file("x.prm", above_wall);
  folder.file("bad.stl", "solid x\nvertex 1 2\n");
  folder.file("none.stl", "no such thing");
  const auto refused = [&folder](const std::vector<std::string> &changes, const std::string &words) {
    is_refused(folder, "x.prm", changes, words, {"run"});
  };
  const std::string wall = "Walls/floor/";
  refused({wall + "Second edge=1, 0, 0"}, "wall floor: facet 1 has zero area");
  refused({"More particles/ball/Centre=0, 0, 0.004"}, "surface floor: particle 1 at");
  refused({"Initial velocity/ball/Velocity z=1e5 m/s"}, "more than its radius");
  refused({wall + "Velocity x=x"}, "a wall moves as a rigid body");
  refused({wall + "Shape=plane", wall + "Spin x=1"}, "an unbounded plane does not spin");
  refused({wall + "Control=force", wall + "Direction=0, 0, 1", wall + "Largest speed=1"}, "Say how hard");
  refused({wall + "Shape=file", wall + "File=bad.stl"}, "bad.stl:2");
  refused({wall + "Shape=file", wall + "File=none.stl"}, "is no STL file");
  refused({"Probes/floor/Wall=flor"}, "there is no such wall. Did you mean \"floor\"?");
  refused({"Gravity/Initial equilibrium=static"}, "walls only push");
}
