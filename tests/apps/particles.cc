// Scenes of kind "particles", through the program: closed forms, groups, stops, resuming, refusals.
#include "postprocess/packings/packing_io.h"
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** Two balls of 10 mm, one of them on its way to the other; contacts of 1e7 Pa without friction, no weight. */
  const std::string collision = loose_balls("1e7") + R"(subsection More particles
  subsection first
    set Centre = 0, 0, 0
    set Radius = 0.01
  end
  subsection second
    set Centre = 0.021, 0, 0
    set Radius = 0.01
  end
end
subsection Initial velocity
  subsection first
    set Velocity x = 0.5
  end
end
subsection Probes
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
  const Results       found = results_of(folder, places::scene("bouncing_sphere.prm"), {"Output/Snapshots=0"});
  const double        g = 9.81, drop = 0.005, mass = 2500 * 4.0 / 3 * M_PI * 1e-6,
               stiffness = 1e7 * M_PI * 1e-4 / 0.02, // E* A / (sum of radii)
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
  const double contact = M_PI * std::sqrt(mass / stiffness), back = 2 * fall + contact;
  const auto   at = static_cast<std::size_t>(std::round(back / 0.2 * 2000));
  CHECK(height[at] == Approx(0.025).margin(0.005 * drop));
  CHECK(found.figure("height", "largest") == Approx(0.025).margin(0.005 * drop));
  CHECK(found.balance_error() < 1e-3);
  CHECK(found.summary["ended_by"] == "end time");
  CHECK(std::filesystem::exists(folder / "results/curve.png"));
  CHECK_FALSE(std::filesystem::exists(folder / "results/crack.png")); // nothing can crack
}

TEST_CASE("Balls too soft for their speed do not pass through each other unseen", "[apps][particles]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  // An oscillator of half a ball's mass: with 1e4 Pa and 10 m/s it would be pressed in by six radii.
  const Outcome through = outcome_of(
    folder, "run", "x.prm",
    {"Material/linear/Effective modulus=1e4 Pa", "Initial velocity/first/Velocity x=10", "Time/Step factor=0.001"});
  CHECK(through.status == 1);
  CHECK_THAT(through.err, Contains("particles 1 and 2 are pressed into each other by") &&
                            Contains("too soft for what it has to stop"));
  // And a step that is longer than a ball could do it in one go.
  const Outcome at_once = outcome_of(
    folder, "run", "x.prm", {"Initial velocity/first/Velocity x=1e5 m/s", "Time/Step factor=0.8", "Time/End time=0.1"});
  CHECK(at_once.status == 1);
  CHECK_THAT(at_once.err, Contains("more than its radius"));
}

TEST_CASE("A run whose balls are pressed deep into each other ends with both named, or says so where that is allowed",
          "[apps][particles]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  CHECK(results_of(folder, "x.prm").summary["warnings"].empty());
  // Pressed in by v sqrt(m / 2 k) = 0.46 of the radius.
  std::vector<std::string> fast = {"Initial velocity/first/Velocity x=25", "Time/End time=0.001"};
  const ScratchFolder      refused;
  refused.file("x.prm", collision);
  const Outcome ended = outcome_of(refused, "run", "x.prm", fast);
  CHECK(ended.status == 1);
  CHECK_THAT(ended.err, Contains("particles 1 and 2 are pressed into each other by 0.3") &&
                          Contains("above Physics/Largest overlap = 0.3"));
  fast.emplace_back("Physics/Largest overlap=0.5");
  const Results deep = results_of(folder, "x.prm", fast);
  REQUIRE(deep.summary["warnings"].size() == 1);
  const auto said = deep.summary["warnings"][0].get<std::string>();
  CHECK_THAT(said, Contains("pressed into each other by up to 0.4"));
}

TEST_CASE("A run whose balls turn far in a step says so", "[apps][particles]")
{
  const ScratchFolder folder;
  const std::string   scene = places::scene("bouncing_sphere.prm");
  const auto          spun  = [&](const char *spin) {
    return results_of(
                folder, scene, {"Output/Snapshots=0", "Time/End time=0.01", std::string("Initial velocity/ball/Spin z=") + spin});
  };
  CHECK(spun("1").summary["warnings"].empty());
  const Results fast = spun("2000");
  REQUIRE(fast.summary["warnings"].size() == 1);
  const auto said = fast.summary["warnings"][0].get<std::string>();
  CHECK_THAT(said, Catch::StartsWith("particles turned by up to 0.0") &&
                     Contains(" rad in a step; laws of links hold for rotations that are small in a step (here at most "
                              "0.01). Lower Time/Step factor"));
  // It turns freely: by as much in every step.
  const double step = fast.summary["end_time"]["value"].get<double>() / fast.summary["cost"]["steps"].get<double>();
  CHECK(std::stod(said.substr(said.find("0.0"))) == Approx(2000 * step).epsilon(0.05));
}

TEST_CASE("Two balls that meet exchange momentum by their masses, and lose no energy", "[apps][particles]")
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
    const double radius = 0.005, area = M_PI * radius * radius, second = area * radius * radius / 4;
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
  const Results       found = results_of(folder, places::scene("bonded_beam.prm"));
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
  const auto refused = [&folder](const std::vector<std::string> &changes, const std::string &words) {
    is_refused(folder, "x.prm", changes, words);
  };
  refused({"Motion/frist/Velocity x=1"}, "must be named after a group, and there is none of that name. Did you mean "
                                         "\"first\"?");
  refused({"Probes/gap/Other group=third"}, "there is no such group");
  refused({"Probes/pull/Quantity=reaction", "Probes/pull/Group=first"},
          "only a group of section Motion has a reaction");
  refused({"Probes/time/Quantity=velocity"}, "series.csv has a column of this name already");
  refused({"Probes/my gauge/Quantity=velocity"}, "the name of a probe is that of a column");
  refused({"Stop/x/Column=frist", "Stop/x/Value=1"}, "series.csv has no such column. Did you mean \"first\"?");
  refused({"Output/Curve vertical=frist"}, "series.csv has no such column");
  refused({"Motion/first/Velocity x=0", "Motion/all/Velocity x=t"}, "is in group");
  refused({"Motion/first/Velocity x=sin("}, "expected a formula");
  refused({"Physics/Rotations=false", "Motion/first/Spin x=1"}, "particles do not spin");
  refused({"Physics/Dimension=2", "Specimen/Thickness=0.01", "Motion/first/Velocity z=1"}, "in two dimensions");
  refused({"Groups/first/Members=layer", "Groups/first/Thickness=1"}, "there is a group of this name already");
  refused({"Material/Law=CPM", "Material/CPM/Normal modulus=1e9"}, "\n  \"Material/CPM/Shear ratio\" [-]: ");
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
  const ScratchFolder folder;
  goes_on_to_the_same_bits(folder,
                           {{"run", places::scene("bonded_beam.prm"), "-s", "Time/Step factor=0.1", "-s",
                             "Time/Damping in time=0.1 + 0.4 * sin(1e4 * t)^2", "-s", "Output/Checkpoint interval=0.01",
                             "-s", "Output/Samples=200"},
                            {"particles_links/particles_links_000002.vtp", "checkpoint.h5"},
                            reproducible_part},
                           {SIGINT, SIGKILL});
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

TEST_CASE("The force on a group is all that changes its momentum, and of its own links nothing counts",
          "[apps][particles]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  const Results found =
    results_of(folder, (folder / "x.prm").string(),
               {"Probes/push/Quantity=force", "Probes/push/Group=second", "Probes/push/Component=x",
                "Probes/nothing/Quantity=force", "Probes/nothing/Group=all", "Output/Samples=2000"});
  const auto  &time = found.series.column("time"), &push = found.series.column("push");
  const double mass    = 2500 * 4.0 / 3 * M_PI * 1e-6;
  double       impulse = 0;
  for (std::size_t row = 1; row < time.size(); ++row)
    impulse += push[row] * (time[row] - time[row - 1]);
  REQUIRE(found.figure("second", "end") > 0.4); // it has been hit
  CHECK(impulse == Approx(mass * found.figure("second", "end")).epsilon(0.01));
  CHECK(found.figure("nothing", "largest") == 0);
}

TEST_CASE("A run leaves its particles as they lie at the end, a packing that another scene begins with",
          "[apps][particles]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  const Results      found = results_of(folder, (folder / "x.prm").string());
  const dem::Packing left  = postprocess::read_packing(folder / "results/packing_at_end.h5");
  REQUIRE(left.size() == 2);
  CHECK(left.radius[1] == 0.01);
  CHECK((left.centre[1] - left.centre[0]).norm() == Approx(found.figure("gap", "end")).epsilon(1e-12));
  CHECK(found.figure("gap", "end") != Approx(0.021).epsilon(0.01)); // they have moved
}
