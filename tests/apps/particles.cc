// Scenes of kind "particles", through the program: closed forms, groups, stops, resuming, refusals.
#include "postprocess/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <thread>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  struct Results
  {
    nlohmann::json        summary;
    postprocess::CsvTable series;

    double figure(const char *gauge, const char *when) const
    {
      return summary["figures"][gauge][when]["value"].get<double>();
    }
    double balance_error() const { return summary["energy"]["balance_error"].get<double>(); }
  };

  Outcome outcome_of(const ScratchFolder            &folder,
                     const std::string              &command,
                     const std::string              &scene,
                     const std::vector<std::string> &changes)
  {
    std::vector<std::string> words = {command, scene};
    if (command == "run")
      words.insert(words.end(), {"-o", "results"});
    for (const std::string &change : changes)
      words.insert(words.end(), {"-s", change});
    return run(folder.path(), words);
  }

  Results
  results_of(const ScratchFolder &folder, const std::string &scene, const std::vector<std::string> &changes = {})
  {
    const Outcome outcome = outcome_of(folder, "run", scene, changes);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return {nlohmann::json::parse(content_of(folder / "results/summary.json")),
            postprocess::read_csv_table(folder / "results/series.csv", true)};
  }

  std::string shipped(const char *name) { return places::sources() + "/apps/scenes/" + name; }

  /** Two balls of 10 mm, one of them on its way to the other; contacts of 1e7 Pa without friction, no weight. */
  const std::string collision = R"(set Kind = particles
subsection Specimen
  set Source  = none
  set Density = 2500
end
subsection More particles
  subsection first
    set Centre = 0, 0, 0
    set Radius = 0.01
  end
  subsection second
    set Centre = 0.021, 0, 0
    set Radius = 0.01
  end
end
subsection Material
  set Law = linear
  subsection linear
    set Effective modulus = 1e7
  end
end
subsection Initial velocity
  subsection first
    set Velocity x = 0.5
  end
end
subsection Gauges
  subsection first
    set Quantity  = velocity
    set Group     = first
    set Component = x
  end
  subsection second
    set Quantity  = velocity
    set Group     = second
    set Component = x
  end
  subsection gap
    set Quantity    = distance
    set Group       = first
    set Other group = second
  end
end
subsection Time
  set End time    = 0.01
  set Step factor = 0.02
  set Damping     = 0
end
subsection Output
  set Samples   = 100
  set Snapshots = 0
end
)";
} // namespace

TEST_CASE("A ball falls, bounces and returns as closed forms say, without any bond", "[apps][particles]")
{
  const ScratchFolder folder;
  const Results       found = results_of(folder, shipped("bouncing_sphere.prm"), {"Output/Snapshots=0"});
  const double        g = 9.81, drop = 0.005, mass = 2500 * 4.0 / 3 * pi * 1e-6,
               stiffness = 1e7 * pi * 1e-4 / 0.02, // E* A / (sum of radii)
    speed = std::sqrt(2 * g * drop), fall = speed / g;
  const auto &time = found.series.column("time"), &height = found.series.column("height"),
             &velocity = found.series.column("velocity");
  const double step    = found.summary["cost"]["time_step"].get<double>();
  std::size_t  flights = 0;
  for (std::size_t row = 0; row < found.series.rows() && time[row] < fall; ++row, ++flights)
    {
      // The velocity given at the start is that of half a step before: the path is early by as much.
      CHECK(height[row] == Approx(0.025 - 0.5 * g * time[row] * time[row]).margin(0.6 * g * step * time[row] + 1e-15));
      if (row > 0)
        CHECK(velocity[row] == Approx(-g * time[row]).margin(0.6 * g * step));
    }
  CHECK(flights > 100);
  // An oscillator under its weight that begins with this speed. The blow is sampled every 0.1 ms; it lasts 0.8 ms.
  const double weight  = mass * g;
  const double largest = weight + std::sqrt(weight * weight + stiffness * mass * speed * speed);
  CHECK(found.figure("blow", "largest") - weight /* of the anvil */ == Approx(largest).epsilon(0.02));
  // Nothing is lost: it comes back to where it was, after a contact of about half a period.
  const double contact = pi * std::sqrt(mass / stiffness), back = 2 * fall + contact;
  const auto   at = static_cast<std::size_t>(std::round(back / 0.2 * 2000));
  CHECK(height[at] == Approx(0.025).margin(0.005 * drop));
  CHECK(found.figure("height", "largest") == Approx(0.025).margin(0.005 * drop));
  CHECK(found.balance_error() < 1e-3);
  CHECK(found.summary["ended_by"] == "end time");
  CHECK(std::filesystem::exists(folder / "results/curve.png"));
  CHECK_FALSE(std::filesystem::exists(folder / "results/crack.png")); // nothing can crack
}

TEST_CASE("Two balls that meet exchange momentum as their masses ask, and lose no energy", "[apps][particles]")
{
  const ScratchFolder folder;
  for (const double radius : {0.01, 0.005})
    {
      folder.file("x.prm", replaced(collision, "Centre = 0.021, 0, 0\n    set Radius = 0.01",
                                    "Centre = 0.021, 0, 0\n    set Radius = " + std::to_string(radius)));
      const Results found = results_of(folder, "x.prm", {"Time/End time=0.03"});
      const double  ratio = std::pow(radius / 0.01, 3); // of the masses
      CHECK(found.figure("first", "end") == Approx(0.5 * (1 - ratio) / (1 + ratio)).margin(0.001));
      CHECK(found.figure("second", "end") == Approx(0.5 * 2 / (1 + ratio)).margin(0.001));
      CHECK(found.figure("gap", "least") < 0.01 + radius);
      CHECK(found.balance_error() < 1e-3);
      std::filesystem::remove_all(folder / "results");
    }
}

namespace
{
  /** Tip force over tip deflection of the chain of the shipped beam: hinges and shear springs at its bonds. */
  double chain_stiffness(const double modulus, const double ratio)
  {
    const double radius = 0.005, area = pi * radius * radius, second = area * radius * radius / 4;
    const double bending = modulus * second / (2 * radius), shear = modulus / ratio * area / (2 * radius);
    double       yields = 0;
    for (int bond = 1; bond <= 20; ++bond)
      yields += std::pow((2 * bond - 1) * radius, 2) / bending + 1 / shear;
    return 1 / yields;
  }
} // namespace

TEST_CASE("The bonded beam resists a moved end as its chain of bonds does in closed form", "[apps][particles]")
{
  const ScratchFolder folder;
  const Results       found = results_of(folder, shipped("bonded_beam.prm"));
  CHECK(found.summary["ended_by"] == "equilibrium");
  CHECK(found.figure("deflection", "end") == Approx(1e-3).epsilon(1e-6));
  CHECK(found.figure("force", "end") == Approx(1e-3 * chain_stiffness(1e10, 2.5)).epsilon(1e-3));
  CHECK(found.summary["figures"]["broken_links"] == 0);
  CHECK(found.balance_error() < 1e-4);
  for (const char *name : {"particles_particles.pvd", "particles_links.pvd", "crack.png", "curve.png", "packing.h5",
                           "state.h5", "scene.prm"})
    CHECK(std::filesystem::exists(folder / "results" / name));
}

TEST_CASE("A condition ends a run at the first row where it holds, and the run says which", "[apps][particles]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  const Results found = results_of(folder, "x.prm",
                                   {"Stop/hit/Column=second", "Stop/hit/Value=0.1", "Stop/late/Column=contacts",
                                    "Stop/late/Value=0.5", "Stop/late/From time=1"});
  CHECK(found.summary["ended_by"] == "hit");
  const auto &second = found.series.column("second");
  CHECK(second.back() > 0.1);
  CHECK(std::all_of(second.begin(), second.end() - 1, [](const double v) { return v <= 0.1; }));
  CHECK(found.series.column("time").back() < 0.005);
}

TEST_CASE("Groups are found by box, sphere, cylinder, layer and file", "[apps][particles]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("numbers.txt", "# three of them\n1, 2\n175\n");
  folder.file("x.prm", R"(set Kind = particles
subsection Specimen
  set Source            = file
  set File              = packing.txt
  set Density           = 2500
  set Interaction ratio = 1.05
end
subsection Material
  set Law = parallel-bond
  subsection parallel-bond
    set Effective modulus = 1e9
    set Tensile strength  = 1e6
    set Cohesion          = 1e6
  end
end
subsection Groups
  subsection bottom
    set Members   = layer
    set Thickness = 1e-4
  end
  subsection half
    set Shape = box
    set Lower = -1, -1, -1
    set Upper = 1, 1, 7e-3
  end
  subsection corner
    set Shape  = sphere
    set Centre = 0, 0, 0
    set Radius = 1e-4
  end
  subsection row
    set Shape  = cylinder
    set From   = -1e-3, 0, 0
    set To     = 9e-3, 0, 0
    set Radius = 1e-4
  end
  subsection listed
    set Members = file
    set File    = numbers.txt
  end
end
subsection Time
  set End time = 1e-4
end
)");
  const Outcome checked = outcome_of(folder, "check", "x.prm", {});
  INFO(checked.err);
  REQUIRE(checked.status == 0);
  CHECK_THAT(checked.out, Contains("groups       all 175, bottom 25, corner 1, half 125, listed 3, row 5\n"));
  CHECK_THAT(checked.out, Contains("duration"));
  const Outcome none = outcome_of(folder, "check", "x.prm", {"Groups/corner/Centre=5, 5, 5"});
  CHECK(none.status == 2);
  CHECK_THAT(none.err, Contains("Groups/corner: no particle's centre lies in it"));
  folder.file("numbers.txt", "1\n176\n");
  CHECK_THAT(outcome_of(folder, "check", "x.prm", {}).err, Contains("numbers.txt:2: \"176\" is none of the particles"));
  folder.file("numbers.txt", "1\n2 1\n");
  CHECK_THAT(outcome_of(folder, "check", "x.prm", {}).err, Contains("numbers.txt:2: \"1\" is there a second time"));
}

TEST_CASE("What a scene of particles cannot mean is refused with the place and the reason", "[apps][particles][S14]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  const auto refused = [&](const std::vector<std::string> &changes, const std::string &words) {
    for (const char *command : {"check", "run"})
      {
        const Outcome outcome = outcome_of(folder, command, "x.prm", changes);
        INFO(outcome.err);
        CHECK(outcome.status == 2);
        CHECK_THAT(outcome.err, Contains(words));
        CHECK_FALSE(std::filesystem::exists(folder / "results"));
      }
  };
  refused({"Motion/frist/Velocity x=1"}, "must be named after a group, and there is none of that name. Did you mean "
                                         "\"first\"?");
  refused({"Gauges/gap/Other group=third"}, "there is no such group");
  refused({"Gauges/pull/Quantity=reaction", "Gauges/pull/Group=first"},
          "only a group of section Motion has a reaction");
  refused({"Gauges/time/Quantity=velocity"}, "series.csv has a column of this name already");
  refused({"Gauges/my gauge/Quantity=velocity"}, "the name of a gauge is that of a column");
  refused({"Stop/x/Column=frist", "Stop/x/Value=1"}, "series.csv has no such column. Did you mean \"first\"?");
  refused({"Output/Curve vertical=frist"}, "series.csv has no such column");
  refused({"Motion/first/Velocity x=0", "Motion/all/Velocity x=t"}, "is in group");
  refused({"Motion/first/Velocity x=sin("}, "expected a formula");
  refused({"Physics/Rotations=false", "Motion/first/Spin x=1"}, "particles do not spin");
  refused({"Physics/Dimension=2", "Specimen/Thickness=0.01", "Motion/first/Velocity z=1"}, "in two dimensions");
  refused({"Groups/first/Members=layer", "Groups/first/Thickness=1"}, "there is a group of this name already");
  refused({"Material/Law=CPM", "Material/CPM/Normal modulus=1e9"}, "is not set and has no default");
  refused({"Material/Law=parallel-bond", "Material/parallel-bond/Effective modulus=1e9",
           "Material/parallel-bond/Tensile strength=1e6", "Material/parallel-bond/Cohesion=1e6"},
          "the law links particles from the start: say up to which distance");
  refused({"More particles/first/Radius=0.5"}, "overlap");
  refused({"Time/End time=0"}, "Time/End time");
}

namespace
{
  /** Everything but timings and pictures. */
  std::string reproducible_part(const std::filesystem::path &results)
  {
    return listing_of(results / "particles_particles") + listing_of(results / "particles_links") +
           content_of(results / "series.csv") + content_of(results / "particles_links.pvd");
  }
} // namespace

TEST_CASE("A run of particles that is interrupted or killed goes on to the same bits", "[apps][particles][slow][S13]")
{
  const ScratchFolder            folder;
  const std::string              scene = shipped("bonded_beam.prm");
  const std::vector<std::string> slow  = {"-s", "Time/Step factor=0.1", "-s", "Output/Checkpoint interval=0.01",
                                          "-s", "Output/Samples=200"};
  const auto                     with  = [&](std::vector<std::string> words) {
    words.insert(words.end(), slow.begin(), slow.end());
    return words;
  };
  REQUIRE(run(folder.path(), with({"run", scene, "-o", "whole"})).status == 0);
  for (const int signal : {SIGINT, SIGKILL})
    {
      Program program(folder.path(), with({"run", scene, "-o", "results"}));
      bool    sent = false;
      while (program.running())
        {
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
          const auto running = folder / "results/running";
          if (!sent && std::filesystem::exists(running / "particles_links/particles_links_000002.vtp") &&
              std::filesystem::exists(running / "checkpoint.h5"))
            {
              program.send(signal);
              sent = true;
            }
        }
      REQUIRE(program.wait().status == 128 + signal);
      const Outcome resumed = run(folder.path(), with({"run", scene, "-o", "results", "--resume"}));
      INFO(resumed.err);
      REQUIRE(resumed.status == 0);
      CHECK(reproducible_part(folder / "results") == reproducible_part(folder / "whole"));
      std::filesystem::remove_all(folder / "results");
    }
}

TEST_CASE("Contacts take the law that is chosen for them, apart from that of the bonds", "[apps][particles]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  // Head-on and without friction each law is a spring: half the speed squared is the deepest overlap's k delta^2/(m/2).
  const auto deepest = [&](std::vector<std::string> changes) {
    changes.push_back("Output/Samples=5000"); // a thousand during the impact
    const Results found = results_of(folder, "x.prm", changes);
    CHECK(found.figure("first", "end") == Approx(0).margin(1e-3));
    CHECK(found.figure("second", "end") == Approx(0.5).epsilon(1e-3));
    std::filesystem::remove_all(folder / "results");
    return 0.02 - found.figure("gap", "least");
  };
  const std::vector<std::string> cpm   = {"Material/Contacts=CPM",
                                          "Material/CPM/Normal modulus=4e7",
                                          "Material/CPM/Shear ratio=0.2",
                                          "Material/CPM/Limit elastic strain=1e-4",
                                          "Material/CPM/Relative ductility=10",
                                          "Material/CPM/Cohesion=0",
                                          "Material/CPM/Friction coefficient=0"};
  const double                   alone = deepest({});
  CHECK(deepest({"Material/Contacts=linear"}) == alone);
  // Four times as stiff; CPM measures strain against the distance at which contact began, shorter by less than the overlap.
  CHECK(deepest(cpm) == Approx(alone / 2).epsilon(0.02));

  const Outcome missing = outcome_of(folder, "run", "x.prm", {"Material/Contacts=CPM"});
  CHECK(missing.status == 2);
  CHECK_THAT(missing.err, Contains("CPM") && Contains("Normal modulus"));
}

namespace
{
  /** A ball of 10 mm, 1 mm above a wall, falls. */
  const std::string above_wall = R"(set Kind = particles
subsection Specimen
  set Source  = none
  set Density = 2500
end
subsection More particles
  subsection ball
    set Centre = 0, 0, 0.011
    set Radius = 0.01
  end
end
subsection Material
  set Law = linear
  subsection linear
    set Effective modulus = 1e6
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
subsection Gauges
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
  const double        mass = 2500 * 4.0 / 3 * pi * 1e-6;
  const std::string   wall = "Walls/floor/";
  std::vector<double> heights;
  for (const std::vector<std::string> &changes :
       std::vector<std::vector<std::string>>{{},
                                             {wall + "Shape=plane"},
                                             {wall + "Shape=box", wall + "Lower=-1, -1, -1", wall + "Upper=1, 1, 0"},
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
  for (const double height : heights)
    CHECK(height == Approx(heights.front()).epsilon(1e-9));
}

TEST_CASE("A wall moves as its formula says, and a force by formula pushes", "[apps][particles][walls]")
{
  const ScratchFolder folder;
  folder.file("x.prm", above_wall);
  const Results pushed = results_of(folder, "x.prm", {"Gravity/Acceleration=0, 0, 0", "Forces/all/Force z=1e-3*t"});
  const double  mass = 2500 * 4.0 / 3 * pi * 1e-6, time = pushed.series.column("time").back();
  CHECK(pushed.figure("height", "end") == Approx(0.011 + 1e-3 * time * time * time / (6 * mass)).epsilon(1e-4));
  CHECK(pushed.balance_error() < 1e-3);
  std::filesystem::remove_all(folder / "results");
  const Results lifted = results_of(folder, "x.prm",
                                    {"Walls/floor/Velocity z=0.2*t", "Gauges/way/Quantity=wall travel",
                                     "Gauges/way/Wall=floor", "Time/Damping=0.3", "Output/Snapshots=3"});
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
  const auto refused = [&](const std::vector<std::string> &changes, const std::string &words) {
    const Outcome outcome = outcome_of(folder, "run", "x.prm", changes);
    INFO(outcome.err);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(words));
    CHECK_FALSE(std::filesystem::exists(folder / "results"));
  };
  const std::string wall = "Walls/floor/";
  refused({wall + "Second edge=1, 0, 0"}, "wall floor: facet 1 has zero area");
  refused({"More particles/ball/Centre=0, 0, 0.004"}, "wall floor: particle 1 at");
  refused({"Initial velocity/ball/Velocity z=1e5"}, "more than its radius");
  refused({wall + "Velocity x=x"}, "a wall moves as a rigid body");
  refused({wall + "Shape=plane", wall + "Spin x=1"}, "an unbounded plane does not spin");
  refused({wall + "Control=force", wall + "Direction=0, 0, 1", wall + "Largest speed=1"}, "Say how hard");
  refused({wall + "Shape=file", wall + "File=bad.stl"}, "bad.stl:2");
  refused({wall + "Shape=file", wall + "File=none.stl"}, "is no STL file");
  refused({"Gauges/floor/Wall=flor"}, "there is no such wall. Did you mean \"floor\"?");
  refused({"Gravity/Initial equilibrium=static"}, "walls only push");
}
