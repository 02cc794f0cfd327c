#include "apps/text/value_text.h"
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string quasi_static_scene()
  {
    std::string scene = replaced(scene_with_file(), "Kind = uniaxial", "Kind = quasi_static");
    scene             = replaced(scene, "  set Density           = 4800\n", "");
    scene             = replaced(scene, "set Strain rate = 4\n", "set Stop fraction = 0.5\n");
    scene = replaced(scene, "set Strain rate = 20\n", "set Stop strain = 4e-4\n    set Strain step = 1e-5\n");
    return replaced(scene, "  set Samples   = 50\n  set Snapshots = 5\n", "  set Points per snapshot = 20\n");
  }

  /** 3 x 3 x 4 spheres of 1 mm near a cubic lattice: irregular, so that links fail one after the other. */
  std::string small_heap()
  {
    std::ostringstream text;
    for (int i = 0; i < 36; ++i)
      text << 2e-3 * (i % 3 + 0.1 * std::sin(7 * i)) << ' ' << 2e-3 * (i / 3 % 3 + 0.1 * std::sin(11 * i)) << ' '
           << 2e-3 * (i / 9 + 0.1 * std::sin(13 * i)) << " 1e-3\n";
    return text.str();
  }

  /** Rows of series.csv, the header left out; fields as they stand. */
  std::vector<std::vector<std::string>> rows_of(const std::filesystem::path &file)
  {
    std::istringstream                    csv(content_of(file));
    std::string                           line;
    std::vector<std::vector<std::string>> rows;
    std::getline(csv, line);
    while (std::getline(csv, line))
      rows.push_back(apps::comma_separated(line));
    return rows;
  }
} // namespace

TEST_CASE("a quasi-static run of two spheres follows the envelope of their link", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", pair_packing());
  folder.file("x.prm", quasi_static_scene());
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "out", "-s", "Loading/Tests=tension"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("tension") && Contains("controlled by strain"));
  const auto summary = nlohmann::json::parse(content_of(folder / "out/summary.json"));
  // E eps_0 of the link, over a section that is the polygon about its circle (2 % at most).
  const double strength = summary["figures"]["tensile_strength"]["value"],
               modulus  = summary["figures"]["young_modulus"]["value"];
  CHECK(strength == Approx(2.5e6).epsilon(0.02));
  CHECK(strength / modulus == Approx(1e-4).epsilon(1e-6)); // the step that ends on the peak
  CHECK(summary["energy"]["balance_error"].get<double>() < 1e-3);
  CHECK(content_of(folder / "out/series.csv").find("nan") == std::string::npos);
  const auto rows = rows_of(folder / "out/series.csv");
  REQUIRE(rows.size() > 20);
  for (const auto &row : rows)
    {
      REQUIRE(row.size() == 15);
      CHECK((row.back() == "strain" || row.back() == "opening"));
      const double strain = *apps::number_in(row[2]), stress = *apps::number_in(row[3]);
      const double envelope =
        strain <= 1e-4 ? strain : 1e-4 * std::exp(-(strain - 1e-4) / 30e-4); // (2.17) of Stransky (2018)
      CHECK(stress == Approx(modulus * envelope).epsilon(1e-7));
    }
  for (const char *name : {"curve.png", "tension_crack.png", "scene.prm", "packing.h5", "tension_particles.pvd"})
    CHECK(std::filesystem::file_size(folder / "out" / name) > 0);
}

TEST_CASE("a quasi-static run pulls and crushes a specimen, and closes its energy balance", "[apps][slow]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", small_heap());
  folder.file("x.prm", quasi_static_scene());
  const auto    past_peak = std::string("Loading/Compression/Stop strain=2e-3");
  const Outcome outcome   = run(folder.path(), {"run", "x.prm", "-o", "out", "-s", past_peak});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto summary = nlohmann::json::parse(content_of(folder / "out/summary.json"));
  REQUIRE(summary["figures"]["strength_ratio"]["value"].is_number());
  CHECK(summary["figures"]["strength_ratio"]["value"].get<double>() > 1);
  for (const auto &test : summary["tests"])
    {
      CHECK(test["points"]["strain"].get<int>() + test["points"]["opening"].get<int>() > 10);
      CHECK(test["energy"]["balance_error"].get<double>() < 0.05);
    }
}

TEST_CASE("grips of a quasi-static scene turn where they hold sideways, and make an irregular specimen softer",
          "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", small_heap());
  folder.file("x.prm", quasi_static_scene());
  std::vector<double> modulus;
  for (const char *turn : {"false", "true"})
    {
      const Outcome outcome =
        run(folder.path(), {"run", "x.prm", "-o", turn, "-s", "Loading/Tests=compression", "-s",
                            "Loading/Lateral motion blocked=true", "-s", std::string("Loading/Grips turn=") + turn});
      INFO(outcome.err);
      REQUIRE(outcome.status == 0);
      const auto summary = nlohmann::json::parse(content_of(folder / turn / "summary.json"));
      modulus.push_back(summary["figures"]["young_modulus"]["value"].get<double>());
    }
  CHECK(modulus[1] < (1 - 1e-6) * modulus[0]); // one condition less
  CHECK(modulus[1] > 0.5 * modulus[0]);
  const Outcome outcome = run(folder.path(), {"check", "x.prm", "-s", "Loading/Grips turn=true"});
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains("Loading/Grips turn") && Contains("Lateral motion blocked"));
}

TEST_CASE("grips that turn in motion find the modulus and the strength of those that turn in equilibrium", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", small_heap());
  folder.file("moving.prm", scene_with_file());
  folder.file("still.prm", quasi_static_scene());
  const auto pulled = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"-s", "Loading/Tests=tension"});
    const Outcome outcome = run(folder.path(), words);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto figures = nlohmann::json::parse(content_of(folder / words[3] / "summary.json"))["figures"];
    return std::pair(figures["young_modulus"]["value"].get<double>(),
                     figures["tensile_strength"]["value"].get<double>());
  };
  const std::string block = "Grip lateral motion blocked=true";
  for (const std::string turn : {"false", "true"})
    {
      const std::string grips = "Loading/Grips turn=" + turn;
      const auto        still = pulled({"run", "still.prm", "-o", "still_" + turn, "-s", grips, "-s",
                                        "Loading/Lateral motion blocked=true", "-s", "Loading/Tension/Strain step=2e-6"});
      const auto moving = pulled({"run", "moving.prm", "-o", "moving_" + turn, "-s", grips, "-s", "Loading/" + block,
                                  "-s", "Loading/Tension/Strain rate=0.2"});
      INFO(turn);
      CHECK(moving.first == Approx(still.first).epsilon(0.01));
      CHECK(moving.second == Approx(still.second).epsilon(0.01));
    }
  const Outcome outcome = run(folder.path(), {"check", "moving.prm", "-s", "Loading/Grips turn=true"});
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains("Loading/Grips turn") && Contains("Grip lateral motion blocked"));
}

TEST_CASE("a quasi-static test that ends before its peak has no strength, and says so", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", small_heap());
  folder.file("x.prm", quasi_static_scene());
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "out"}).status == 0);
  const auto figures = nlohmann::json::parse(content_of(folder / "out/summary.json"))["figures"];
  for (const char *name : {"compressive_strength", "strength_ratio"})
    {
      INFO(name);
      CHECK(figures[name]["value"].is_null());
      CHECK_FALSE(figures[name]["not_determined"].get<std::string>().empty());
    }
  CHECK(figures["tensile_strength"]["value"].is_number());
}

TEST_CASE("an interrupted quasi-static run goes on to the same bits", "[apps][slow][S13]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", small_heap());
  folder.file("x.prm", replaced(quasi_static_scene() + "subsection Output\n  set Checkpoint interval = 0.01\nend\n",
                                "subsection Loading\n", "subsection Loading\n  set Tests = tension\n"));
  const auto reproducible_part = [](const std::filesystem::path &results) {
    return content_of(results / "series.csv") + listing_of(results / "tension_links");
  };
  goes_on_to_the_same_bits(
    folder, {{"run", "x.prm"}, {"tension_links/tension_links_000001.vtp", "checkpoint.h5"}, reproducible_part},
    {SIGINT});
}

TEST_CASE("a quasi-static scene refuses what it cannot load", "[apps][S14]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", pair_packing());
  folder.file("x.prm", quasi_static_scene());
  const auto refused = [&](const std::string &setting, const std::string &reason) {
    const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "out", "-s", setting});
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(reason));
  };
  refused("Specimen/Body=cell", "not periodic");
  refused("Loading/Grip thickness=5e-3", "the two grips would meet");
  refused("Loading/Tension/Strain step=0.5", "Stop strain");
  refused("Solver/Growth step=2", "Growth step");
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_CASE("discs grown into a box are pulled as the same discs are that a file holds", "[apps]")
{
  const ScratchFolder folder;
  const std::string
    genesis =
      "set Source = genesis\n  set Thickness = 0.01\n  subsection Genesis\n    set Size = 0.02, 0.02, 0\n"
      "    set Sizes = uniform\n    set Mean radius = 1e-3\n    set Radius ratio = 1.6\n    set Porosity = 0.14\n"
      "    set Effective modulus = 25e9\n    set Stress = 0\n  end\n",
    file          = "set Source = file\n  set File = grown/packing.h5\n  set Thickness = 0.01\n";
  const auto with = [](const std::string &source) {
    return "set Kind = quasi_static\nsubsection Physics\n  set Dimension = 2\nend\nsubsection Specimen\n  set "
           "Interaction ratio = 1.4\n"
           "  set Loose pieces = drop\n  " +
           source +
           "end\nsubsection Material\n  set Law = CPM\n  subsection CPM\n    set Normal modulus = 25e9\n    set Shear "
           "ratio = 0.2\n"
           "    set Limit elastic strain = 1e-4\n    set Relative ductility = 30\n    set Cohesion = 3e6\n    set "
           "Friction coefficient = 0.8\n"
           "  end\nend\nsubsection Loading\n  set Tests = tension\n  set Axis = y\n  set Grip thickness = 0.003\n  "
           "subsection Tension\n"
           "    set Strain step = 5e-6\n    set Stop strain = 4e-5\n  end\nend\n";
  };
  folder.file("grown.prm", with(genesis));
  folder.file("read.prm", with(file));
  for (const char *name : {"grown", "read"})
    {
      const Outcome outcome = run(folder.path(), {"run", std::string(name) + ".prm", "-o", name});
      INFO(outcome.err);
      REQUIRE(outcome.status == 0);
    }
  const std::string grown = content_of(folder / "grown/series.csv");
  CHECK(std::count(grown.begin(), grown.end(), '\n') > 8);
  CHECK(grown == content_of(folder / "read/series.csv"));
  const auto summary = nlohmann::json::parse(content_of(folder / "grown/summary.json"));
  CHECK(summary["energy"]["balance_error"].get<double>() < 1e-3);

  const Outcome cell = run(folder.path(), {"check", "grown.prm", "-s", "Specimen/Body=cell"});
  CHECK(cell.status == 2);
  CHECK_THAT(cell.err, Contains("Specimen/Body") && Contains("a grown packing has faces"));
  const Outcome polygons = run(folder.path(), {"check", "grown.prm", "-s", "Specimen/Genesis/Aggregates/Content=0.3"});
  CHECK(polygons.status == 2);
}
