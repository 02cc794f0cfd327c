#include "postprocess/files/csv_table.h"
#include "tests/apps/continuum_scenes.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/environment.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  double figure(const nlohmann::json &summary, const char *name)
  {
    return summary["figures"][name]["value"].get<double>();
  }
} // namespace

TEST_CASE("A continuum runs without a folder for temporary files", "[apps]")
{
  const ScratchFolder folder;
  folder.file("x.prm", concrete_beam_scene());
  const Environment nowhere("TMPDIR", "/dev/null/nowhere"); // which nobody can make
  for (const char *command : {"check", "run"})
    {
      const Outcome outcome = run(folder.path(), {command, "x.prm", "-s", "Control/End=2e-5"});
      INFO(outcome.err);
      CHECK(outcome.status == 0);
      CHECK_THAT(outcome.err, !Contains("MPI"));
    }
}

TEST_CASE("A continuum run writes summary, series, curve, snapshots and the completed scene, and nothing else",
          "[apps]")
{
  const ScratchFolder folder;
  folder.file("x.prm", concrete_beam_scene());
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Control/End=2e-5"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("peak_reaction_load_y") && Contains("UMFPACK") && Contains("balance error"));
  std::vector<std::string> names;
  for (const auto &entry : std::filesystem::directory_iterator(folder / "results"))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  CHECK(names == std::vector<std::string>{"curve.png", "damage.png", "scene.prm", "series.csv", "solid", "solid.pvd",
                                          "summary.json"});

  const nlohmann::json summary = summary_in(folder / "results");
  CHECK(summary["figures"]["peak_reaction_load_y"]["unit"] == "N");
  CHECK(summary["figures"]["peak_reaction_load_y"]["at_opening"].get<double>() > 0);
  for (const char *cost : {"elements", "unknowns", "integration_points", "steps", "newton_iterations", "wall_seconds"})
    CHECK(summary["cost"][cost].get<double>() > 0);
  CHECK_THAT(summary["cost"]["linear_solver"].get<std::string>(), Contains("UMFPACK, "));
  const auto energy = [&](const char *term) { return summary["energy"][term].get<double>(); };
  CHECK(energy("external") == Approx(energy("internal")).epsilon(1e-6)); // Newton's tolerance of 1e-8 over some steps
  CHECK(energy("external") == Approx(energy("stored") + energy("dissipated") + energy("residual")).epsilon(1e-9));
  CHECK(energy("dissipated") == Approx(energy("plasticity") + energy("damage")).epsilon(1e-12));
  CHECK(energy("balance_error") < 2e-3); // of steps of 1e-6 m
  CHECK(summary["energy"]["external"].get<double>() > 0);
  CHECK(summary["scene"] == "x.prm");
  CHECK(summary["requested"]["overrides"][0] == "Control/End=2e-5");
  CHECK_THAT(summary["version"].get<std::string>(), Catch::StartsWith("0."));

  const postprocess::CsvTable series = postprocess::read_csv_table(folder / "results/series.csv");
  for (const char *column : {"load_factor", "iterations", "opening", "reaction_load_y", "reaction_left_support_y",
                             "displacement_left_lip_x", "energy_external", "energy_internal", "energy_stored",
                             "energy_dissipated", "largest_damage", "largest_crack_opening"})
    CHECK_NOTHROW(series.column(column));
  CHECK(series.column("opening").back() == Approx(2e-5).epsilon(1e-9));

  const std::string vtu = content_of(folder / "results/solid/solid_000004.vtu");
  for (const char *field : {"displacement", "reaction", "stress", "strain", "plastic_strain", "kappa_P", "kappa_D",
                            "damage", "crack_opening"})
    CHECK_THAT(vtu, Contains("Name=\"" + std::string(field) + "\""));
  CHECK_THAT(content_of(folder / "results/solid.pvd"), Contains("solid/solid_000000.vtu") && Contains("solid_000004"));
}

TEST_CASE("The completed continuum scene gives the same results to the last bit", "[apps]")
{
  const ScratchFolder folder;
  folder.file("x.prm", concrete_beam_scene());
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "first", "-s", "Control/End=2e-5"}).status == 0);
  const Outcome second = run(folder.path(), {"run", "first/scene.prm", "-o", "second"});
  INFO(second.err);
  REQUIRE(second.status == 0);
  CHECK(content_of(folder / "first/series.csv") == content_of(folder / "second/series.csv"));
  CHECK(listing_of(folder / "first/solid") == listing_of(folder / "second/solid"));
}

TEST_CASE("Two squares of Gmsh in tension stretch in series", "[apps]")
{
  const ScratchFolder folder;
  folder.file("two.msh", two_squares_mesh());
  folder.file("x.prm", two_squares_scene());
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const nlohmann::json summary = summary_in(folder / "results");
  CHECK(figure(summary, "final_displacement_end_x") == Approx(2e6 / 40e9 + 2e6 / 20e9).epsilon(1e-9));
  CHECK(figure(summary, "peak_load_x") == Approx(2e6).epsilon(1e-12));
  CHECK(figure(summary, "peak_reaction_left_x") == Approx(-2e6).epsilon(1e-9));
  CHECK(summary["energy"]["external"].get<double>() == Approx(0.5 * 2e6 * 1.5e-4).epsilon(1e-9));
}

TEST_CASE("A homogenised stiffness stretches a continuum as its compliance says", "[apps]")
{
  const ScratchFolder folder;
  // Orthotropic: D of three decoupled directions of 10, 20 and 30 GPa, shear 4, 5 and 6 GPa.
  nlohmann::json matrix = nlohmann::json::array();
  for (int i = 0; i < 6; ++i)
    {
      nlohmann::json row               = std::vector<double>(6, 0.0);
      row[static_cast<std::size_t>(i)] = i < 3 ? (i + 1) * 10e9 : (i + 1) * 1e9;
      matrix.push_back(row);
    }
  folder.file("homogenised.json", nlohmann::json{{"relaxed", {{"stiffness", matrix}}}}.dump());
  folder.file("x.prm", R"(set Kind = continuum
subsection Model
  set Dimension = 3
  set Remove rigid motion = true
end
subsection Mesh
  set Source = box
  subsection Box
    set Size = 1, 2, 3
    set Divisions z = 2
  end
end
subsection Materials
  subsection solid
    set Law = anisotropic elastic
    subsection anisotropic elastic
      set Stiffness file = homogenised.json
    end
  end
end
subsection Boundary conditions
  subsection bottom
    set Traction y = -1e6*t
  end
  subsection top
    set Pressure = -1e6*t
  end
end
subsection Points
  subsection low
    set Position = 0.3, 0, 1.1
  end
  subsection high
    set Position = 0.3, 2, 1.1
  end
end
)");
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const nlohmann::json summary = summary_in(folder / "results");
  CHECK(figure(summary, "final_displacement_high_y") - figure(summary, "final_displacement_low_y") ==
        Approx(2 * 1e6 / 20e9).epsilon(1e-8));
  // The completed scene names the file by its absolute path.
  CHECK(run(folder.path(), {"run", "results/scene.prm", "-o", "second"}).status == 0);
}

TEST_CASE("A bar against a wall presses with rho c v until the wave comes back", "[apps]")
{
  const ScratchFolder folder;
  folder.file("x.prm", impact_scene());
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const postprocess::CsvTable series = postprocess::read_csv_table(folder / "results/series.csv");
  // Poisson ratio 0: sigma = rho c v, c^2 = E/rho. Mean over the first 90 % of the stay, 2 L/c = 1.98e-4 s.
  const double sigma = std::sqrt(200e9 * 7850) * 10;
  double       mean  = 0;
  for (const double force : series.column("reaction_left_x"))
    mean += force / static_cast<double>(series.rows());
  CHECK(mean == Approx(sigma * 4e-4).epsilon(0.02)); // half an element of the front, 1 %, on both ends
  const nlohmann::json summary = summary_in(folder / "results");
  CHECK(summary["energy"]["balance_error"].get<double>() < 1e-10);
  CHECK(summary["energy"]["start"].get<double>() ==
        Approx(0.5 * 7850 * 0.5 * 4e-4 * 100 * (1 - 0.5 / 50)).epsilon(1e-9));
  for (const char *cost : {"time_step", "critical_step", "point_updates_per_second"})
    CHECK(summary["cost"][cost].get<double>() > 0);
}

TEST_CASE("Point forces stretch as the traction that they replace", "[apps]")
{
  const ScratchFolder folder;
  folder.file("two.msh", two_squares_mesh());
  std::string scene = replaced(two_squares_scene(), "  subsection right\n    set Traction x = 2e6*t\n  end\n", "");
  scene             = replaced(scene, "subsection Points",
                               "subsection Point forces\n  subsection low\n    set Position = 2, 0, 0\n    set Force x = 1e6*t\n"
                                           "  end\n  subsection high\n    set Position = 2, 1, 0\n    set Force x = 1e6*t\n  end\nend\n"
                                           "subsection Points");
  folder.file("x.prm", scene);
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK(figure(summary_in(folder / "results"), "final_displacement_end_x") == Approx(1.5e-4).epsilon(1e-9));
}

TEST_CASE("The linear solver is the requested one, is reported, and gives the same displacement", "[apps]")
{
  const ScratchFolder folder;
  folder.file("two.msh", two_squares_mesh());
  folder.file("x.prm", two_squares_scene());
  const std::pair<const char *, const char *> methods[] = {
    {"direct", "UMFPACK, as requested"}, {"iterative", "conjugate gradients with algebraic multigrid, as requested"}};
  for (const auto &[method, said] : methods)
    {
      REQUIRE(run(folder.path(), {"run", "x.prm", "-o", method, "-s", std::string("Control/Linear solver=") + method})
                .status == 0);
      const nlohmann::json summary = summary_in(folder / method);
      CHECK(summary["cost"]["linear_solver"] == said);
      CHECK(figure(summary, "final_displacement_end_x") == Approx(1.5e-4).epsilon(1e-8));
    }
}

TEST_CASE("A square turned by a right angle in large displacements holds no energy", "[apps]")
{
  const ScratchFolder folder;
  folder.file("two.msh", two_squares_mesh());
  std::string       scene = replaced(two_squares_scene(), "set Plane     = stress", "set Large displacement = true");
  const std::string turn  = "    set Displacement x = x*(cos(pi/2*t) - 1) - y*sin(pi/2*t)\n"
                            "    set Displacement y = x*sin(pi/2*t) + y*(cos(pi/2*t) - 1)\n";
  scene                   = replaced(scene, "    set Displacement x = 0\n    set Displacement y = 0\n", turn);
  scene                   = replaced(scene, "    set Traction x = 2e6*t\n", turn);
  folder.file("x.prm", scene);
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Control/First step=0.1"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const nlohmann::json summary = summary_in(folder / "results");
  CHECK(figure(summary, "final_displacement_end_x") == Approx(-2 - 0.5).epsilon(1e-9));
  CHECK(figure(summary, "final_displacement_end_y") == Approx(2 - 0.5).epsilon(1e-9));
  // A strain of 1e-4 would hold 0.5 * 30e9 * 1e-8 * 2 m^3 = 300 J. Newton stops at 1e-8 of the forces that a turn by 9 degrees
  // brings before the free nodes follow, some 1e9 N: 10 N over the way of a metre bound what the account may carry.
  CHECK(std::fabs(summary["energy"]["internal"].get<double>()) < 1e-5 * 300);
}

TEST_CASE("Arc length: steps of the prescribed length, loads in proportion while elastic", "[apps]")
{
  const ScratchFolder folder;
  folder.file("two.msh", two_squares_mesh());
  folder.file("x.prm", two_squares_scene());
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Control/Follow=arc length", "-s",
                                              "Control/End=1e-3", "-s", "Control/First step=2e-4"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const postprocess::CsvTable series = postprocess::read_csv_table(folder / "results/series.csv");
  REQUIRE(series.rows() == 5);
  // Norm over the nodes: two at x = 1 move by u1 = 5e-5, two at x = 2 by u2 = 1.5e-4 at load factor 1.
  const double norm = std::sqrt(2 * (5e-5 * 5e-5 + 1.5e-4 * 1.5e-4));
  for (std::size_t i = 0; i < 5; ++i)
    {
      CHECK(series.column("arc_length")[i] == Approx(2e-4 * (i + 1.0)).epsilon(1e-12));
      CHECK(series.column("load_factor")[i] == Approx(2e-4 * (i + 1.0) / norm).epsilon(1e-8));
    }
}

TEST_CASE("The summary says by what a run ended", "[apps]")
{
  const ScratchFolder folder;
  folder.file("x.prm", concrete_beam_scene());
  const auto ended_by = [&](const std::vector<std::string> &changes) {
    std::vector<std::string> words = {"run", "x.prm", "-o", "results", "-s", "Output/Snapshots=0"};
    for (const std::string &change : changes)
      words.insert(words.end(), {"-s", change});
    REQUIRE(run(folder.path(), words).status == 0);
    return summary_in(folder / "results")["ended_by"].get<std::string>();
  };
  CHECK(ended_by({"Control/End=1e-5"}) == "end");
  CHECK(ended_by({"Control/Steps at most=3"}) == "steps at most");
  CHECK(ended_by({"Control/Stop fraction=0.9", "Control/Largest step=5e-6"}) == "stop fraction");
}

TEST_CASE("check says what a continuum scene would take, and writes nothing", "[apps]")
{
  const ScratchFolder folder;
  folder.file("x.prm", concrete_beam_scene());
  folder.file("y.prm", impact_scene());
  const std::string before  = listing_of(folder.path());
  const Outcome     statics = run(folder.path(), {"check", "x.prm"});
  CHECK(statics.status == 0);
  CHECK_THAT(statics.out, Contains("x.prm: valid") && Contains("elements") && Contains("unknowns") &&
                            Contains("UMFPACK") && Contains("duration"));
  const Outcome motion = run(folder.path(), {"check", "y.prm"});
  CHECK(motion.status == 0);
  CHECK_THAT(motion.out, Contains("elements     200") && Contains("time step") && Contains("critical"));
  CHECK(listing_of(folder.path()) == before);
}

TEST_CASE("describe shows sections whose names are the scene's choice by a placeholder", "[apps]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), {"describe", "--kind", "continuum"});
  CHECK(outcome.status == 0);
  for (const char *part : {"subsection GROUP", "subsection BOUNDARY", "subsection SUPPORT", "subsection POINT",
                           "Displacement x", "subsection damage-plastic concrete", "Fracture energy"})
    CHECK_THAT(outcome.out, Contains(part));
  CHECK_THAT(run(folder.path(), {"describe", "Control"}).out, Contains("set Follow = time"));
}

TEST_CASE("A static run that finds no equilibrium ends with status 1 and keeps what it found", "[apps][slow]")
{
  const ScratchFolder folder;
  folder.file("x.prm", concrete_beam_scene());
  // Load control cannot pass the peak.
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Control/Follow=time", "-s",
                                              "Supports/load/Displacement y=", "-s", "Control/First step=0.1", "-s",
                                              "Control/Smallest step=1e-3", "-s",
                                              "Boundary conditions/top/Pressure=1e6*t", "-s", "Control/End=1"});
  CHECK(outcome.status == 1);
  CHECK_THAT(outcome.err, Contains("no equilibrium beyond time 0.") && Contains("stands in results/running") &&
                            Contains("set Control/Follow = indirect or arc length"));
  CHECK(std::filesystem::exists(folder / "results/running/series.csv"));
  CHECK(std::filesystem::exists(folder / "results/running/checkpoint.h5"));
}
