// Tables of time and value in place of formulas: motion of walls and particles, loads of a solid.
#include "tests/apps/continuum_scenes.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** A ball that is moved. */
  const std::string moved_ball = loose_balls("1e6") + R"(subsection More particles
  subsection ball
    set Centre = 0, 0, 0
    set Radius = 0.01
  end
end
subsection Motion
  subsection ball
    set Velocity x = table way.csv
    set Velocity y = 0
    set Velocity z = 0
  end
end
subsection Probes
  subsection place
    set Quantity  = position
    set Component = x
  end
end
subsection Time
  set End time = 0.04
end
subsection Output
  set Samples   = 40
  set Snapshots = 0
end
)";
} // namespace

TEST_CASE("A table of time and velocity moves particles as the formula of the same lines does", "[apps][particles]")
{
  const ScratchFolder folder;
  folder.file("x.prm", moved_ball);
  // Up to 0.2 m/s in 20 ms, at rest from 30 ms on: 2 mm and 1 mm.
  for (const char *table : {"time,velocity\n0,0\n0.02,0.2\n0.03,0\n", "t [ms],v [mm/s]\n0,0\n20,200\n30,0\n",
                            "time;displacement rate [m/s]\n0;0\n0.02;0.2\n0.03;0\n"})
    {
      folder.file("way.csv", table);
      const Results found = results_of(folder, "x.prm");
      CHECK(found.figure("place", "end") == Approx(3e-3).epsilon(1e-3));
      std::filesystem::remove_all(folder / "results");
    }
  folder.file("way.csv", "time,velocity\n0.01,0.1\n0.02,0.1\n"); // its first and last value hold outside
  const Results steady = results_of(folder, "x.prm");
  CHECK(steady.figure("place", "end") == Approx(0.1 * steady.series.column("time").back()).epsilon(1e-9));
}

TEST_CASE("A table of time and load is that of the formula in a solid, to the digits", "[apps]")
{
  const ScratchFolder folder;
  folder.file("two.msh", two_squares_mesh());
  folder.file("x.prm", two_squares_scene());
  folder.file("load.csv", "time,shear [MPa],pull [MPa]\n0,0,0\n1,7,2\n");
  const Results by_formula = results_of(folder, "x.prm");
  std::filesystem::remove_all(folder / "results");
  const Results by_table = results_of(folder, "x.prm", {"Boundary conditions/right/Traction x=table load.csv: pull"});
  CHECK(by_table.series.columns == by_formula.series.columns);
  // The scene that stands beside the results finds the table from there.
  const Outcome again = run(folder / "results", {"check", "scene.prm"});
  INFO(again.err);
  CHECK(again.status == 0);
}

TEST_CASE("A table that is none is refused with the file and the place in it", "[apps]")
{
  const ScratchFolder folder;
  folder.file("x.prm", moved_ball);
  const auto refused = [&](const std::string &table, const std::string &words) {
    folder.file("way.csv", table);
    is_refused(folder, "x.prm", {}, words);
  };
  refused("time,velocity\n0,0\n0,1\n", "way.csv: row 2: time 0 after 0: times must ascend.");
  refused("time,velocity\n", "way.csv: has no rows");
  refused("when,velocity\n0,0\n", "way.csv: there is no column time. Columns: when, velocity.");
  refused("time,a,b\n0,0,0\n", "has 2 columns besides the time. Say which: table FILE: COLUMN");
  refused("time,velocity [N]\n0,0\n", "column velocity is in [N], expected [m/s]");
  refused("time,displacement\n0,0\n1,1\n", "column displacement is a displacement by its name, and a table in [m/s]");
  refused("time,velocity\n0,x\n", "way.csv, line 2: \"x\" is not a number");
  folder.file("way.csv", "time,velocity\n0,0\n1,1\n");
  is_refused(folder, "x.prm", {"Motion/ball/Velocity x=table none.csv"}, "there is no file ");
  folder.file("two.msh", two_squares_mesh());
  folder.file("y.prm", two_squares_scene());
  folder.file("load.csv", "time,pull\n0,0\n1,2\n");
  is_refused(folder, "y.prm", {"Boundary conditions/right/Traction x=table load.csv"}, "In MPa or kPa?");
}

TEST_CASE("A velocity at the start that varies in time, by a table or by t, is refused", "[apps]")
{
  const ScratchFolder folder;
  folder.file("way.csv", "time,velocity\n0,1\n1,2\n");
  folder.file("x.prm", replaced(moved_ball, "subsection Motion\n", "subsection Initial velocity\n"));
  const std::string once = ": is taken once, at the start: a number, or a formula of x, y and z.";
  is_refused(folder, "x.prm", {}, "Initial velocity/ball/Velocity x = table way.csv" + once);
  is_refused(folder, "x.prm", {"Initial velocity/ball/Velocity x=-t"}, "Initial velocity/ball/Velocity x = -t" + once);
  is_refused(folder, "x.prm", {"Initial velocity/ball/Velocity x=1", "Initial velocity/ball/Spin z=2*t"},
             "Initial velocity/ball/Spin z = 2*t" + once);
  CHECK(outcome_of(folder, "check", "x.prm", {"Initial velocity/ball/Velocity x=1 + y"}).status == 0);
  const auto refused = [&](const std::string &scene, const std::string &entry) {
    const Outcome found = run(folder.path(), {"check", places::scene(scene), "-s", entry + "=table way.csv"});
    CHECK(found.status == 2);
    CHECK_THAT(found.err, Contains(entry + " = table way.csv" + once));
  };
  refused("bar_impact.prm", "Motion/Initial velocity x");
  refused("peridynamic_impact.prm", "Initial velocity/x");
}
