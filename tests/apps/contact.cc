// Scenes in which bodies of a solid touch each other, as the program runs, resumes and refuses them.
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <csignal>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** The same soft elastic stuff under these names. */
  std::string materials(const std::vector<std::string> &names)
  {
    std::string text = "subsection Materials\n";
    for (const std::string &name : names)
      text += "  subsection " + name + R"(
    set Law     = isotropic elastic
    set Density = 2400
    subsection isotropic elastic
      set Young modulus = 1e8
      set Poisson ratio = 0.2
    end
  end
)";
    return text + "end\n";
  }

  const std::string solid = R"(subsection Model
  set Dimension          = 3
  set Analysis           = explicit
  set Large displacement = true
end
subsection Mesh
  set Source = bodies
  subsection Boxes
    subsection base
      set Size        = 0.2, 0.2, 0.05
      set Divisions x = 4
      set Divisions y = 4
      set Material    = lower
    end
    subsection brick
      set Corner      = 0.06, 0.05, 0.0501
      set Size        = 0.08, 0.1, 0.06
      set Divisions x = 2
      set Divisions y = 2
      set Divisions z = 2
      set Material    = upper
    end
  end
end
)" + materials({"lower", "upper"}) +
                            R"(subsection Motion
  set Initial velocity x = z > 0.05005 ? 0.3 : 0
  set Initial velocity z = z > 0.05005 ? -1 : 0
end
subsection Contacts
  subsection joint
    set Stiffness            = 4e10
    set Friction coefficient = 0.4
  end
end
)";

  const std::string bodies = "set Kind = continuum\n" +
                             replaced(solid, "subsection Motion\n", "subsection Motion\n  set End time = 4e-3\n") +
                             R"(subsection Output
  set Samples   = 40
  set Snapshots = 4
end
)";

  /** The same, and a ball that falls on the brick, and a plane wall beside it that a second ball flies against. */
  std::string with_particles()
  {
    std::string part =
      "subsection Continuum\n" + replaced(solid, "  set Analysis           = explicit\n", "") + "end\n";
    return "set Kind = coupled\n" + part + R"(subsection Particles
  subsection Specimen
    set Source  = none
    set Density = 7800
  end
  subsection More particles
    subsection ball
      set Centre = 0.1, 0.1, 0.1255
      set Radius = 0.015
    end
    subsection other
      set Centre = 0.26, 0.1, 0.1
      set Radius = 0.01
    end
  end
  subsection Material
    set Law = linear
    subsection linear
      set Effective modulus = 1e8
    end
  end
  subsection Physics
    set Dimension = 3
  end
  subsection Walls
    subsection side
      set Shape  = plane
      set Point  = 0.28, 0, 0
      set Normal = -1, 0, 0
      set Effective modulus = 1e8
    end
  end
  subsection Initial velocity
    subsection ball
      set Velocity z = -3
    end
    subsection other
      set Velocity x = 8
    end
  end
end
subsection Couplings
  subsection top
    set Boundary          = brick front
    set Effective modulus = 1e8
  end
end
subsection Time
  set End time    = 4e-3
  set Damping     = 0
  set Step factor = 0.2
end
subsection Output
  set Samples   = 40
  set Snapshots = 2
end
)";
  }

  double largest_of(const std::vector<double> &values)
  {
    double largest = 0;
    for (const double value : values)
      largest = std::max(largest, std::fabs(value));
    return largest;
  }

  std::string reproducible_part(const std::filesystem::path &results)
  {
    return listing_of(results / "solid") + content_of(results / "series.csv");
  }
} // namespace

TEST_CASE("A brick that lands on a base reports forces, energies and momentum of the contact", "[apps][contact]")
{
  const ScratchFolder folder;
  folder.file("x.prm", bodies);
  const auto [summary, series] = results_of(folder, "x.prm");
  CHECK(std::filesystem::exists(folder / "results/bodies.png"));
  const double peak = summary["figures"]["peak_force"]["value"].get<double>();
  CHECK(peak > 100);
  CHECK(summary["figures"]["contact_time"]["value"].get<double>() > 1e-4);
  CHECK(summary["energy"]["balance_error"].get<double>() < 0.01);
  bool pressed = false, rubbed = false;
  for (std::size_t row = 0; row < series.columns[0].size(); ++row)
    {
      const double up = series.column("joint_upper_force_z")[row], down = series.column("joint_lower_force_z")[row];
      CHECK(up + down == Approx(0).margin(1e-11 * peak));
      pressed = pressed || up > 0;
      rubbed  = rubbed || series.column("joint_upper_force_x")[row] < 0;
      for (const char *axis : {"momentum_x", "momentum_y", "momentum_z"})
        CHECK(series.column(axis)[row] == Approx(series.column(axis).front()).margin(1e-12));
    }
  CHECK(pressed);
  CHECK(rubbed);
  CHECK(series.column("joint_dissipated").back() > 0);
}

TEST_CASE("Bodies, particles and walls touch in one scene, and one account holds them all", "[apps][contact][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", with_particles());
  const postprocess::CsvTable series = results_of(folder, "x.prm").series;
  const auto                  most   = [&](const char *column) { return largest_of(series.column(column)); };
  CHECK(most("joint_pairs") == 1);
  CHECK(most("top_force_z") > 10);
  CHECK(most("contacts") >= 1); // with the wall
  CHECK(most("energy_residual") < 0.01 * most("energy_solid_kinetic"));
  CHECK(most("joint_dissipated") > 0);
  // Until the other ball meets the wall nothing pushes from outside.
  CHECK(series.column("momentum_z")[1] == Approx(series.column("momentum_z").front()).epsilon(1e-12));
}

TEST_CASE("A rigid body rests between a deformable one, particles and walls like any other", "[apps][contact][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", with_particles());
  const postprocess::CsvTable series =
    results_of(folder, "x.prm", {"Continuum/Motion/Rigid bodies=upper", "Continuum/Motion/Safety=0.5"}).series;
  const auto most = [&](const char *column) { return largest_of(series.column(column)); };
  CHECK(most("joint_upper_force_z") > 100);
  CHECK(most("top_force_z") > 10);
  CHECK(most("energy_residual") < 0.01 * most("energy_solid_kinetic"));
  const Outcome stiff = outcome_of(folder, "check", "x.prm", {"Continuum/Motion/Rigid bodies=steel"});
  CHECK(stiff.status == 2);
  CHECK_THAT(stiff.err, Contains("the mesh has no material steel"));
}

TEST_CASE("A run with contact is the same to the last bit with any number of threads", "[apps][contact][slow]")
{
  const ScratchFolder folder;
  for (const std::string &scene : {bodies, with_particles()})
    {
      folder.file("x.prm", scene);
      std::string first;
      for (const char *threads : {"1", "2", "3"})
        {
          std::filesystem::remove_all(folder / "results");
          REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "results", "--threads", threads}).status == 0);
          const std::string now = reproducible_part(folder / "results");
          CHECK((first.empty() || now == first));
          first = now;
        }
    }
}

TEST_CASE("An interrupted or killed run with contact goes on to the same bits", "[apps][contact][slow][S13]")
{
  const ScratchFolder folder;
  folder.file("x.prm",
              replaced(bodies, "subsection Output\n", "subsection Output\n  set Checkpoint interval = 0.01\n"));
  goes_on_to_the_same_bits(
    folder,
    {{"run", "x.prm", "-s", "Motion/Safety=0.02"}, {"solid/solid_000002.vtu", "checkpoint.h5"}, reproducible_part},
    {SIGINT, SIGKILL});
}

TEST_CASE("A patch of contact smaller than the faces of elements is reported, with both areas", "[apps][contact][slow]")
{
  const ScratchFolder folder;
  const std::string   balls = "Mesh/Balls/";
  const auto          summary =
    results_of(folder, places::sources() + "/apps/scenes/colliding_balls.prm",
               {balls + "left/Divisions=2", balls + "right/Divisions=2", balls + "left/Centre=-0.010004, 0, 0",
                balls + "right/Centre=0.010004, 0, 0", "Contacts/balls/Stiffness=1.57e14", "Output/Snapshots=0"})
      .summary;
  INFO(summary.dump(1));
  const auto &peak = summary["figures"]["peak_force"];
  CHECK(peak["area_of_contact"].get<double>() < 4 * peak["face_of_element"].get<double>());
  REQUIRE(summary["warnings"].size() == 1);
  CHECK_THAT(summary["warnings"][0].get<std::string>(), Contains("where bodies touch at the largest force"));
}

TEST_CASE("Contacts that cannot be are refused by name", "[apps][contact]")
{
  const ScratchFolder folder;
  folder.file("x.prm", bodies);
  const auto refused = [&folder](const std::vector<std::string> &changes, const char *words) {
    is_refused(folder, "x.prm", changes, words);
  };
  refused({"Contacts/joint/Bodies=steel"},
          "Contacts/joint: contact of bodies: no body is of a material steel. There are: "
          "lower, upper");
  refused({"Contacts/joint/Bodies=upper"}, "there is only one body, and self-contact is off");
  refused({"Contacts/joint/Stiffness=0"}, "Contacts/joint/Stiffness");
  refused({"Mesh/Boxes/brick/Corner=0.06, 0.05, 0.04"}, "boxes base and brick overlap");
  refused({"Model/Analysis=static"}, "Contacts/joint: goes with Model/Analysis = explicit");
  folder.file("x.prm", replaced(bodies, "    set Stiffness            = 4e10\n", ""));
  refused({}, "Contacts/joint/Stiffness");
}

TEST_CASE("A contact that adds more energy than is allowed stops the run, with its place", "[apps][contact]")
{
  const ScratchFolder folder;
  folder.file("x.prm", bodies);
  const Outcome outcome =
    outcome_of(folder, "run", "x.prm", {"Contacts/joint/Form=penalty", "Contacts/joint/Energy limit=1e-9"});
  CHECK(outcome.status != 0);
  CHECK_THAT(outcome.err, Contains("Contacts/joint: at ") && Contains("the contact has made"));
}
