#include "postprocess/files/csv_table.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace apps_tests;
using Catch::Contains;

namespace
{
} // namespace

TEST_CASE("A run writes summary, series, curve, snapshots and the completed scene, and nothing else", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", scene_with_file());
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Output/Samples=60"});
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("tension") && Contains("compression") && Contains("energy") && Contains("results"));
  for (const char *name :
       {"scene.prm", "packing.h5", "series.csv", "curve.png", "summary.json", "tension_particles.pvd",
        "tension_links.pvd", "compression_particles.pvd", "compression_links.pvd", "tension_crack.png"})
    CHECK(std::filesystem::file_size(folder / "results" / name) > 0);
  CHECK_FALSE(std::filesystem::exists(folder / "results/running"));

  const nlohmann::json summary = summary_in(folder / "results");
  for (const char *figure : {"young_modulus", "tensile_strength", "compressive_strength", "strain_at_tensile_peak",
                             "strain_at_compressive_peak"})
    {
      CHECK(summary["figures"][figure]["value"].get<double>() > 0);
      CHECK(summary["figures"][figure].contains("unit"));
    }
  for (const char *cost :
       {"particles", "links", "steps", "time_step", "threads", "wall_seconds", "link_updates_per_second"})
    CHECK(summary["cost"][cost].get<double>() > 0);
  CHECK(summary["cost"]["particles"] == 175);
  CHECK(summary["energy"]["balance_error"].get<double>() >= 0);
  CHECK(summary["scene"] == "x.prm");
  CHECK(summary["requested"]["overrides"][0] == "Output/Samples=60");
  CHECK_THAT(summary["version"].get<std::string>(), Catch::StartsWith("0."));

  const postprocess::CsvTable series = postprocess::read_csv_table(folder / "results/series.csv", false, {"test"});
  const double largest = *std::max_element(series.column("stress").begin(), series.column("stress").end());
  // The strength is that of all steps, of which the rows are a few.
  CHECK(summary["figures"]["tensile_strength"]["value"].get<double>() == Approx(largest).epsilon(0.02));
  CHECK(summary["figures"]["tensile_strength"]["value"].get<double>() >= largest);
  for (const char *column :
       {"test", "time", "strain", "mean_damage", "broken_links", "contacts", "energy_external_work", "energy_kinetic",
        "energy_elastic", "energy_damage", "energy_friction", "energy_damping"})
    CHECK_NOTHROW(series.column(column));
}

TEST_CASE("The completed scene, the scene in JSON and any number of threads give the same results to the last bit",
          "[apps][slow][S13]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", scene_with_file());
  folder.file("x.json", R"({"Kind": "uniaxial",
    "Specimen": {"Source": "file", "File": "packing.txt", "Density": 4800, "Interaction ratio": 1.5},
    "Material": {"Law": "CPM", "CPM": {"Normal modulus": 25e9, "Shear ratio": 0.2, "Limit elastic strain": 1e-4,
                 "Relative ductility": "30", "Cohesion": 3e6, "Friction coefficient": 0.8}},
    "Loading": {"Grip thickness": 0.5e-3, "Tension": {"Strain rate": 4}, "Compression": {"Strain rate": 20}},
    "Output": {"Samples": 50, "Snapshots": 5}})");
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "first", "--threads", "1"}).status == 0);
  REQUIRE(run(folder.path(), {"run", "first/scene.prm", "-o", "second", "--threads", "2"}).status == 0);
  REQUIRE(run(folder.path(), {"run", "x.json", "-o", "third", "--threads", "1"}).status == 0);
  const std::string series = content_of(folder / "first/series.csv");
  CHECK(series == content_of(folder / "second/series.csv"));
  CHECK(series == content_of(folder / "third/series.csv"));
}

TEST_CASE("Two particles give the curve of their one link, in closed form", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", pair_packing());
  folder.file("x.prm", scene_with_file());
  REQUIRE(run(folder.path(),
              {"run", "x.prm", "-o", "results", "-s", "Loading/Tests=tension", "-s", "Loading/Tension/Stop strain=0.03",
               "-s", "Output/Samples=2000", "-s", "Loading/Tension/Stop fraction=1e-5"})
            .status == 0);
  // Pulled along its axis, the pair is one link of section pi r^2 and length 2 r, whose stress follows the envelope of
  // the law (doc/theory/cpm.md, 3) until it is deleted with 1e-4 of its strength. The specimen's section,
  // a polygon for its circle, is approximate: the shape of the curve is compared, and energies in absolute value.
  const postprocess::CsvTable series = postprocess::read_csv_table(folder / "results/series.csv", false, {"test"});
  const auto                 &strain = series.column("strain"), &stress = series.column("stress");
  const double                E = 25e9, onset = 1e-4, softening = 30e-4, left_at_deletion = 1e-4;
  const auto                  envelope = [&](const double e) {
    return e <= onset ? E * e : E * onset * std::exp((onset - e) / softening);
  };
  REQUIRE(strain[0] < onset);
  const double sections = stress[0] / envelope(strain[0]);
  for (std::size_t i = 0; i < strain.size(); ++i)
    {
      const bool deleted = std::exp((onset - strain[i]) / softening) < left_at_deletion;
      // Rounding of the link's length leaves 1e-13 of strain, 1e-9 of the onset.
      CHECK(stress[i] == Approx(deleted ? 0 : sections * envelope(strain[i])).epsilon(1e-7));
    }
  const double volume     = M_PI * 1e-6 * 2e-3;
  const double dissipated = E * onset * (onset / 2 + softening * (1 - left_at_deletion)) * volume;
  // The link is deleted at the first step past the strain of deletion; one step here is 1e-6 of strain.
  CHECK(series.column("energy_damage").back() + series.column("energy_released").back() ==
        Approx(dissipated).epsilon(1e-6));
  CHECK(series.column("energy_external_work").back() == Approx(dissipated).epsilon(1e-3)); // rectangles over the steps
  CHECK(series.column("broken_links").back() == 1);
}

TEST_CASE("A chain of three radii stores the energy of its links in series", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", "0 0 0 2e-3\n0 0 3.5e-3 1.5e-3\n0 0 6e-3 1e-3\n");
  folder.file("x.prm", scene_with_file());
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Loading/Tests=tension", "-s",
                              "Specimen/Interaction ratio=1.05", "-s", "Loading/Tension/Strain rate=0.05", "-s",
                              "Loading/Tension/Stop strain=5e-5", "-s", "Loading/Grip thickness=0.1e-3"})
            .status == 0);
  // Two springs E A/L in series, A = pi min(r)^2 (doc/theory/links.md, 2): lengths 3.5 and 2.5 mm, radii 1.5 and
  // 1 mm.
  const double                compliance = (3.5e-3 / (M_PI * 2.25e-6) + 2.5e-3 / (M_PI * 1e-6)) / 25e9;
  const postprocess::CsvTable series     = postprocess::read_csv_table(folder / "results/series.csv", false, {"test"});
  const double                stretch    = series.column("strain").back() * 6e-3;
  CHECK(series.column("links").back() == 2);
  // The middle sphere's vibration from the start has been damped; 1e-6 of the energy is what a slow pull still leaves.
  CHECK(series.column("energy_elastic").back() == Approx(0.5 * stretch * stretch / compliance).epsilon(1e-5));
}

TEST_CASE("check says particles, links, steps, memory and duration, and writes nothing", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", scene_with_file());
  const std::string before  = listing_of(folder.path());
  const Outcome     outcome = run(folder.path(), {"check", "x.prm"});
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("x.prm: valid") && Contains("particles    175") && Contains("links") &&
                            Contains("time step") && Contains("memory") && Contains("tension      at most") &&
                            Contains("duration"));
  CHECK(listing_of(folder.path()) == before);
}
