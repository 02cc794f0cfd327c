// Scenes of kind "coupled", through the program: one account of both sides, weight, resuming, refusals.
#include "tests/apps/coupled_scenes.h"
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <iomanip>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

TEST_CASE("A ball and a free block keep momentum, angular momentum and energy, and the account shows it",
          "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  const Results found = results_of(folder, "x.prm");
  REQUIRE(found.summary["figures"]["peak_force"]["value"].get<double>() > 1000);
  CHECK(found.series.column("block_contacts").back() == 0); // it has left again
  for (const std::string quantity : {"momentum", "angular_momentum"})
    {
      double size = 0;
      for (const char *axis : {"_x", "_y", "_z"})
        size = std::max(size, std::fabs(found.series.column(quantity + axis).front()));
      for (const char *axis : {"_x", "_y", "_z"})
        for (const double value : found.series.column(quantity + axis))
          // What spins about a tilting axis is kept to the order of the step only, hence more for the second.
          CHECK(std::fabs(value - found.series.column(quantity + axis).front()) <
                (quantity == "momentum" ? 1e-11 : 1e-5) * size);
    }
  CHECK(found.summary["energy"]["balance_error"].get<double>() < 5e-5);
  // What spread contacts make of changing weights is measured to the square of the step.
  for (const char *maker : {"spurious_of_couplings", "spurious_of_contacts"})
    CHECK(std::fabs(found.summary["energy"][maker]["block"].get<double>()) <
          1e-6 * found.summary["energy"]["particles_initial"].get<double>());
  const std::string together = content_of(folder / "results/coupled.pvd");
  CHECK_THAT(together, Contains("solid/solid_000004.vtu") &&
                         Contains("particles_particles/particles_particles_000004.vtp") &&
                         Contains("particles_walls/particles_walls_000004.vtp"));
}

TEST_CASE("Balls at rest weigh on a slab what they weigh, and the slab's supports carry both", "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", two_balls_on_a_held_block("0.1199", 200) + gravity("-9.81"));
  const Results found = results_of(folder, "x.prm",
                                   {"Time/End time=1.5", "Time/Damping=0.7", "Time/Step factor=0.3",
                                    "Couplings/block/Effective modulus=1e6",
                                    "Continuum/Materials/solid/isotropic elastic/Young modulus=200e6"});
  const double  balls = 2 * 7800 * 4.0 / 3 * M_PI * 8e-6 * 9.81, block = 2400 * 1e-3 * 9.81;
  CHECK(found.series.column("block_force_z").back() == Approx(-balls).epsilon(1e-6));
  CHECK(found.series.column("reaction_back_z").back() == Approx(balls + block).epsilon(1e-6));
  CHECK(found.summary["energy"]["balance_error"].get<double>() < 1e-3);
}

TEST_CASE("The terminal says of every reaction where it is at the end, and from where to where it has been",
          "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", two_balls_on_a_held_block("0.1199", 200) + gravity("-9.81"));
  const std::vector<std::string> brief   = {"Time/End time=1e-3", "Output/Samples=20"};
  const Outcome                  outcome = outcome_of(folder, "run", "x.prm", brief);
  REQUIRE(outcome.status == 0);
  INFO(outcome.out << outcome.err);
  const auto series = postprocess::read_csv_table(folder / "results/series.csv");
  for (const char *name : {"reaction_back_x", "reaction_back_z"})
    {
      const auto &values          = series.column(name);
      const auto [least, largest] = std::minmax_element(values.begin(), values.end());
      CHECK_THAT(outcome.out, Contains(fmt::format("{:<40} {:.6g} N at the end, from {:.6g} to {:.6g} in all\n", name,
                                                   values.back(), *least, *largest)));
    }
}

TEST_CASE("A solid that can be damaged leaves a picture of its damage, an elastic one none", "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("elastic.prm", two_balls_on_a_held_block("0.1199", 200));
  folder.file("concrete.prm",
              replaced(two_balls_on_a_held_block("0.1199", 200), "set Law     = isotropic elastic",
                       "set Law     = damage-plastic concrete\n      subsection damage-plastic concrete\n        set "
                       "Young modulus = 30e9\n        set Poisson ratio = 0.2\n        set Compressive strength = "
                       "30e6\n        set Tensile strength = 3e6\n        set Fracture energy = 100\n      end"));
  for (const char *scene : {"elastic", "concrete"})
    {
      const Outcome outcome =
        run(folder.path(), {"run", scene + std::string(".prm"), "-o", scene, "-s", "Time/End time=1e-4"});
      INFO(outcome.err);
      REQUIRE(outcome.status == 0);
    }
  CHECK_FALSE(std::filesystem::exists(folder / "elastic/damage.png"));
  CHECK(std::filesystem::file_size(folder / "concrete/damage.png") > 1000);
}

namespace
{
  /** 216 grains of 11 to 14.5 mm, apart from each other, above the slab of gravel_on_slab.prm. @return the sum of their radii cubed [m^3] */
  double pour(std::ostream &packing)
  {
    const double cell  = 0.2 / 6;
    double       cubes = 0, place = 0.61; // of some starts, one after which no grain is left that rolls for seconds
    const auto   next = [&place] { return place = std::fmod(place + 0.6180339887498949, 1.0); };
    for (int k = 0; k < 6; ++k)
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
          {
            const double r = 0.011 + 0.0035 * next(), play = cell / 2 - r;
            packing << (i + 0.5) * cell + play * (2 * next() - 1) << ' ' << (j + 0.5) * cell + play * (2 * next() - 1)
                    << ' ' << 0.032 + (k + 0.5) * cell + play * (2 * next() - 1) << ' ' << r << '\n';
            cubes += r * r * r;
          }
    return cubes;
  }
} // namespace

TEST_CASE("Poured gravel that has come to rest weighs on slab and bin what it weighs", "[apps][coupled][slow]")
{
  const ScratchFolder folder;
  std::ostringstream  grains;
  grains << std::setprecision(12);
  const double weight = pour(grains) * 2600 * 4.0 / 3 * M_PI * 9.81;
  folder.file("grains.txt", grains.str());
  const Results found = results_of(
    folder, places::sources() + "/apps/scenes/gravel_on_slab.prm",
    {"Particles/Specimen/File=" + (folder.path() / "grains.txt").string(), "Continuum/Mesh/Box/Divisions x=8",
     "Continuum/Mesh/Box/Divisions y=8", "Continuum/Mesh/Box/Divisions z=2", "Time/End time=3.2",
     "Time/Damping in time=t < 0.8 ? 0.2 : 0.5", "Output/Samples=32", "Output/Snapshots=0"});
  const double on_slab = found.series.column("slab_force_z").back(), on_bin = found.series.column("bin").back();
  REQUIRE(found.series.column("energy_particles_kinetic").back() < 1e-9);
  CHECK(on_slab < -0.9 * weight);
  CHECK(on_slab + on_bin == Approx(-weight).epsilon(1e-6));
  CHECK(found.summary["energy"]["balance_error"].get<double>() < 2e-3);
}

TEST_CASE("Couplings act between named boundaries and named groups, each with its own contact", "[apps][coupled][slow]")
{
  // Two balls that glide over the same face: one over a smooth coupling, one over a rough one that makes it roll.
  const ScratchFolder folder;
  std::string         scene = replaced(collision, "      set Velocity y = -1\n      set Velocity z = -5\n", "");
  scene                     = replaced(scene, "      set Spin y     = 100\n", "");
  scene = replaced(scene, "      set Centre = 0.03, 0.062, 0.1205\n      set Radius = 0.02\n    end\n",
                   "      set Centre = 0.02, 0.03, 0.109999\n      set Radius = 0.01\n    end\n"
                   "    subsection other\n      set Centre = 0.02, 0.07, 0.109999\n      set Radius = 0.01\n    end\n");
  scene = replaced(scene, "      set Velocity x = 2\n    end\n",
                   "      set Velocity x = 0.5\n    end\n    subsection other\n      set Velocity x = 0.5\n    end\n");
  scene = replaced(scene, "  subsection block\n",
                   "  subsection smooth\n    set Boundary = front\n    set Groups = Ball\n    set Effective modulus = "
                   "1e8\n  end\n  subsection block\n    set Boundary = front\n    set Groups = other\n");
  scene = replaced(scene, "subsection Couplings\n",
                   "subsection Gravity\n  set Acceleration = 0, 0, -100\nend\nsubsection Couplings\n");
  scene = replaced(scene, "  subsection Initial velocity\n",
                   "  subsection Probes\n    subsection slides\n      set Quantity = velocity\n      set Group = ball\n"
                   "    end\n    subsection rolls\n      set Quantity = velocity\n      set Group = other\n    end\n"
                   "  end\n  subsection Initial velocity\n");
  scene = replaced(scene, "  subsection Materials\n",
                   "  subsection Boundary conditions\n    subsection back\n      set Displacement x = 0\n      set "
                   "Displacement y = 0\n      set Displacement z = 0\n    end\n  end\n  subsection Materials\n");
  folder.file("x.prm", scene);
  const Results found = results_of(folder, "x.prm", {"Time/End time=0.04"});
  CHECK(found.series.column("slides").back() == Approx(0.5).epsilon(1e-3));
  CHECK(found.series.column("rolls").back() == Approx(0.5 * 5 / 7).epsilon(1e-2));
  CHECK(found.series.column("smooth_contacts").back() == 1);
  CHECK(found.series.column("block_contacts").back() == 1);
  const auto refused = [&](const std::string &change, const char *words) {
    const Outcome outcome = outcome_of(folder, "check", "x.prm", {change});
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(words));
  };
  refused("Couplings/smooth/Groups=ball, sand", "Groups: all, ball, other");
  refused("Couplings/smooth/Groups=", "Couplings/smooth and Couplings/block: both are of particle 2");
  CHECK(outcome_of(folder, "check", "x.prm", {"Couplings/smooth/Groups=", "Couplings/smooth/Boundary=left"}).status ==
        0);
}

TEST_CASE("What is glued to a face hangs from it until the strength of the glue, and both sides account for it",
          "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", hanging());
  const std::vector<std::string> slow  = {"Time/End time=0.1", "Time/Damping=0.7", "Time/Step factor=0.3"};
  const Results                  found = results_of(folder, "x.prm", slow);
  const double                   balls = 2 * 7800 * 4.0 / 3 * M_PI * 8e-6 * 9.81, block = 2400 * 1e-3 * 9.81;
  CHECK(found.series.column("block_glued").back() == 2);
  CHECK(found.series.column("block_torn").back() == 0);
  CHECK(found.series.column("block_force_z").back() == Approx(balls).epsilon(1e-6));
  CHECK(found.series.column("reaction_back_z").back() == Approx(-balls - block).epsilon(1e-5));
  CHECK(found.summary["energy"]["balance_error"].get<double>() < 1e-3);
  CHECK(std::fabs(found.summary["energy"]["spurious_of_couplings"]["block"].get<double>()) <
        1e-12 * std::fabs(found.series.column("energy_particles_gravity").back()));
  // Glue of less than the weight over the section: pi r^2 = 1.26e-3 m^2.
  std::vector<std::string> weak = slow;
  weak.push_back("Couplings/block/Bond/parallel-bond/Tensile strength=" + std::to_string(0.4 * balls / 1.2566e-3));
  const Results torn = results_of(folder, "x.prm", weak);
  CHECK(torn.series.column("block_glued").back() == 0);
  CHECK(torn.series.column("block_torn").back() == 2);
  CHECK(found.series.column("broken_links").back() == 0);
  CHECK(torn.series.column("broken_links").back() == 2); // there is no other bond
  CHECK(torn.summary["figures"]["torn_off"]["block"] == 2);
  CHECK(torn.summary["figures"]["broken_links"] == 2);
  CHECK(torn.series.column("block_force_z").back() == 0);
  const std::string log = content_of(folder.path() / "results/breaks.csv");
  INFO(log);
  CHECK_THAT(log, Contains("\ntension,0,block,"));
  const auto breaks =
    postprocess::read_csv_table(folder.path() / "results/breaks.csv", false, {"mode", "pair", "surface"});
  REQUIRE(breaks.rows() == 2);
  for (std::size_t b = 0; b < 2; ++b)
    {
      CHECK(breaks.column("second")[b] == -1);
      CHECK(std::fabs(breaks.column("normal_z")[b]) == Approx(1).epsilon(1e-6)); // they hang from it
      CHECK(breaks.column("z")[b] == Approx(0.1).epsilon(1e-3));
      CHECK(breaks.column("area")[b] == Approx(1.2566e-3).epsilon(1e-3));
    }
  const auto refused = [&](const std::string &change, const char *words) {
    const Outcome outcome = outcome_of(folder, "check", "x.prm", {change});
    INFO(outcome.err);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(words));
  };
  refused("Particles/More particles/ball/Centre=0.03, 0.062, 0.1", "lies in it");
  refused("Couplings/block/Bond/Law=own", "carry no tension");
  refused("Couplings/block/Bond/Within=-1", "Within");
  const Outcome nobody = outcome_of(
    folder, "check", "x.prm",
    {"Particles/More particles/ball/Centre=0.03, 0.062, 0.2", "Particles/More particles/other/Centre=0.07, 0.02, 0.2"});
  CHECK(nobody.status == 2);
  CHECK_THAT(nobody.err, Contains("block: no particle is within 1e-06 m"));
}

TEST_CASE("A coupled run is the same to the last bit with any number of threads", "[apps][coupled][slow]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  for (const std::vector<std::string> &changes : {std::vector<std::string>(), solid_sub_cycled})
    {
      std::string first;
      for (const char *threads : {"1", "2"})
        {
          std::vector<std::string> words = {"run", "x.prm", "-o", "results", "--threads", threads};
          for (const std::string &change : changes)
            words.insert(words.end(), {"-s", change});
          REQUIRE(run(folder.path(), words).status == 0);
          const std::string now = reproducible_part(folder / "results");
          CHECK((first.empty() || now == first));
          first = now;
        }
    }
}

TEST_CASE("An interrupted or killed coupled run goes on to the same bits, in flight and in contact",
          "[apps][coupled][slow][S13]")
{
  const ScratchFolder folder;
  const auto          often = [](const std::string &scene) {
    return replaced(scene, "subsection Output\n", "subsection Output\n  set Checkpoint interval = 0.01\n");
  };
  const std::vector<std::string> awaited = {"solid/solid_000002.vtu", "checkpoint.h5"};
  folder.file("x.prm", often(collision));
  goes_on_to_the_same_bits(folder, {{"run", "x.prm", "-s", "Time/Step factor=0.01"}, awaited, reproducible_part},
                           {SIGINT, SIGKILL});
  folder.file("x.prm",
              often(two_balls_on_a_held_block("0.1199", 200) + gravity("-9.81"))); // pushing when it is stopped
  std::filesystem::remove_all(folder / "whole");
  goes_on_to_the_same_bits(
    folder, {{"run", "x.prm", "-s", "Time/End time=0.02", "-s", "Time/Step factor=0.1"}, awaited, reproducible_part},
    {SIGINT, SIGKILL});
  for (const std::string &scene : {two_balls_on_a_held_block("0.1199", 200) + gravity("-9.81"), hanging()})
    {
      folder.file("x.prm", often(scene)); // the block sub-cycled, and glued balls
      std::filesystem::remove_all(folder / "whole");
      goes_on_to_the_same_bits(folder,
                               {{"run", "x.prm", "-s", "Time/End time=0.02", "-s", "Time/Step factor=0.4", "-s",
                                 "Time/Largest ratio=5", "-s", "Couplings/block/Energy limit=1"},
                                awaited,
                                reproducible_part},
                               {SIGINT, SIGKILL});
    }
  folder.file("x.prm", often(hanging()));
  std::filesystem::remove_all(folder / "whole");
  goes_on_to_the_same_bits(
    folder, {{"run", "x.prm", "-s", "Time/End time=0.05", "-s", "Time/Step factor=0.05"}, awaited, reproducible_part},
    {SIGINT, SIGKILL});
}

TEST_CASE("What cannot be coupled is refused by name", "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  const auto refused = [&folder](const std::vector<std::string> &changes, const char *words) {
    is_refused(folder, "x.prm", changes, words);
  };
  refused({"Couplings/block/Boundary=lid"}, "Couplings/block/Boundary = lid: the mesh has no boundary");
  refused({"Couplings/block/Bond/Within=1e-3"}, "Couplings/block/Bond/Law");
  refused({"Time/Damping in time=0.1*x"}, "a formula of t alone");
  refused({"Time/Damping in time=1 - t"}, "damping lies in [0, 1)");
  refused({"Continuum/Model/Analysis=static"}, "Analysis");
  refused({"Particles/Physics/Dimension=2", "Particles/Specimen/Thickness=1"}, "Dimension");
  refused({"Particles/More particles/ball/Centre=0.03, 0.062, 0.105"}, "block: particle 1");
  refused({"Output/Curve vertical=nonsense"}, "nonsense");
  refused({"Couplings/block/Energy limit=0"}, "Energy limit");
  folder.file("x.prm", collision.substr(0, collision.find("subsection Couplings")) +
                         collision.substr(collision.find("subsection Time")));
  refused({}, "Couplings: there is none");
}

TEST_CASE("A ball that was thrown past everything is reported, and one that has hit is not", "[apps][coupled]")
{
  const ScratchFolder folder;
  const std::string   stray =
    "  subsection Initial velocity\n    subsection stray\n      set Velocity x = -3\n      set Velocity z = "
    "4\n    end\n";
  std::string scene = replaced(collision, "  subsection Initial velocity\n", stray);
  scene             = replaced(scene, "  subsection More particles\n",
                               "  subsection More particles\n    subsection stray\n      set Centre = 0.03, 0.062, 0.3\n"
                                           "      set Radius = 0.02\n    end\n");
  folder.file("x.prm", scene);
  for (const std::string weight : {"0, 0, 0", "0, 0, -9.81"})
    {
      const std::string warnings =
        results_of(folder, "x.prm", {"Gravity/Acceleration=" + weight}).summary["warnings"].dump();
      CHECK_THAT(warnings, Contains("Initial velocity/stray: it moves at the end as it was thrown"));
      CHECK_THAT(warnings, !Contains("Initial velocity/ball"));
    }
}

TEST_CASE("An interface that is never touched is reported", "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  const Outcome outcome = outcome_of(folder, "run", "x.prm", {"Particles/More particles/ball/Centre=0.03, 0.062, 0.3"});
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("nothing has ever touched the solid"));
  CHECK_THAT(content_of(folder / "results/summary.json"), Contains("nothing has ever touched the solid"));
}

TEST_CASE("A test in the press is refused where its couplings, points or axis are not there, by name",
          "[apps][coupled]")
{
  const ScratchFolder folder;
  const auto          refusal = [&](const std::string &change) {
    const Outcome outcome =
      run(folder.path(), {"check", places::sources() + "/apps/scenes/crushed_cube.prm", "-s", change});
    CHECK(outcome.status == 2);
    return outcome.err;
  };
  CHECK_THAT(refusal("Laboratory/Low coupling=lwer"),
             Contains("Low coupling = lwer") && Contains("Did you mean \"lower\""));
  CHECK_THAT(refusal("Laboratory/High coupling=lower"), Contains("Give each end a coupling of its own"));
  CHECK_THAT(refusal("Laboratory/High point=middle"), Contains("there is no such section in Continuum/Points"));
  CHECK_THAT(refusal("Laboratory/Area=0"), Contains("Area = 0"));
}
