// Energy that couplings lose, gain and account for, through the program.
#include "tests/apps/coupled_scenes.h"
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <csignal>
#include <iomanip>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

TEST_CASE("A coupled run reports which side is sub-cycled, and the energy that this costs", "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  const Outcome checked = outcome_of(folder, "check", "x.prm", solid_sub_cycled);
  CHECK_THAT(checked.out, Contains("3 steps of the solid, 1 of the particles"));
  const Results found  = results_of(folder, "x.prm", solid_sub_cycled);
  const auto   &series = found.series;
  const double energy = series.column("energy_particles_initial").back(), made = series.column("block_spurious").back();
  CHECK(made < 0);
  CHECK(made > -0.12 * energy);
  CHECK(std::fabs(series.column("energy_residual").back() + made) < 1e-3 * energy); // nothing else is missing
  for (const char *axis : {"momentum_x", "momentum_y", "momentum_z"})
    CHECK(std::fabs(series.column(axis).back() - series.column(axis).front()) <
          1e-12 * std::fabs(series.column("momentum_z").front()));
}

TEST_CASE("A coupling that adds more energy than is allowed stops the run and is named", "[apps][coupled]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  const Outcome outcome = outcome_of(
    folder, "run", "x.prm", {"Time/Largest ratio=20", "Time/Step factor=0.01", "Couplings/block/Energy limit=1e-6"});
  CHECK(outcome.status != 0);
  CHECK_THAT(outcome.err,
             Contains("Couplings/block") && Contains("Energy limit") && Contains("Set Time/Largest ratio = "));
}

TEST_CASE("Energy that contacts really lose in dents is in the account of the coupling, which stops the run",
          "[apps][coupled][slow]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  const std::vector<std::string> in_dents = {"Continuum/Materials/solid/isotropic elastic/Young modulus=1e9",
                                             "Continuum/Mesh/Box/Divisions x=8",
                                             "Continuum/Mesh/Box/Divisions y=8",
                                             "Continuum/Mesh/Box/Divisions z=8",
                                             "Continuum/Motion/Safety=0.3",
                                             "Output/Samples=200",
                                             "Output/Snapshots=0"};
  const auto                     with     = [&in_dents](const std::vector<std::string> &more) {
    std::vector<std::string> all = in_dents;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  struct Found
  {
    double lacks    = 0,
           not_made = 0; ///< over the energy at the start: most that is not there, and of that what no contact made
  };
  const auto found_in = [&](const std::vector<std::string> &more) {
    const Results found    = results_of(folder, "x.prm", with(more));
    const auto   &residual = found.series.column("energy_residual"),
               &made       = found.series.column("block_spurious_of_contacts");
    const double start     = found.series.column("energy_particles_initial").front();
    Found        most;
    for (std::size_t i = 0; i < residual.size(); ++i)
      {
        most.lacks    = std::max(most.lacks, std::fabs(residual[i]) / start);
        most.not_made = std::max(most.not_made, std::fabs(residual[i] + made[i]) / start);
      }
    std::filesystem::remove_all(folder / "results");
    return most;
  };
  const Found points = found_in({"Couplings/block/Spreading=none", "Couplings/block/Energy limit=1"});
  CHECK(points.lacks > 0.02);
  CHECK(points.not_made < 5e-4);
  const Outcome stopped = outcome_of(folder, "run", "x.prm", with({"Couplings/block/Spreading=none"}));
  CHECK(stopped.status == 1);
  CHECK_THAT(stopped.err, Contains("Couplings/block") && Contains("more than Energy limit = 0.01") &&
                            Contains("set its Spreading = automatic"));
  std::filesystem::remove_all(folder / "results");
  CHECK(found_in({"Couplings/block/Spreading=automatic"}).lacks < 1e-4);
}

TEST_CASE("Glue that breaks while it is pressed leaves spurious energy, and the run stops", "[apps][coupled]")
{
  const ScratchFolder folder;
  std::string         scene = replaced(collision, "0.062, 0.1205", "0.062, 0.12");
  scene                     = replaced(scene, "    set Friction coefficient = 0.4\n",
                                       "    set Friction coefficient = 0.4\n    subsection Bond\n      set Within = 1e-6\n      set Law = "
                                                           "parallel-bond\n      subsection parallel-bond\n        set Effective modulus = 1e7\n        set "
                                                           "Tensile strength = 1e9\n        set Cohesion = 1e5\n      end\n    end\n");
  folder.file("x.prm", scene);
  const std::vector<std::string> pressed = {"Particles/Initial velocity/ball/Velocity x=3",
                                            "Particles/Initial velocity/ball/Velocity z=-1",
                                            "Particles/Initial velocity/ball/Spin y=0", "Time/Step factor=0.02"};
  const Outcome                  stopped = outcome_of(folder, "run", "x.prm", pressed);
  CHECK(stopped.status != 0);
  CHECK_THAT(stopped.err, Contains("Couplings/block: at ") && Contains("J more than has been put in") &&
                            Contains("Energy limit = 0.01") && Contains("bonds that break while they are pressed"));
  // Glue that holds makes nothing.
  std::filesystem::remove_all(folder / "results");
  std::vector<std::string> holds = pressed;
  holds.insert(holds.end(), {"Couplings/block/Bond/parallel-bond/Cohesion=1e12"});
  CHECK(outcome_of(folder, "run", "x.prm", holds).status == 0);
}

TEST_CASE("Sub-cycling is forecast, held to the energy that it may lose, and reported", "[apps][coupled][slow]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  // The ball approaches by 5 m/s, 0.26 kg.
  const double approach = 0.5 * 7800 * 4.0 / 3 * M_PI * 8e-6 * 25;
  for (const std::vector<std::string> &steps :
       {std::vector<std::string>{"Time/Largest ratio=16", "Time/Step factor=0.01"}, solid_sub_cycled})
    {
      std::vector<std::string> freely = steps;
      freely.insert(freely.end(), {"Time/Sub-cycling loss=1", "Couplings/block/Energy limit=1"});
      const Outcome checked = outcome_of(folder, "check", "x.prm", freely);
      const auto    at      = checked.out.find("would lose about ");
      INFO(checked.out);
      REQUIRE(at != std::string::npos);
      const double forecast = std::stod(checked.out.substr(at + std::string("would lose about ").size())),
                   lost     = -results_of(folder, "x.prm", freely).series.column("block_spurious").back() / approach;
      CHECK(forecast == Approx(lost).epsilon(0.7)); // part of the ball's way is along the face
      std::vector<std::string> held = steps;
      held.emplace_back("Time/Sub-cycling loss=0.004");
      const Results found  = results_of(folder, "x.prm", held);
      const double  energy = found.series.column("energy_particles_initial").back();
      CHECK(-found.series.column("block_spurious").back() < 0.004 * energy);
      const std::string warnings = found.summary["warnings"].dump();
      CHECK_THAT(warnings, Contains("Couplings/block has lost 0.00") && Contains("sub-cycling has lost 0.00") &&
                             Contains("Time/Sub-cycling loss = 0.004"));
    }
  // Where both take the same steps nothing is.
  CHECK(results_of(folder, "x.prm").summary["warnings"].dump().find("lost") == std::string::npos);
}

TEST_CASE("Checked windows keep a hard blow from losing what the last window could not foretell",
          "[apps][coupled][slow]")
{
  const ScratchFolder folder;
  folder.file("x.prm", collision);
  std::vector<std::string> hard = {"Time/Largest ratio=100", "Time/Step factor=0.003", "Time/Sub-cycling loss=1e-4",
                                   "Couplings/block/Energy limit=1", "Couplings/block/Effective modulus=1e9"};
  int                      taken_back = 0;
  const auto               lost       = [&] {
    const Results found = results_of(folder, "x.prm", hard);
    std::filesystem::remove_all(folder / "results");
    taken_back = found.summary["cost"]["windows_taken_back"];
    return -found.series.column("block_spurious").back() / found.series.column("energy_particles_initial").back();
  };
  const double blind = lost();
  CHECK(blind > 5e-4); // five times what is allowed
  CHECK(taken_back == 0);
  hard.emplace_back("Time/Checked windows=true");
  CHECK(std::fabs(lost()) < 2e-4); // single steps, which are not taken back, lose besides
  CHECK(taken_back > 0);
}
