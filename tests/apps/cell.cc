#include "postprocess/files/csv_table.h"
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** n^3 touching spheres of 1 mm on a cubic lattice, periodic. */
  std::string cubic(const int n)
  {
    std::ostringstream text;
    text << "# periodic_cell " << 2e-3 * n << ' ' << 2e-3 * n << ' ' << 2e-3 * n << '\n';
    for (int i = 0; i < n * n * n; ++i)
      text << 2e-3 * (i % n) << ' ' << 2e-3 * (i / n % n) << ' ' << 2e-3 * (i / (n * n)) << " 1e-3\n";
    return text.str();
  }

  std::string cell_scene(const std::string &legs)
  {
    std::string scene = replaced(scene_with_file(), "Kind = uniaxial", "Kind = cell");
    const auto  begin = scene.find("subsection Loading"), end = scene.find("subsection Output");
    scene.replace(begin, end - begin, "subsection Loading\n" + legs + "end\n");
    return replaced(scene, "Interaction ratio = 1.5", "Interaction ratio = 1.2");
  }
} // namespace

TEST_CASE("a cell scene of a cubic lattice gives its exact stiffness, strain and stress given", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", cubic(2));
  folder.file("x.prm", cell_scene("  subsection Leg 1\n    set Duration = 2e-4\n    set xx = strain 5e-5\n"
                                  "    set yy = stress 1e5\n    set xy = strain 2e-5\n  end\n"));
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "out", "-s", "Time/Damping=0.5"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("energy") && !Contains("localised"));
  const auto summary = nlohmann::json::parse(content_of(folder / "out/summary.json"));
  const auto end     = summary["figures"]["end"];
  // doc/theory/homogenisation.md, 5: D11 = (pi/4) E, D12 = 0, D66 = (pi/8) G, E = 25 GPa, G = 5 GPa. Finite strain changes it by
  // parts in 1e-4, what is left of waves by less than a hundredth.
  CHECK(end["strain"][0].get<double>() == Approx(5e-5).epsilon(1e-9));
  CHECK(end["stress"][0].get<double>() == Approx(M_PI / 4 * 25e9 * 5e-5).epsilon(0.01));
  CHECK(end["stress"][1].get<double>() == Approx(1e5).epsilon(0.02));
  CHECK(end["strain"][1].get<double>() == Approx(1e5 / (M_PI / 4 * 25e9)).epsilon(0.02));
  CHECK(end["stress"][5].get<double>() == Approx(M_PI / 8 * 5e9 * 2e-5).epsilon(0.01));
  CHECK(std::fabs(end["stress"][2].get<double>()) < 1e3);
  CHECK(summary["localisation"].is_null());
  CHECK(summary["ended_by"] == "end of the path");
  CHECK(summary["warnings"].empty());
  CHECK(summary["energy"]["balance_error"].get<double>() < 1e-3);
  const auto series = postprocess::read_csv_table(folder / "out/series.csv");
  CHECK(series.rows() > 40);
  CHECK(series.column("strain_xx").back() == end["strain"][0].get<double>());
  for (const char *name : {"curve.png", "cell_crack.png", "cell_particles.pvd", "scene.prm", "packing.h5"})
    CHECK(std::filesystem::file_size(folder / "out" / name) > 0);
}

TEST_CASE("a cell scene whose particles do not come to bear a stress says that it is not reached", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt",
              "# periodic_cell 8e-3 2.1e-3 2.2e-3\n0 0 0 1e-3\n2e-3 0 0 1e-3\n4e-3 0 0 1e-3\n6e-3 0 0 1e-3\n");
  folder.file("x.prm",
              replaced(cell_scene("  set Legs = 2\n  subsection Leg 1\n    set Duration = 5e-4\n    set xx = stress "
                                  "-1e5\n    set yy = stress -1e5\n    set zz = stress -1e5\n  end\n"
                                  "  subsection Leg 2\n    set Duration = 5e-4\n    set xx = strain -1e-3\n  end\n"),
                       "Interaction ratio = 1.2", "Interaction ratio = 1.001"));
  const Outcome checked = run(folder.path(), {"check", "x.prm"});
  CHECK(checked.status == 0);
  CHECK_THAT(checked.out, Contains("not against every strain"));
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "out"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out,
             Contains("stress not reached") && Contains("when leg 1 ended") && Contains("prescribed by then"));
  const auto summary = nlohmann::json::parse(content_of(folder / "out/summary.json"));
  CHECK(summary["ended_by"] == "stress not reached");
  CHECK_THAT(summary["warnings"].at(0).get<std::string>(), Contains("stress yy") || Contains("stress zz"));
  CHECK(postprocess::read_csv_table(folder / "out/series.csv").column("time").back() < 6e-4); // no second leg
}

TEST_CASE("check says how the particles of a scene would be shared out among ranks", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", cubic(12)); // 1728 particles are six bricks and a part of one, with three links each
  folder.file("x.prm", cell_scene("  subsection Leg 1\n    set Duration = 2e-6\n    set xx = strain 5e-7\n  end\n"));
  const Outcome three = run(folder.path(), {"check", "x.prm", "--ranks", "3"});
  INFO(three.out << three.err);
  REQUIRE(three.status == 0);
  CHECK_THAT(three.out, Contains("ranks        3, of 2 to 3 bricks of 256 particles"));
  CHECK_THAT(three.out, Contains(" 5184 links and ") && !Contains(" 0 copies") && Contains("efficiency   "));
  CHECK_THAT(three.out, Contains("with 2 neighbours")); // a cell of three ranges: each meets both others
  const Outcome one = run(folder.path(), {"check", "x.prm", "--ranks", "1"});
  CHECK_THAT(one.out, Contains(" 5184 links and 0 copies") && Contains("ghosts       0 ") &&
                        Contains("efficiency   100 % expected"));
  CHECK_THAT(run(folder.path(), {"check", "x.prm"}).out, !Contains("ranks"));

  const Outcome solid =
    run(folder.path(), {"check", places::sources() + "/apps/scenes/cantilever.prm", "--ranks", "2"});
  CHECK(solid.status == 2);
  CHECK_THAT(solid.err, Contains("shares are forecast for scenes of kind cell, particles and uniaxial only"));
}

TEST_CASE("an interrupted run of a cell goes on to the same bits", "[apps][slow][S13]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", cubic(5));
  folder.file(
    "x.prm", cell_scene("  set Legs = 2\n  subsection Leg 1\n    set Duration = 4e-3\n    set xx = strain 2e-4\n  end\n"
                        "  subsection Leg 2\n    set Duration = 4e-3\n    set xx = strain -1e-4\n  end\n") +
               "subsection Output\n  set Checkpoint interval = 0.01\nend\n");
  const auto reproducible_part = [](const std::filesystem::path &results) {
    return content_of(results / "series.csv") + listing_of(results / "cell_links");
  };
  goes_on_to_the_same_bits(folder, {{"run", "x.prm"}, {"checkpoint.h5"}, reproducible_part}, {SIGINT});
}

TEST_CASE("a cell scene refuses a path that means nothing", "[apps][S14]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", cubic(2));
  folder.file("pair.txt", pair_packing());
  folder.file("x.prm", cell_scene("  subsection Leg 1\n    set Duration = 1e-4\n  end\n"));
  const auto refused = [&](const std::string &setting, const std::string &reason) {
    const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "out", "-s", setting});
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(reason));
  };
  refused("Loading/Leg 1/xx=pull 3", "expected \"strain VALUE\"");
  refused("Loading/Leg 1/xx=strain", "expected \"strain VALUE\"");
  refused("Loading/Legs=12", "Legs");
  refused("Specimen/File=pair.txt", "not periodic");
  refused("Loading/Leg 1/Duration=1e9 s", "steps of");
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}
