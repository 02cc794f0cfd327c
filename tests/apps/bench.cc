#include "apps/text/value_text.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string small_generated_scene()
  {
    std::string scene = replaced(scene_with_file(), "Source            = file",
                                 "Source = generator\n  set Box size = 0.014, 0.014, 0.02");
    scene             = replaced(scene, "  set File              = packing.txt\n", "");
    scene             = replaced(scene, "set Grip thickness = 0.5e-3", "set Grip thickness = 2.2e-3");
    return scene + "subsection Specimen\n  subsection Generator\n    set Particle radius = 1e-3\n    set Cell "
                   "particles = 200\n    set Faces = cut\n  end\nend\n";
  }
} // namespace

TEST_CASE("bench uniaxial writes a row per case with a reference per study", "[apps][slow]")
{
  const ScratchFolder folder;
  folder.file("x.prm", small_generated_scene());
  const Outcome outcome = run(folder.path(), {"bench", "uniaxial", "x.prm", "--quick", "-o", "bench"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  std::istringstream csv(content_of(folder / "bench/uniaxial.csv"));
  std::string        line;
  REQUIRE(std::getline(csv, line));
  const auto commas = std::count(line.begin(), line.end(), ',');
  int        rows = 0, references = 0;
  while (std::getline(csv, line))
    {
      ++rows;
      CHECK(std::count(line.begin(), line.end(), ',') == commas);
      const std::vector<std::string> fields = apps::comma_separated(line);
      REQUIRE(fields.size() > 8);
      references += fields[3] == "1" ? 1 : 0;
      for (std::size_t i = 8; i < fields.size(); ++i)
        CHECK(apps::number_in(fields[i]).has_value()); // a figure or an error, finite
    }
  CHECK(rows == 10);
  CHECK(references == 3);
  for (const char *study : {"time step", "loading rate", "particle size"})
    CHECK_THAT(content_of(folder / "bench/uniaxial.md"), Contains(study));
  CHECK(std::filesystem::file_size(folder / "bench/uniaxial.png") > 0);
}

TEST_CASE("bench calibration: updates and a cheap model save runs beside plain differences", "[apps]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), {"bench", "calibration", "-o", "bench"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  std::istringstream                                        csv(content_of(folder / "bench/calibration.csv"));
  std::map<std::string, std::map<std::string, std::string>> needed;
  std::string                                               line;
  std::getline(csv, line);
  CHECK(line == "problem,method,runs_needed,runs,nearest [%]");
  while (std::getline(csv, line))
    {
      std::istringstream       cells(line);
      std::vector<std::string> all;
      for (std::string cell; std::getline(cells, cell, ',');)
        all.push_back(cell);
      REQUIRE(all.size() == 5);
      needed[all[0]][all[1]] = all[2];
    }
  CHECK(needed.size() == 4);
  for (const std::string problem : {"curve", "two curves", "figures"})
    {
      INFO(problem);
      const double plain = std::stod(needed[problem]["differences"]);
      CHECK(std::stod(needed[problem]["updated differences"]) <= plain);
      CHECK(std::stod(needed[problem]["after a cheap model"]) < plain);
    }
  CHECK(std::filesystem::file_size(folder / "bench/calibration.png") > 0);

  std::istringstream coverage(content_of(folder / "bench/calibration_coverage.csv"));
  std::getline(coverage, line);
  CHECK(line == "scatter_of_runs,deviation_known,constant,inside [%],by_residuals [%],rough [%]");
  int constants = 0;
  while (std::getline(coverage, line))
    {
      INFO(line);
      std::istringstream       cells(line);
      std::vector<std::string> all;
      for (std::string cell; std::getline(cells, cell, ',');)
        all.push_back(cell);
      REQUIRE(all.size() == 6);
      CHECK(std::stod(all[3]) >= 92);
      CHECK(std::stod(all[3]) <= 98);
      ++constants;
    }
  CHECK(constants == 18); // three, of smooth, rough and very rough runs, with a known deviation and without
}

TEST_CASE("bench uniaxial refuses a scene that it cannot vary", "[apps][S14]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", pair_packing());
  folder.file("x.prm", scene_with_file());
  const Outcome outcome = run(folder.path(), {"bench", "uniaxial", "x.prm", "-o", "bench"});
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err,
             Contains("x.prm: Specimen/Source = file: this bench varies the particle size and needs the generator"));
  CHECK_FALSE(std::filesystem::exists(folder / "bench"));
}

TEST_CASE("bench continuum: errors fall with the order of the element, whatever the solver", "[apps][slow]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), {"bench", "continuum", "--quick", "-o", "bench"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  std::istringstream                         csv(content_of(folder / "bench/continuum.csv"));
  std::string                                line;
  std::map<std::string, std::vector<double>> errors; // of an element and solver, over the divisions
  std::getline(csv, line);
  while (std::getline(csv, line))
    {
      const std::vector<std::string> fields = apps::comma_separated(line);
      REQUIRE(fields.size() == 7);
      errors[fields[0] + " " + fields[1]].push_back(apps::number_in(fields[6]).value());
    }
  CHECK(errors.size() == 10);
  // Two halvings of linear elements, one of quadratic: observed orders 2 and 3 at these sizes to 0.3.
  const std::vector<double> linear = errors["Q1 geometric multigrid"], quadratic = errors["Q2 geometric multigrid"];
  REQUIRE(linear.size() == 3);
  REQUIRE(quadratic.size() == 2);
  CHECK(std::log2(linear[1] / linear[2]) == Approx(2).margin(0.3));
  CHECK(std::log2(quadratic[0] / quadratic[1]) == Approx(3).margin(0.3));
  CHECK(errors["Q1 direct"][1] == Approx(linear[1]).epsilon(1e-6));
  CHECK(errors["Q1 algebraic multigrid"][1] == Approx(linear[1]).epsilon(1e-6));
  for (const char *operation : {"assembly", "product", "solver iteration", "whole solution", "explicit step"})
    CHECK_THAT(content_of(folder / "bench/continuum_rates.csv"), Contains(operation));
  CHECK_THAT(content_of(folder / "bench/continuum_ranks.csv"), Contains("1,4096,14739,"));
  CHECK(std::filesystem::file_size(folder / "bench/continuum.png") > 0);
}

namespace
{
  /** Rows of a table, fields by the name of their column (its unit left out). */
  std::vector<std::map<std::string, std::string>> table(const std::filesystem::path &file)
  {
    std::istringstream csv(content_of(file));
    std::string        line;
    std::getline(csv, line);
    std::vector<std::string> names = apps::comma_separated(line);
    for (std::string &name : names)
      name = name.substr(0, name.find(' '));
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(csv, line))
      {
        const auto fields = apps::comma_separated(line);
        rows.emplace_back();
        for (std::size_t i = 0; i < names.size(); ++i)
          rows.back()[names[i]] = fields.at(i);
      }
    return rows;
  }
} // namespace

namespace
{
  /** Momenta of every row, to rounding; energies that no account contains, below a bound. */
  void check_conservation(const std::filesystem::path &file, const std::size_t rows)
  {
    auto found = table(file);
    CHECK(found.size() == rows);
    for (auto &row : found)
      {
        INFO(row["method"] << ", " << row["motion"] << ": momentum " << row["momentum"] << ", angular momentum "
                           << row["angular_momentum"] << ", energy " << row["energy"] << " of order " << row["order"]);
        CHECK(row["kept"] == "yes");
        CHECK(apps::number_in(row["momentum"]).value() <= 1e-12);
        CHECK(apps::number_in(row["angular_momentum"]).value() <= 1e-12);
        const double energy = apps::number_in(row["energy"]).value(),
                     half   = apps::number_in(row["energy_at_half"]).value();
        // A point that slides over an edge passes from face to face whatever the step; the penalty is no slope of an energy.
        const std::string method  = row["method"];
        const bool        surface = method.find("surface") != std::string::npos;
        CHECK(half < (method.find("penalty") != std::string::npos           ? 0.05 :
                      surface || method.find("bodies") != std::string::npos ? 2e-3 :
                                                                              std::max(0.6 * energy, 1e-9)));
      }
  }
} // namespace

TEST_CASE(
  "bench conservation: one way of coupling of each kind keeps both momenta, and energy the better the smaller the step",
  "[apps][slow]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), {"bench", "conservation", "--quick", "-o", "bench"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  check_conservation(folder / "bench/conservation.csv", 6);
  CHECK_THAT(content_of(folder / "bench/conservation.md"), Contains("| Both to 1e-12 |"));
}

TEST_CASE("bench conservation: every way of coupling keeps both momenta of every motion to rounding", "[apps][slow]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), {"bench", "conservation", "-o", "bench"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  check_conservation(folder / "bench/conservation.csv", 80);
}

TEST_CASE("bench homogenise: every way tends to the direct answer as its tolerance falls", "[apps][slow]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), {"bench", "homogenise", "--quick", "-o", "bench"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  std::map<std::string, std::vector<double>> errors; // by cell and solver, in the order of falling tolerances
  int                                        seeds = 0;
  for (auto &row : table(folder / "bench/homogenise.csv"))
    {
      REQUIRE(apps::number_in(row["cost"]).has_value());
      if (row["study"] == "solver")
        errors[row["particles"] + " " + row["solver"]].push_back(*apps::number_in(row["error"]));
      else
        ++seeds;
    }
  CHECK(seeds == 2);
  REQUIRE(errors.size() == 8);
  for (const auto &[which, error] : errors)
    {
      INFO(which << ": " << error.front() << " ... " << error.back());
      CHECK(error.back() <= error.front());
      // Tolerance 1e-10 of forces gives the energy to its square, 1e-6 of the dynamic ones to 1e-5; finite strain of the specimen 1e-5.
      CHECK(error.back() < (which.find("direct") + 1 || which.find("iterative") + 1 ? 1e-12 : 1e-4));
    }
  CHECK_THAT(content_of(folder / "bench/homogenise.md"), Contains("| solver | specimen |"));
  CHECK(std::filesystem::file_size(folder / "bench/homogenise.png") > 0);
}

TEST_CASE("bench quasi-static: dynamic strengths fall towards the static one", "[apps][slow]")
{
  const ScratchFolder folder;
  const std::string   scene   = places::sources() + "/apps/scenes/concrete_uniaxial.prm";
  const Outcome       outcome = run(folder.path(), {"bench", "quasi-static", scene, "--quick", "-o", "bench"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  std::vector<double> over;
  for (auto &row : table(folder / "bench/quasi_static.csv"))
    over.push_back(*apps::number_in(row["over_static"]));
  REQUIRE(over.size() == 4);
  CHECK(over[0] == 1);
  CHECK(std::fabs(over[2] - 1) < std::fabs(over[1] - 1));
  CHECK(std::fabs(over[3] - 1) < std::fabs(over[2] - 1));
  CHECK(over[3] == Approx(1).epsilon(0.02));
  CHECK(std::filesystem::file_size(folder / "bench/quasi_static.png") > 0);
}

TEST_CASE("bench quasi-static takes its material from the scene, and refuses a scene of another kind", "[apps][slow]")
{
  const ScratchFolder folder;
  const std::string   scenes = places::sources() + "/apps/scenes/";
  // Of one packing E is in proportion to that of its links.
  const auto modulus_with = [&](const std::string &of_links) {
    const Outcome outcome =
      run(folder.path(), {"bench", "quasi-static", scenes + "concrete_uniaxial.prm", "--quick", "--rates", "30", "-s",
                          "Material/CPM/Normal modulus=" + of_links, "-o", of_links});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return *apps::number_in(table(folder / of_links / "quasi_static.csv").front()["young_modulus"]);
  };
  CHECK(modulus_with("12.5e9") == Approx(0.5 * modulus_with("25e9")).epsilon(0.01));
  const Outcome refused =
    run(folder.path(), {"bench", "quasi-static", scenes + "bouncing_sphere.prm", "--quick", "-o", "bench"});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("Kind = particles: this bench needs a scene of kind uniaxial"));
  CHECK_FALSE(std::filesystem::exists(folder / "bench"));
}

TEST_CASE("bench mortar crushes a grown specimen faster and slower, and has its modulus in equilibrium", "[apps][slow]")
{
  const ScratchFolder folder;
  const std::string   scenes = places::sources() + "/apps/scenes/";
  const Outcome outcome = run(folder.path(), {"bench", "mortar", scenes + "mortar_window.prm", "--quick", "-o", "bench",
                                              "-s", "Specimen/Genesis/Size=0.01, 0.02, 0", "-s",
                                              "Specimen/Genesis/Friction coefficient=0.1", "--static-strength"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto rows   = table(folder / "bench/mortar.csv");
  const auto number = [&](const std::size_t row, const char *column) {
    return *apps::number_in(rows.at(row).at(column));
  };
  REQUIRE(rows.size() == 4);
  CHECK(rows[1].at("strength").empty());
  CHECK(number(1, "modulus") == Approx(number(0, "modulus")).epsilon(0.2)); // half-way to the peak some have broken
  // Along equilibria bonds break that neither speed nor damping holds up; until then they are the same network.
  CHECK(number(2, "strength") < number(0, "strength"));
  CHECK(number(2, "strength") > 0.3 * number(0, "strength"));
  CHECK(number(2, "modulus") < number(1, "modulus") * (1 + 1e-9));
  CHECK(number(2, "modulus") > 0.7 * number(1, "modulus"));
  CHECK(number(3, "strength") > number(0, "strength"));
  for (const std::size_t row : {0, 3})
    CHECK(number(row, "balance_error") < 1e-3);
  const Outcome refused =
    run(folder.path(), {"bench", "mortar", scenes + "rock_compression.prm", "--quick", "-o", "none"});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("Specimen/Source: this bench needs genesis"));
}

TEST_CASE("bench mortar --constants has the published signs of what breaks, and E by the joints' modulus",
          "[apps][slow]")
{
  const ScratchFolder folder;
  const Outcome       outcome =
    run(folder.path(), {"bench", "mortar", places::sources() + "/apps/scenes/mortar_window.prm", "--constants",
                        "--quick", "-o", "bench", "-s", "Specimen/Genesis/Size=0.015, 0.03, 0"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  std::map<std::string, std::vector<double>> strength, modulus; // by constant, at 0.25, 1 and 1.5
  for (const auto &row : table(folder / "bench/constants.csv"))
    {
      CHECK(row.at("reading") == "as named");
      strength[row.at("constant")].push_back(*apps::number_in(row.at("strength")));
      modulus[row.at("constant")].push_back(*apps::number_in(row.at("modulus")));
    }
  REQUIRE(strength.size() == 8);
  for (const auto &[constant, values] : strength)
    {
      INFO(constant);
      REQUIRE(values.size() == 3);
      CHECK(values[1] == strength["c"][1]); // the scene itself
    }
  // Published: cohesion raises the peak, tensile strength and the angle of friction too.
  CHECK(strength["c"][0] < 0.7 * strength["c"][1]);
  CHECK(strength["c"][2] > strength["c"][1]);
  for (const char *slightly : {"sigma_c", "phi"})
    {
      INFO(slightly);
      CHECK(strength[slightly][2] > strength[slightly][0]);
    }
  // What is published of linear contacts the joints do here: E is proportional to their modulus, and falls with their ratio.
  CHECK(modulus["E_FJ"][0] == Approx(0.25 * modulus["E_FJ"][1]).epsilon(0.15));
  CHECK(modulus["kbar_rat"][2] < modulus["kbar_rat"][0]);
  CHECK(modulus["E_LC"][0] == Approx(modulus["E_LC"][1]).epsilon(0.1));
  CHECK_THAT(content_of(folder / "bench/constants.md"),
             Contains("| c | Cohesion |") && Contains("| raises the peak | yes |"));
  CHECK(std::filesystem::file_size(folder / "bench/constants.png") > 0);
}

TEST_CASE("bench surface: errors of an impact fall with the elements", "[apps][slow]")
{
  const ScratchFolder folder;
  const std::string   scenes  = places::sources() + "/apps/scenes/";
  const Outcome       outcome = run(folder.path(), {"bench", "surface", scenes + "hertz_impact.prm",
                                                    scenes + "colliding_balls.prm", "--quick", "-o", "bench"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  std::istringstream csv(content_of(folder / "bench/surface.csv"));
  std::string        line;
  REQUIRE(std::getline(csv, line));
  std::map<std::string, std::vector<double>> force; // errors by study
  while (std::getline(csv, line))
    {
      const std::vector<std::string> fields = apps::comma_separated(line);
      REQUIRE(fields.size() == 9);
      for (std::size_t i = 2; i < fields.size(); ++i)
        REQUIRE(apps::number_in(fields[i]).has_value());
      force[fields[0]].push_back(std::fabs(*apps::number_in(fields[3])));
    }
  REQUIRE(force["mesh"].size() == 2);
  CHECK(force["mesh"][1] < force["mesh"][0]);
  CHECK(force["mesh"][0] < 0.1);
  CHECK(force["sub-cycling"].size() == 3);
  CHECK(force["solid sub-cycled"].size() == 3);
  REQUIRE(force["spreading"].size() == 3);
  CHECK(force["spreading"][1] == force["spreading"][2]); // the ball is larger than the smallest face
  CHECK(force["spreading"][1] != force["spreading"][0]);
  CHECK(force["point"].size() == 2);
  REQUIRE(force["balls"].size() == 1);
  CHECK(force["balls"][0] < 0.05);
  CHECK(std::filesystem::file_size(folder / "bench/surface.png") > 0);
}

TEST_CASE("bench surface refuses a scene without known answers", "[apps][S14]")
{
  const ScratchFolder folder;
  const std::string   scene   = places::sources() + "/apps/scenes/gravel_on_slab.prm";
  const Outcome       outcome = run(folder.path(), {"bench", "surface", scene, "-o", "bench"});
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains("References: this bench needs Peak force and Contact time"));
  CHECK_FALSE(std::filesystem::exists(folder / "bench"));
}

TEST_CASE(
  "bench multiscale: cells where needed are cheaper than everywhere, in motion as accurate as they are driven slowly",
  "[apps][cells][slow]")
{
  const ScratchFolder folder;
  const std::string   scenes  = places::sources() + "/apps/scenes/";
  const Outcome       outcome = run(folder.path(), {"bench", "multiscale", scenes + "cells_in_beam.prm", "--plate",
                                                    scenes + "cells_at_hole.prm", "--quick", "-o", "bench"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  std::istringstream                         csv(content_of(folder / "bench/multiscale.csv"));
  std::string                                line;
  std::map<std::string, std::vector<double>> errors;
  std::getline(csv, line);
  while (std::getline(csv, line))
    {
      const std::vector<std::string> fields = apps::comma_separated(line);
      REQUIRE(fields.size() == 7);
      errors[fields[0]].push_back(apps::number_in(fields[5]).value());
    }
  REQUIRE(errors["promotion"].size() == 1);
  CHECK(errors["promotion"][0] < 1e-6);
  REQUIRE(errors["in motion"].size() == 2);
  CHECK(errors["in motion"][1] < errors["in motion"][0]); // driven slower
  CHECK(errors["in motion"][1] < 0.05);
  CHECK(std::filesystem::file_size(folder / "bench/multiscale.png") > 0);
}

TEST_CASE("bench structure: a factor and an iteration find the same forces of a beam with a core", "[apps][slow]")
{
  const ScratchFolder folder;
  const std::string   scenes  = places::sources() + "/apps/scenes/";
  const Outcome       outcome = run(folder.path(), {"bench", "structure", scenes + "bending_of_particles.prm",
                                                    scenes + "bending_with_core.prm", "--solvers", "--quick", "-o", "bench"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  auto rows = table(folder / "bench/structure_solvers.csv");
  REQUIRE(rows.size() == 1);
  CHECK(*apps::number_in(rows.front()["particles"]) == 415);
  CHECK(*apps::number_in(rows.front()["points"]) > 4);
  CHECK(*apps::number_in(rows.front()["forces differ by"]) < 1e-5);
  CHECK(std::filesystem::file_size(folder / "bench/structure_solvers.png") > 0);
}
