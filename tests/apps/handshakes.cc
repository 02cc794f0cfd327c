// Particles inside a solid, through the program: the published example, refusals, resuming; waves from one into the other.
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** The beam with a core, its particles tied to small elements, and several of their steps in one of the solid. */
  const std::vector<std::string> tied = {"Handshakes/core/Method=multipliers",
                                         "Continuum/Mesh/Boxes/beam/Divisions x=50",
                                         "Continuum/Mesh/Boxes/beam/Divisions y=6",
                                         "Time/Largest ratio=4",
                                         "Time/Step factor=0.3",
                                         "Particles/Materials/concrete/CPM/Limit elastic strain=1 -",
                                         "Handshakes/core/Energy limit=1"};

  std::string reproducible(const std::filesystem::path &results)
  {
    return listing_of(results / "solid") + listing_of(results / "particles_particles") +
           content_of(results / "series.csv") + content_of(results / "coupled.pvd");
  }
} // namespace

TEST_CASE("A beam with a core of particles: the published example's particles, elements, momentum and energy",
          "[apps][coupled][volume][slow]")
{
  const ScratchFolder folder;
  const std::string   scene   = places::scene("beam_with_core.prm");
  const Outcome       checked = outcome_of(folder, "check", scene, {});
  CHECK_THAT(checked.out, Contains("elements     60") && Contains("concrete 364") && Contains("handshake    core: "));
  // Nothing breaks: nothing may be lost.
  const Results found  = results_of(folder, scene,
                                    {"Particles/Materials/concrete/CPM/Limit elastic strain=1 -", "Time/Damping=0",
                                     "Time/End time=1e-3", "Handshakes/core/Damage limit=0"});
  const auto   &series = found.series;
  CHECK(series.column("momentum_y").front() == Approx(-87.706).epsilon(1e-4));
  CHECK(series.column("energy_particles_initial").front() == Approx(2192.6).epsilon(1e-4));
  CHECK(series.column("core_damaged").back() == 0);
  const double energy = series.column("energy_particles_initial").back();
  for (const double residual : series.column("energy_residual"))
    CHECK(std::fabs(residual) < 0.01 * energy);
  CHECK(std::fabs(series.column("core_spurious").back()) < 1e-9 * energy);
}

TEST_CASE("A beam with a core of particles takes a blow as one all of particles does, until it is cut through",
          "[apps][coupled][volume][slow]")
{
  const auto blow = [](const char *scene) {
    const ScratchFolder folder;
    return results_of(folder, places::scene(scene), {"Time/End time=1e-3"}).series;
  };
  const auto core = blow("beam_with_core.prm"), all = blow("beam_of_particles.prm");
  const auto peak = [](const auto &series) {
    const auto &force = series.column("impact_force");
    return *std::max_element(force.begin(), force.end());
  };
  CHECK(peak(core) == Approx(peak(all)).epsilon(0.02));
  CHECK(core.column("impactor_velocity").back() == Approx(all.column("impactor_velocity").back()).epsilon(0.02));
}

TEST_CASE("bench volume goes on with the notched beam on request", "[apps][volume]")
{
  const ScratchFolder folder; // where there are none
  const Outcome       done = run(folder.path(), {"bench", "volume", places::scene("wave_transmission.prm"), "--quick",
                                                 "--beam", "-o", "bench", "-s", "Waves/Wavelengths=0.16"});
  CHECK(done.status == 2);
  CHECK_THAT(done.err, Contains("bending_of_particles.prm"));
  CHECK(std::filesystem::exists(folder / "bench/volume.csv"));
}

TEST_CASE("Constrained particles need an overlap no wider than bonds reach, however large the elements",
          "[apps][coupled][volume][slow]")
{
  const ScratchFolder folder;
  const Results       found =
    results_of(folder, places::scene("beam_with_core.prm"),
               {"Handshakes/core/Overlap=0.0136", "Particles/Materials/concrete/CPM/Limit elastic strain=1 -",
                "Time/Damping=0", "Time/End time=4e-4"}); // half an element is 20 mm
  const double energy = found.series.column("energy_particles_initial").back();
  CHECK(std::fabs(found.series.column("energy_residual").back()) < 0.01 * energy);
  CHECK(std::fabs(found.series.column("core_spurious").back()) < 1e-9 * energy);
  CHECK(found.series.column("core_work").back() > 0); // what goes on into the elements
}

TEST_CASE("What cannot shake hands is refused by name", "[apps][coupled][volume][slow]")
{
  const ScratchFolder folder;
  const std::string   scene   = places::scene("beam_with_core.prm");
  const auto          refused = [&](const std::vector<std::string> &changes, const char *words) {
    is_refused(folder, scene, changes, words);
  };
  refused({"Handshakes/core/High=-0.2, 1, 1"}, "High");
  refused({"Handshakes/core/High=0.11, 1, 1"}, "Let the region end where elements do");
  refused({"Handshakes/core/Method=multipliers", "Handshakes/core/Overlap=0"}, "Overlap");
  refused({"Handshakes/core/Low=-0.001, -1, -1", "Handshakes/core/High=0.001, 1, 1"}, "no element lies in");
  refused({"Handshakes/core/Low=-1, -1, -1", "Handshakes/core/High=1, 1, 1"}, "no element is left");
  refused({"Handshakes/core/Ties=loose"}, "Ties");
  refused({"Handshakes/core/Overlap=-1"}, "Overlap");
  const Outcome broken = outcome_of(folder, "run", scene, {"Handshakes/core/Damage limit=0.01"});
  CHECK(broken.status != 0);
  CHECK_THAT(broken.err, Contains("Handshakes/core") && Contains("larger region"));
}

TEST_CASE(
  "A packing with a gap across its region, or that ends before the mesh does, is refused with the place of the gap",
  "[apps][coupled][volume]")
{
  const ScratchFolder folder;
  const auto          without = [&folder](const double from, const double to) {
    std::istringstream all(content_of(places::sources() + "/meshes/hexagonal_beam.txt"));
    std::string        kept;
    for (std::string line; std::getline(all, line);)
      if (const double x = std::atof(line.c_str()); line.front() == '#' || x < from || x > to)
        kept += line + "\n";
    folder.file("beam.txt", kept);
    return "Particles/Specimen/File=" + (folder / "beam.txt").string();
  };
  const std::string scene = places::scene("beam_with_core.prm");
  is_refused(folder, scene, {without(0.005, 0.035), "Particles/Specimen/Loose pieces=keep"}, "across a gap of 0.036");
  is_refused(folder, scene, {without(0.4, 1), "Handshakes/core/Low=0.1, -1, -1", "Handshakes/core/High=1, 1, 1"},
             "between (0.42, 0, 0) and (0.5, 0.12, 0) m the region has taken the place of elements");
}

TEST_CASE("Two regions of particles in one beam work by every method, and overlapping ones are refused by name",
          "[apps][coupled][volume][slow]")
{
  const ScratchFolder folder;
  std::string         scene = content_of(places::scene("beam_with_core.prm"));
  const auto          put   = [&scene](const std::string &what, const std::string &by) {
    const auto at = scene.find(what);
    REQUIRE(at != std::string::npos);
    scene.replace(at, what.size(), by);
  };
  put("../../meshes/hexagonal_beam.txt", places::sources() + "/meshes/hexagonal_beam.txt");
  put("../../meshes/impactor.txt", places::sources() + "/meshes/impactor.txt");
  put("    set Low     = -0.1, -1, -1\n    set High    = 0.1, 1, 1\n",
      "    set Low     = -0.06, -1, -1\n    set High    = 0.1, 1, 1\n");
  put("subsection Handshakes\n",
      "subsection Handshakes\n  subsection left\n    set Low     = -0.34, -1, -1\n    set High    "
      "= -0.18, 1, 1\n    set Overlap = 0.0285\n    set Method  = constrained\n  end\n");
  folder.file("two.prm", scene);
  for (const char *method : {"multipliers", "constrained", "legacy"})
    {
      INFO(method);
      std::vector<std::string> changes = {"Particles/Materials/concrete/CPM/Limit elastic strain=1 -", "Time/Damping=0",
                                          "Time/End time=6e-4"};
      for (const char *name : {"left", "core"})
        changes.insert(changes.end(), {std::string("Handshakes/") + name + "/Method=" + method,
                                       std::string("Handshakes/") + name + "/Damage limit=1"});
      if (std::string(method) == "multipliers")
        changes.insert(changes.end(), {"Handshakes/left/Absorber=false", "Handshakes/core/Absorber=false"});
      const Results found  = results_of(folder, (folder / "two.prm").string(), changes);
      const double  energy = found.series.column("energy_particles_initial").back();
      CHECK(std::fabs(found.series.column("energy_residual").back()) < 0.01 * energy);
      CHECK(std::fabs(found.series.column("left_work").back()) > 0);
      std::filesystem::remove_all(folder / "results");
    }
  is_refused(folder, (folder / "two.prm").string(), {"Handshakes/left/High=-0.06, 1, 1"}, "Handshakes/core as well");
}

namespace
{
  /** A free bar of discs that goes over into one of elements, with a pulse in the discs: its discs into a file. */
  std::string bar_with_a_pulse(const ScratchFolder &folder)
  {
    std::ostringstream discs;
    discs << "x y z radius\n";
    for (int i = 0; i < 16; ++i)
      for (int j = 0; j < 4; ++j)
        discs << 0.01 * (i + 0.5) << ' ' << 0.01 * (j + 0.5) << " 0 0.005\n";
    folder.file("discs.txt", discs.str());
    const std::string pulse = "0.1*exp(-((x-0.05)/0.02)^2)";
    return "set Kind = coupled\n"
           "subsection Continuum\n  subsection Model\n    set Dimension = 2\n    set Thickness = 0.01\n"
           "    set Large displacement = true\n  end\n"
           "  subsection Mesh\n    set Source = bodies\n    subsection Boxes\n      subsection bar\n"
           "        set Size = 0.26, 0.04, 0\n        set Divisions x = 13\n        set Divisions y = 2\n"
           "        set Material = solid\n      end\n    end\n  end\n"
           "  subsection Materials\n    subsection solid\n      set Law = isotropic elastic\n      set Density = 2400\n"
           "      subsection isotropic elastic\n        set Young modulus = 25e9\n        set Poisson ratio = 0.2\n"
           "      end\n    end\n  end\n"
           "  subsection Motion\n    set Initial velocity x = " +
           pulse +
           "\n  end\nend\n"
           "subsection Particles\n  subsection Physics\n    set Dimension = 2\n    set Contacts = false\n"
           "    set Friction = false\n    set Damage = false\n  end\n"
           "  subsection Specimen\n    set Source = file\n    set File = discs.txt\n    set Density = 2400\n"
           "    set Thickness = 0.01\n    set Interaction ratio = 1.5\n  end\n"
           "  subsection Material\n    set Law = CPM\n    subsection CPM\n      set Normal modulus = 25e9\n"
           "      set Shear ratio = 0.3\n      set Limit elastic strain = 1 -\n      set Relative ductility = 100\n"
           "      set Cohesion = 1e12\n      set Friction coefficient = 0\n    end\n  end\n"
           "  subsection Initial velocity\n    subsection all\n      set Velocity x = " +
           pulse +
           "\n    end\n  end\nend\n"
           "subsection Handshakes\n  subsection core\n    set Low = -1, -1, -1\n    set High = 0.1, 1, 1\n"
           "    set Overlap = 0.06\n    set Absorber = false\n  end\nend\n"
           "subsection Time\n  set End time = 4e-4\n  set Step factor = 0.2\n  set Damping = 0\nend\n"
           "subsection Output\n  set Samples = 25\n  set Snapshots = 0\nend\n";
  }
} // namespace

TEST_CASE("A handshake that gains or loses more energy than is allowed stops the run, with advice",
          "[apps][coupled][volume][slow]")
{
  const ScratchFolder folder;
  folder.file("x.prm", bar_with_a_pulse(folder));
  const auto stops = [&](const std::vector<std::string> &changes, const char *what, const char *remedy) {
    std::filesystem::remove_all(folder / "results");
    const Outcome outcome = outcome_of(folder, "run", "x.prm", changes);
    INFO(outcome.err);
    CHECK(outcome.status != 0);
    CHECK_THAT(outcome.err, Contains("Handshakes/core: at ") && Contains(what) &&
                              Contains("Energy limit = 0.01 of the largest energy") && Contains(remedy));
  };
  const std::vector<std::string> several = {"Time/Largest ratio=4", "Time/Sub-cycling loss=1"};
  std::vector<std::string>       driven  = several;
  driven.insert(driven.begin(), "Handshakes/core/Method=constrained");
  stops(driven, "has made", "Set Time/Largest ratio = ");
  stops(several, "has lost", "Set Time/Largest ratio = ");
  stops({"Handshakes/core/Ties=lumped"}, "has lost", "Take Ties = coarse or strict");
  std::filesystem::remove_all(folder / "results");
  // Held to what it may lose, and with both in step, every run goes through.
  for (const std::vector<std::string> &changes :
       {std::vector<std::string>{"Time/Largest ratio=4", "Time/Sub-cycling loss=0.002"},
        {"Handshakes/core/Method=constrained", "Time/Largest ratio=4", "Time/Sub-cycling loss=0.002"},
        {"Handshakes/core/Method=constrained"},
        {}})
    {
      const Results found = results_of(folder, "x.prm", changes);
      const double  energy =
        found.series.column("energy_particles_initial").back() + found.series.column("energy_solid_start").back();
      for (const double residual : found.series.column("energy_residual"))
        CHECK(std::fabs(residual) < 0.004 * energy);
      std::filesystem::remove_all(folder / "results");
    }
}

TEST_CASE("An interrupted or killed run of particles inside a solid goes on to the same bits",
          "[apps][coupled][volume][slow][S13]")
{
  const ScratchFolder      folder;
  std::vector<std::string> words = {"run", places::scene("beam_with_core.prm"), "-s",
                                    "Output/Checkpoint interval=0.01"};
  for (const std::string &change : tied)
    words.insert(words.end(), {"-s", change});
  goes_on_to_the_same_bits(folder, {words, {"solid/solid_000002.vtu", "checkpoint.h5"}, reproducible},
                           {SIGINT, SIGKILL});
}

TEST_CASE("Particles inside a solid move to the same bits with any number of threads, whatever ties them",
          "[apps][coupled][volume][slow]")
{
  const ScratchFolder folder;
  std::string         first;
  for (const char *threads : {"1", "2"})
    {
      std::vector<std::string> words = {
        "run", places::scene("beam_with_core.prm"), "-o", "results", "--threads", threads, "-s", "Time/End time=5e-4"};
      for (const std::string &change : tied)
        words.insert(words.end(), {"-s", change});
      REQUIRE(run(folder.path(), words).status == 0);
      const std::string now = reproducible(folder / "results");
      CHECK((first.empty() || now == first));
      first = now;
    }
}

TEST_CASE("A scene of waves writes where their energy goes, and refuses waves that particles cannot carry",
          "[apps][volume]")
{
  const ScratchFolder folder;
  const std::string   scene = places::scene("wave_transmission.prm");
  is_refused(folder, scene, {"Waves/Wavelengths=0.03"}, "4 to 10000 spacings");
  is_refused(folder, scene, {"Waves/Methods=magic"}, "absorber p=2");
  is_refused(folder, scene, {"Waves/Shear=true"}, "Medium = strip");
  is_refused(folder, scene, {"Waves/Scatter=1"}, "Scatter");
  is_refused(folder, scene, {"Waves/Medium=bar", "Waves/Scatter=0.3"}, "Medium = chain, strip or plane");
  const Outcome done = outcome_of(folder, "run", scene, {"Waves/Wavelengths=0.16", "Waves/Methods=absorber"});
  CHECK(done.status == 0);
  CHECK_THAT(done.out, Contains("absorber") && Contains("reflection.csv"));
}

TEST_CASE("bench volume has every method, at each wavelength, with what a step costs", "[apps][volume][slow]")
{
  const ScratchFolder folder;
  const Outcome       done =
    run(folder.path(), {"bench", "volume", places::scene("wave_transmission.prm"), "--quick", "-o", "bench"});
  REQUIRE(done.status == 0);
  const std::string csv = content_of(folder / "bench/volume.csv");
  for (const char *method : {"absorber", "absorber p=2", "coarse", "strict", "lumped", "constrained", "legacy"})
    CHECK_THAT(csv, Contains(std::string("\n") + method + ",0.08,"));
  CHECK(std::filesystem::file_size(folder / "bench/volume.png") > 0);
}

TEST_CASE(
  "The reflection of a mismatch of media is reported where other materials are named beside that of the packing too",
  "[apps][coupled][volume]")
{
  const ScratchFolder folder;
  const Outcome       large = outcome_of(folder, "check", places::scene("plate_impact.prm"),
                                         {"Particles/Specimen/Generator/Particle radius=0.005"});
  CHECK(large.status == 0);
  CHECK_THAT(large.out + large.err, Contains("impedances reflect"));
}
