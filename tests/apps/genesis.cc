// Particles grown by a scene, through the program: what it leaves, resuming, aggregates, refusals.
#include "postprocess/packings/packing_io.h"
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/environment.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** A window of mortar of two sizes, bonded by flat joints and left alone for some steps. */
  const std::string mortar_scene = R"(set Kind = particles
subsection Physics
  set Dimension       = 2
  set Largest overlap = 1
end
subsection Specimen
  set Source           = genesis
  set Density          = 1624
  set Thickness        = 1
  set Installation gap = 2e-4
  set Loose pieces     = keep
  subsection Genesis
    set Size              = 0.02, 0.03, 0
    set Classes           = 1e-3: 0.5, 3.2e-3: 0.5
    set Effective modulus = 8e9
    set Stress            = 27500
    set Increments        = 20
    set Stress rounds     = 3
    set Floater rounds    = 2
    set Solve steps       = 2000
  end
end
subsection Material
  set Law = flat-joint
  subsection flat-joint
    set Effective modulus    = 10.38e9
    set Tensile strength     = 0.29e6
    set Cohesion             = 1.98e6
    set Friction angle       = 20.7
    set Friction coefficient = 0.21
  end
end
subsection Gravity
  set Initial equilibrium = none
end
subsection Time
  set End time = 2e-5
  set Damping  = 0.7
end
subsection Output
  set Samples   = 4
  set Snapshots = 0
end
)";

  /** The shipped concrete: mortar of uniform radii, aggregates in it, links of three kinds. */
  const std::string concrete = places::sources() + "/apps/scenes/concrete_aggregates.prm";

  /** A small piece of it, grown in a hurry and left alone. */
  std::vector<std::string> small_piece(const std::vector<std::string> &more = {})
  {
    const std::string        of      = "Specimen/Genesis/";
    std::vector<std::string> changes = {of + "Size=0.04, 0.03, 0", of + "Increments=20",
                                        of + "Stress rounds=3",    of + "Fit floaters=false",
                                        of + "Solve steps=2000",   of + "Aggregates/Sizes=5e-3, 7e-3, 9e-3",
                                        "Laboratory/Test=none",    "Time/End time=1e-5",
                                        "Output/Samples=2",        "Output/Snapshots=0"};
    changes.insert(changes.end(), more.begin(), more.end());
    return changes;
  }
} // namespace

TEST_CASE("A scene grows its particles, bonds them without a force, and keeps what each stage has reached",
          "[apps][genesis]")
{
  const ScratchFolder folder;
  folder.file("mortar.prm", mortar_scene);
  const Results found = results_of(folder, "mortar.prm");
  CHECK(found.summary["cost"]["particles"] == 344 + 34);
  CHECK(found.series.column("broken_links").back() == 0);
  CHECK(found.series.column("energy_kinetic").back() < 1e-20);
  const auto genesis = nlohmann::json::parse(content_of(folder / "results/genesis.json"));
  CHECK(genesis["stages"].size() == 4);
  CHECK(genesis["stages"][0]["stage"] == "growth");
  CHECK(genesis["bonds"]["count"] == found.summary["cost"]["links"]);
  const double growth = genesis["energy_J"]["growth"], error = genesis["energy_J"]["error"];
  CHECK(std::abs(error) < 0.01 * growth);
  CHECK_THAT(content_of(folder / "results/genesis.csv"), Contains("floaters,"));
}

TEST_CASE("The packing of a genesis is what a scene reads, to the same links", "[apps][genesis]")
{
  const ScratchFolder folder;
  folder.file("mortar.prm", mortar_scene);
  const Results found = results_of(folder, "mortar.prm");
  std::filesystem::copy(folder / "results/packing.txt", folder / "packing.txt");
  std::filesystem::remove_all(folder / "results");
  const Results again = results_of(folder, "mortar.prm", {"Specimen/Source=file", "Specimen/File=packing.txt"});
  CHECK(again.summary["cost"]["links"] == found.summary["cost"]["links"]);
  CHECK(again.series.columns == found.series.columns);
}

TEST_CASE("Platens stand where the vessel's walls stood, without a force", "[apps][genesis]")
{
  const ScratchFolder            folder;
  const std::vector<std::string> press = {"Specimen/Genesis/Stress=0",
                                          "Laboratory/Test=uniaxial compression",
                                          "Laboratory/Axis=y",
                                          "Laboratory/Effective modulus=8e9",
                                          "Laboratory/Speed=0.02",
                                          "Laboratory/Largest strain=1e-3",
                                          "Laboratory/Platens=vessel walls"};
  folder.file("mortar.prm", mortar_scene);
  const Results found = results_of(folder, "mortar.prm", press);
  // Of what lies at the walls a dozen discs at each end touch, not the one alone that was pressed in furthest.
  CHECK(found.series.column("contacts").back() > 12);
  CHECK(std::abs(found.series.column("stress").front()) < 1);
  std::filesystem::copy(folder / "results/packing.txt", folder / "packing.txt");
  std::filesystem::remove_all(folder / "results");
  auto again = press;
  again.insert(again.end(), {"Specimen/Source=file", "Specimen/File=packing.txt"});
  is_refused(folder, "mortar.prm", again, "has a vessel");
}

TEST_CASE("Published values of a test are reported beside its own, which do not depend on them", "[apps][genesis]")
{
  const ScratchFolder            folder;
  const std::vector<std::string> press = {"Specimen/Genesis/Stress=0", "Laboratory/Test=uniaxial compression",
                                          "Laboratory/Axis=y",         "Laboratory/Effective modulus=8e9",
                                          "Laboratory/Speed=0.04",     "Laboratory/Largest strain=4e-3",
                                          "Laboratory/Stop at=0.7",    "Laboratory/Platens=vessel walls",
                                          "Time/End time=0.1"};
  folder.file("mortar.prm", mortar_scene);
  const Results alone = results_of(folder, "mortar.prm", press);
  CHECK_FALSE(alone.summary["figures"]["laboratory"].contains("published"));
  const std::string curve          = content_of(folder / "results/stress_strain.csv");
  auto              with_published = press;
  with_published.insert(with_published.end(),
                        {"Laboratory/Published strength=2.75e6", "Laboratory/Published modulus=7.994e9",
                         "Laboratory/Published Poisson ratio=0.2"});
  std::filesystem::remove_all(folder / "results");
  const Results beside = results_of(folder, "mortar.prm", with_published);
  CHECK(content_of(folder / "results/stress_strain.csv") == curve);
  const auto &found = beside.summary["figures"]["laboratory"];
  for (const auto &[published, here, value] :
       {std::tuple{"strength", "compressive_strength", 2.75e6}, std::tuple{"young_modulus", "young_modulus", 7.994e9},
        std::tuple{"poisson_ratio", "poisson_ratio", 0.2}})
    {
      INFO(published);
      CHECK(found["published"][published]["value"].get<double>() == value);
      CHECK(found["published"][published]["found_over_published"].get<double>() ==
            Approx(found[here]["value"].get<double>() / value).epsilon(1e-12));
    }
  CHECK(std::filesystem::exists(folder / "results/stress_strain.png"));
  std::filesystem::remove_all(folder / "results");
  is_refused(folder, "mortar.prm", {"Laboratory/Published strength=-1"}, "Published strength");
}

TEST_CASE("A genesis that was interrupted goes on to the same bits", "[apps][genesis][slow]")
{
  const ScratchFolder folder;
  folder.file("mortar.prm", replaced(mortar_scene, "0.02, 0.03", "0.03, 0.05"));
  goes_on_to_the_same_bits(folder,
                           {{"run", "mortar.prm", "--no-cache"},
                            {"scene.prm"},
                            [](const std::filesystem::path &results) {
                              return content_of(results / "packing.txt") + content_of(results / "series.csv");
                            }},
                           {SIGINT});
}

TEST_CASE("Aggregates are clumps in mortar, bonded to it and not to each other", "[apps][genesis]")
{
  const ScratchFolder folder;
  const Results       found   = results_of(folder, concrete, small_piece());
  const dem::Packing  packing = postprocess::read_packing(folder / "results/packing.txt");
  REQUIRE(packing.bodies.size() >= 3);
  CHECK(packing.material_names == std::vector<std::string>{"mortar", "aggregate"});
  for (std::size_t i = 0; i < packing.size(); ++i)
    CHECK((packing.clump[i] >= 0) == (packing.material[i] == 1));
  CHECK(found.series.column("broken_links").back() == 0);

  CHECK(found.summary["cost"]["links"].get<int>() > 500);
}

TEST_CASE("What a genesis cannot be made of is refused with the place", "[apps][genesis]")
{
  const ScratchFolder folder;
  const std::string   of = "Specimen/Genesis/";
  folder.file("mortar.prm", mortar_scene);
  is_refused(folder, "mortar.prm", {of + "Classes=1e-3: 0.5, 3e-3: 0.4"}, "fractions sum up to 0.9");
  is_refused(folder, "mortar.prm", {of + "Classes=1e-3"}, "expected diameter: fraction");
  is_refused(folder, "mortar.prm", {of + "Classes=1 m: 1"}, "not one particle fits");
  is_refused(folder, "mortar.prm", {of + "Vessel=cylinder"}, "a cylinder has three dimensions");
  is_refused(folder, "mortar.prm", {of + "Size=0, 0.03, 0"}, "must be above 0");
  is_refused(folder, "mortar.prm", {of + "Stress=1e12"}, "far below the modulus");
  is_refused(folder, "mortar.prm", {of + "Sizes=file", of + "Size file=none.csv"}, "no such file");
  is_refused(folder, concrete, small_piece({of + "Aggregates/Sizes=9e-3, 5e-3"}), "must ascend");
  is_refused(folder, concrete, small_piece({of + "Aggregates/Most corners=3"}), "must not be below Fewest corners");
  is_refused(folder, concrete, small_piece({"Interfaces/transition zone/Material=mortr"}),
             "is not in section Materials");
}

TEST_CASE("Sizes are read from a table: diameters, ranges or a sieve curve", "[apps][genesis]")
{
  const ScratchFolder folder;
  folder.file("mortar.prm", mortar_scene);
  const auto forecast = [&](const std::string &table) {
    folder.file("sizes.csv", table);
    const Outcome found = outcome_of(folder, "check", "mortar.prm",
                                     {"Specimen/Genesis/Sizes=file", "Specimen/Genesis/Size file=sizes.csv"});
    INFO(found.err);
    CHECK(found.status == 0);
    return found.out;
  };
  CHECK_THAT(forecast("diameter [mm],fraction\n1,0.5\n3.2,0.5\n"), Contains("378, to be grown: 344 34"));
  CHECK_THAT(forecast("diameter_mm;fraction [%]\n1;50\n3.2;50\n"), Contains("378, to be grown: 344 34"));
  CHECK_THAT(forecast("smallest [m],largest [m],fraction\n0.001,0.001,0.5\n0.0032,0.0032,0.5\n"),
             Contains("378, to be grown: 344 34"));
  const std::vector<std::string> curves = {"size [mm],passing\n1,0\n2,0.5\n4,1\n",
                                           "size [mm],passing\n4,1\n2,0.5\n1,0\n",
                                           "Size (mm),Passing (%)\n1,0\n2,50\n4,100\n",
                                           "sieve [mm];passing [%]\n1;0\n2;50\n4;100\n",
                                           "size_mm,passing\n1,0\n2,0.5\n4,1\n",
                                           "size [m],passing\n0.004,100\n0.002,50\n0.001,0\n",
                                           "size [mm],retained\n1,0.5\n2,0.5\n4,0\n",
                                           "size [mm],retained [%]\n4,0\n2,50\n1,50\n0,0\n",
                                           "size [mm],retained [g]\n4,0\n2,312.5\n1,312.5\n",
                                           "size [um],retained\n4000,0\n2000,50\n1000,50\n"};
  for (const std::string &curve : curves)
    CHECK_THAT(forecast(curve), Contains("to be grown: 147 37") &&
                                  Contains("sizes        0.001 to 0.002 m: 147, 0.499 of the solid for 0.5"));
  folder.file("sizes.csv", "size [mm],passing\n1,0\n2,0.5\n");
  is_refused(folder, "mortar.prm", {"Specimen/Genesis/Sizes=file", "Specimen/Genesis/Size file=sizes.csv"},
             "0.5 passes the largest sieve; it must be 1");
  for (const auto &[table, fault] : std::vector<std::pair<std::string, std::string>>{
         {"size [mm],passing\n1,0.02\n2,0.5\n4,1\n", "0.02 of the solid is finer than the smallest sieve of 0.001 m"},
         {"size [mm],passing\n1,0\n2,0.5\n3,0.4\n4,1\n", "row 3: less passes than the finer sieve of row 2"},
         {"size [mm],retained\n1,0.5\n2,0.4\n4,0.1\n", "row 3: 0.1 of the solid lies on the largest sieve"},
         {"size [mm],retained\n1,0.5\n2,0.4\n4,0\n", "sums up to 0.9"},
         {"size [mm],retained [%]\n0,3\n1,50\n2,47\n4,0\n", "0.03 of the solid is finer than the smallest sieve"},
         {"size,passing\n1,0\n2,0.5\n4,1\n", "a particle of 4 m. In mm? Name the unit: size [mm]"},
         {"size [mesh],passing\n1,0\n2,1\n", "is in [mesh]: expected one of m, cm, mm, um"},
         {"size [mm],passing\n1,0\n1,1\n", "the same size as row 1"}})
    {
      folder.file("sizes.csv", table);
      is_refused(folder, "mortar.prm", {"Specimen/Genesis/Sizes=file", "Specimen/Genesis/Size file=sizes.csv"}, fault);
    }
}

TEST_CASE("A vessel too small for its sizes is refused with the smallest that would do, which does", "[apps][genesis]")
{
  const ScratchFolder folder;
  folder.file("mortar.prm", mortar_scene);
  const std::string              of        = "Specimen/Genesis/";
  const std::vector<std::string> requested = {of + "Classes=1e-3: 0.75, 8e-3: 0.25", of + "Porosity=0.15"};
  const auto                     with      = [&](const std::vector<std::string> &more) {
    std::vector<std::string> all = requested;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const Outcome refused = outcome_of(folder, "check", "mortar.prm", with({of + "Size=0.01, 0.01, 0"}));
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("0 whole particles of diameter 0.008 m are 0 of the solid and not 0.25") &&
                            Contains("Size tolerance is 0.05"));
  // One particle of 8 mm is 0.3 of the solid where that is pi/4 (8 mm)^2/0.3/0.85: 14.04 mm wide.
  CHECK_THAT(refused.err, Contains("smallest vessel of this shape that would do is 0.01404, 0.01404 m"));
  const auto found = outcome_of(folder, "check", "mortar.prm", with({of + "Size=0.01405, 0.01405, 0"}));
  CHECK(found.status == 0);
  CHECK_THAT(found.out, Contains("sizes        0.008 m: 1, 0.3 of the solid for 0.25"));
  // That, and 160 of 1 mm, in the vessel.
  CHECK_THAT(found.out, Contains("porosity     0.1088 with so many whole particles, for 0.15"));
  is_refused(folder, "mortar.prm", with({of + "Size=0.01403, 0.01403, 0"}), "smallest vessel");
  CHECK(
    outcome_of(folder, "check", "mortar.prm", with({of + "Size=0.01, 0.01, 0", of + "Size tolerance=0.3"})).status ==
    0);
  is_refused(folder, concrete, small_piece({of + "Size tolerance=1e-3"}), "whole aggregates miss the grading by");
}

TEST_CASE("A porosity of the laboratory stands for one in the plane, and for none in space", "[apps]")
{
  const ScratchFolder folder;
  const std::string   scene = folder.file("mortar.prm", mortar_scene);
  const auto          says  = [&](const std::string &entry) {
    return outcome_of(folder, "check", scene, {"Specimen/Genesis/" + entry}).out;
  };
  const auto        particles = [](const std::string &text) { return text.substr(text.find("particles"), 40); };
  const std::string in_plane = says("Porosity=0.075328"), laboratory = says("Laboratory porosity=0.22");
  REQUIRE_THAT(in_plane, Contains("particles"));
  CHECK(particles(laboratory) == particles(in_plane));
  is_refused(folder, places::sources() + "/apps/scenes/rock_triaxial.prm",
             {"Specimen/Source=genesis", "Specimen/Genesis/Size=0.02, 0.02, 0.04", "Specimen/Genesis/Classes=2e-3: 1",
              "Specimen/Genesis/Effective modulus=1e9", "Specimen/Genesis/Stress=0",
              "Specimen/Genesis/Laboratory porosity=0.2"},
             "Laboratory porosity", {"check"});
}

TEST_CASE("A scene whose particles have grown before takes them from the user's cache, to the same bits",
          "[apps][genesis][packing_cache]")
{
  const ScratchFolder folder;
  const Environment   caches("XDG_CACHE_HOME", (folder / "caches").string());
  folder.file("mortar.prm", replaced(mortar_scene, "0.02, 0.03", "0.0141, 0.0141"));
  const auto made_by = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"run", "mortar.prm", "-o", "results", "--restart"});
    REQUIRE(run(folder.path(), words).status == 0);
    return content_of(folder / "results/packing.txt") + content_of(folder / "results/genesis.json") +
           content_of(folder / "results/series.csv");
  };
  const auto says_kept = [&] {
    return run(folder.path(), {"check", "mortar.prm"}).out.find("grown before, and kept") != std::string::npos;
  };
  CHECK_FALSE(says_kept());
  const std::string without = made_by({"--no-cache"});
  CHECK_FALSE(says_kept());
  CHECK(made_by({}) == without);
  CHECK(says_kept());
  CHECK(made_by({}) == without);
}
