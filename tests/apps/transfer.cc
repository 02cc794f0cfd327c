#include "apps/runs/sequential/study.h"
#include "apps/text/value_text.h"
#include "postprocess/files/csv_table.h"
#include "postprocess/hdf5/discrete_state_hdf5.h"
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/gnuplot_scripts.h"
#include "tests/places.h"

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
  const std::string scene = places::sources() + "/apps/scenes/transfer_compression.prm";

  using Arguments = std::vector<std::string>;

  /** The shipped scene made small: some 150 particles, fast. */
  Arguments small(Arguments arguments, const std::string &instants)
  {
    for (const std::string &entry :
         {std::string("Particles/Specimen/Box size=0.011, 0.011, 0.018"),
          std::string("Particles/Specimen/Generator/Cell particles=100"),
          std::string("Particles/Specimen/Generator/Seed=2"), std::string("Particles/Uniaxial/Grip thickness=2.2e-3"),
          std::string("Particles/Uniaxial/Strain rate=8"), std::string("Particles/Uniaxial/End strain=0"),
          std::string("Particles/Uniaxial/Area=nominal"), "Particles/Uniaxial/Instants=" + instants,
          std::string("Continuum/Mesh/Box/Size=0.011, 0.011, 0.018"),
          std::string("Continuum/Boundary conditions/front/Displacement z=-0.018*t"),
          std::string("Continuum/Points/top/Position=0, 0, 0.018"), std::string("Study/Length=0.018"),
          std::string("Study/Area=1.21e-4")})
      {
        arguments.emplace_back("-s");
        arguments.push_back(entry);
      }
    return arguments;
  }

  nlohmann::json summary_of(const std::filesystem::path &folder)
  {
    return nlohmann::json::parse(content_of(folder / "summary.json"));
  }

  /** Contents of a study.csv, but for timings. */
  std::string figures_in(const std::filesystem::path &study)
  {
    const auto  table = postprocess::read_csv_table(study, true);
    std::string text;
    for (const char *column : {"severity", "particle_stress", "peak", "horizontal_at_peak", "dissipated"})
      for (const double value : table.column(column))
        text += std::to_string(value) + " ";
    return text;
  }
} // namespace

TEST_CASE("A crushed specimen is handed over, carried on, and reported in table, figure and ParaView files",
          "[apps][slow]")
{
  const ScratchFolder  folder;
  const GnuplotScripts told(folder.path());
  const Outcome outcome = run(folder.path(), small({"run", scene, "-o", "results", "-s", "Continuum/Control/End=8e-3"},
                                                   "-4e-4, -2.2e-3, -2.2e-3 > -1.5e-3"));
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto results = folder / "results";
  const auto summary = summary_of(results);
  REQUIRE(summary["transfers"].size() == 3);
  for (const auto &transfer : summary["transfers"])
    {
      CHECK(transfer["points"]["all"] == 8);
      CHECK(transfer["points"]["empty"] == 0);
      CHECK(transfer["mean_stress_error"].get<double>() < 1e-12); // the specimen's mean everywhere
      CHECK(transfer["mean_damage_error"].get<double>() < 1e-12);
      CHECK(transfer["imbalance"]["after"]["relative"].get<double>() < 1e-8);
    }
  CHECK_FALSE(summary.contains("warnings")); // the law was found for these particles
  CHECK(summary["identification"]["states_after_peak"].get<int>() > 50);
  CHECK(summary["identification"]["damage_error"].get<double>() < 0.05);
  CHECK(summary["transfers"][0]["points"]["damaged"] == 0);
  CHECK(summary["transfers"][1]["points"]["damaged"] == 8);
  const auto cases = summary["figures"]["cases"];
  CHECK(cases[0]["peak"]["value"].get<double>() == Approx(40e6).epsilon(1e-3)); // f_c: handed over before any damage
  CHECK(cases[1]["peak"]["value"].get<double>() < 36e6);                        // after the peak less is left
  CHECK(cases[1]["peak"]["unit"] == "Pa");
  for (const auto &one : cases)
    {
      CHECK(one["particle_balance_error"].get<double>() < 1e-3);
      CHECK(one["ended_by"] == "stop fraction");
    }
  CHECK_THAT(outcome.out, Contains("peak [Pa]") && Contains("at [-]") && Contains("time [s]") && Contains("ended by"));
  CHECK_THAT(content_of(results / "study.csv"), Contains(",peak [Pa],horizontal_at_peak [-],"));
  // The continuation begins at the particles' own stress, up to the grips' share of the specimen.
  CHECK(std::filesystem::file_size(results / "study.png") > 0);
  CHECK_THAT(told.text(), Contains("set title 'What the continuum still carries'") &&
                            Contains("set xlabel 'Strain reached by the particles [1e-3]'") &&
                            Contains("set ylabel 'Largest stress [MPa]'"));
  const std::string pvd = content_of(results / "transfer.pvd");
  for (const char *part :
       {"name=\"particles\" file=\"transfer/particles_000.vtp\"", "name=\"integration points\"", "name=\"mesh\""})
    CHECK_THAT(pvd, Contains(part));
  CHECK(std::filesystem::exists(results / "transfer/points_002.vtp"));
  CHECK(std::filesystem::exists(results / "continuation_002/solid.pvd"));
  // The mesh as handed over is the first snapshot of the continuation: nothing was transferred twice.
  CHECK_THAT(pvd, Contains("file=\"continuation_002/solid/"));
  CHECK_FALSE(std::filesystem::exists(results / "transfer/mesh_002"));
}

TEST_CASE("A continuation that softens everywhere ends when little force is left, and the table says so",
          "[apps][slow]")
{
  const ScratchFolder folder;
  const auto          carried_on = [&](const std::string &least) {
    const Outcome outcome =
      run(folder.path(), small({"run", scene, "-o", "results", "-s", "Continuum/Control/Stop fraction=0", "-s",
                                "Continuum/Control/End=6e-3", "-s", "Study/Least force=" + least},
                                        "-2.2e-3"));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return outcome.out;
  };
  CHECK_THAT(carried_on("0"), Contains("  end\n"));
  const auto whole = postprocess::read_csv_table(folder / "results/continuation_000/series.csv", true);
  CHECK_THAT(carried_on("0.05"), Contains("  softens everywhere, left at -0.0"));
  const auto one = summary_of(folder / "results")["figures"]["cases"][0];
  CHECK(one["ended_by"] == "softens everywhere");
  CHECK(one["furthest"]["value"].get<double>() > -5e-3);
  // What was computed is what the whole continuation begins with, down to the force at which it ends.
  const auto part  = postprocess::read_csv_table(folder / "results/continuation_000/series.csv", true);
  const auto force = part.column("reaction_front_z"), all = whole.column("reaction_front_z");
  REQUIRE(force.size() < all.size());
  CHECK(std::equal(force.begin(), force.end(), all.begin()));
  const auto   stronger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const double peak     = std::abs(*std::max_element(force.begin(), force.end(), stronger));
  CHECK(std::abs(force.back()) < 0.05 * peak);
  CHECK(std::abs(force[force.size() - 2]) >= 0.05 * peak);
}

TEST_CASE("A study says how far each continuation came that it compares with the particles", "[apps]")
{
  apps::ParticleOutcome all_particles;
  all_particles.curve_strain = {-1e-3, -2e-3, -2.1e-3, -2.2e-3, -4e-3};
  all_particles.curve_stress = {-30e6, -40e6, -36e6, -30e6, -5e6};
  apps::ContinuationCurve early, whole, never;
  early.offset = whole.offset = never.offset = -2e-3;
  early.horizontal                           = {0, -1e-4, -1.5e-4};
  early.vertical                             = {-40e6, -36e6, -30e6};
  early.ended_by                             = "no equilibrium";
  whole.horizontal                           = {0, -1e-3, -2e-3};
  whole.vertical                             = {-40e6, -30e6, -5e6};
  CHECK(apps::near_reaches(early) == Approx(1.075));
  CHECK(apps::near_reaches(whole) == Approx(1.5));
  CHECK(apps::near_reaches(never) == 1);

  const std::vector<apps::ParticleOutcome>   particles(3);
  const std::vector<apps::ContinuationCurve> curves{early, whole, never};
  const apps::SequentialModel                model;
  const apps::StudyReport                    report{model, {"-", "Pa"}, particles, &all_particles, curves};
  const std::string                          text = report.text(), csv = report.csv();
  INFO(text << csv);
  CHECK_THAT(text, Contains("near [-]  up to  ended by"));
  CHECK_THAT(text, Contains("     0.000   1.07  "));
  CHECK_THAT(text, Contains("     0.104   1.50  "));
  CHECK_THAT(csv, Contains("near_reaches"));
  CHECK(report.json()[0]["near_reaches"].get<double>() == Approx(1.075));
}

TEST_CASE("A study warns of continuations that leave the particles, or bear more than these, in words", "[apps]")
{
  apps::ParticleOutcome all_particles, early, late;
  early.name                 = "strain -1e-3";
  late.name                  = "strain -2e-3";
  all_particles.curve_strain = {-1e-3, -2e-3, -3e-3, -4e-3};
  all_particles.curve_stress = {-30e6, -33.8e6, -20e6, -5e6};
  apps::ContinuationCurve good, strong;
  good.offset       = -1e-3;
  good.horizontal   = {0, -1e-3, -2e-3, -3e-3};
  good.vertical     = {-30e6, -35e6, -20e6, -8e6};
  strong.offset     = -2e-3;
  strong.horizontal = {0, -1e-3, -2e-3};
  strong.vertical   = {-34e6, -42e6, -40e6};

  const std::vector<apps::ParticleOutcome>   particles{early, late};
  const std::vector<apps::ContinuationCurve> curves{good, strong};
  const apps::SequentialModel                model;
  const apps::StudyReport                    report{model, {"-", "Pa"}, particles, &all_particles, curves};
  const std::vector<std::string>             warnings = report.warnings();
  REQUIRE(warnings.size() == 2);
  CHECK_THAT(warnings[0], Contains("strain -2e-3: the continuation leaves the particles by 0.97 of the stress"));
  CHECK_THAT(warnings[1], Contains("strain -2e-3: the continuum bears 4.2e+07 Pa where the particles bear 3.38e+07"));
  CHECK_THAT(report.text(), Contains("warning      " + warnings[0]));
}

TEST_CASE("Handed over at the peak and past it, many elements go on within a quarter of the particles' stress",
          "[apps][slow]")
{
  const ScratchFolder folder;
  const std::string   late    = places::sources() + "/apps/scenes/late_transfers.prm";
  const Outcome       outcome = run(folder.path(), {"run", late, "-o", "results", "-s",
                                                    "Particles/Uniaxial/Instants=-1.68655e-3, -2.10819e-3, -2.52982e-3"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto summary = summary_of(folder / "results");
  CHECK_FALSE(summary.contains("warnings"));
  CHECK(summary["identification"]["damage_error"].get<double>() < 0.02);
  for (const auto &one : summary["figures"]["cases"])
    {
      INFO(one.dump(1));
      CHECK(one["ended_by"] == "end");
      CHECK(one["error_near"].get<double>() < 0.25);
      CHECK(one["near_reaches"] == 1.5);
    }
  CHECK_THAT(outcome.out, Contains("near [-]"));
  const double filled = summary["transfers"][0]["volume"]["filled"];
  CHECK(filled > 0.7); // 1 mm spheres leave a rim of the box around them empty
  CHECK(filled < 0.9);
}

TEST_CASE("A state that was saved is transferred as in the run that saved it", "[apps][slow]")
{
  const ScratchFolder folder;
  const std::string   published =
    "Transfer/Mapping law/Law=default"; // saved states cannot be strained to identify another
  REQUIRE(run(folder.path(), small({"transfer", scene, "-o", "first", "-s", published}, "-2.2e-3")).status == 0);
  CHECK_FALSE(std::filesystem::exists(folder / "first/continuation_000"));
  Arguments arguments = small({"transfer", scene, "-o", "again", "-s", published}, "-2.2e-3");
  arguments.insert(arguments.end(), {"-s", "Particles/Source=file", "-s", "Particles/Files=first/states/state_000.h5"});
  const Outcome again = run(folder.path(), arguments);
  INFO(again.err);
  REQUIRE(again.status == 0);
  auto first = summary_of(folder / "first")["transfers"][0], second = summary_of(folder / "again")["transfers"][0];
  first.erase("event");
  second.erase("event");
  CHECK(first == second);
}

TEST_CASE("The mapping law is identified from the particle run and one element, and fits better than the published one",
          "[apps][slow]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), small({"transfer", "--identify", scene, "-o", "law"}, "-1e-3"));
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto found = summary_of(folder / "law")["identification"];
  CHECK(found["states_after_peak"].get<int>() > 50);
  CHECK(found["damage_error"].get<double>() < 0.05);
  CHECK_THAT(outcome.out, Contains("set Law             = own") &&
                            Contains("set Identified for  = compression, particles ") &&
                            Contains(", damage-plastic concrete "));
  CHECK(std::filesystem::file_size(folder / "law/identified.png") > 0);
  CHECK_FALSE(std::filesystem::exists(folder / "law/states/state_000.h5")); // only the law was requested

  // Its constants in place of the search give the same run; with other particles or another concrete they are doubted.
  const auto with_law = [&](Arguments changes) {
    Arguments   arguments = small({"check", scene}, "-2.2e-3");
    const auto &law       = found["law"];
    const auto  number    = [](const nlohmann::json &n) { return n.dump(); };
    for (const std::string &entry :
         {std::string("Law=own"),
          "Weights=" + number(law["weights"][0]) + "," + number(law["weights"][1]) + "," + number(law["weights"][2]),
          "Factor=" + number(law["factor"]), "Exponent=" + number(law["exponent"]),
          "Hardening start=" + number(law["hardening_start"]), "Hardening slope=" + number(law["hardening_slope"]),
          "Identified for=" + found["identified_for"].get<std::string>()})
      {
        arguments.emplace_back("-s");
        arguments.push_back("Transfer/Mapping law/" + entry);
      }
    for (const std::string &change : changes)
      {
        arguments.emplace_back("-s");
        arguments.push_back(change);
      }
    const Outcome checked = run(folder.path(), arguments);
    INFO(checked.err);
    CHECK(checked.status == 0);
    return checked.out;
  };
  CHECK_THAT(with_law({}), !Contains("warning"));
  // The same material in another amount, and elements of another size.
  CHECK_THAT(with_law({"Particles/Specimen/Density=2400", "Particles/Specimen/Generator/Seed=7",
                       "Continuum/Materials/solid/damage-plastic concrete/Element size=1"}),
             !Contains("warning"));
  CHECK_THAT(with_law({"Particles/Material/CPM/Cohesion=4e6"}), Contains("identified for other particles"));
  CHECK_THAT(with_law({"Particles/Specimen/Generator/Friction coefficient=0.1"}),
             Contains("identified for other particles"));
  CHECK_THAT(with_law({"Continuum/Materials/solid/damage-plastic concrete/Compressive strength=50e6"}),
             Contains("identified for another damage-plastic concrete"));
  CHECK_THAT(with_law({"Particles/Uniaxial/Instants=1e-4"}),
             Contains("identified in compression") && Contains("tension"));
}

TEST_CASE("A law that was not identified for these particles is doubted aloud, in check and in every run",
          "[apps][slow]")
{
  const ScratchFolder folder;
  const std::string   published = "Transfer/Mapping law/Law=default";
  const Outcome       checked   = run(folder.path(), small({"check", scene, "-s", published}, "-1e-3"));
  INFO(checked.err);
  REQUIRE(checked.status == 0);
  CHECK_THAT(checked.out,
             Contains("warning") && Contains("belongs to the published particles") && Contains("Law = identify"));
  const Outcome outcome = run(folder.path(), small({"transfer", scene, "-o", "results", "-s", published}, "-1e-3"));
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.err, Contains("warning: the mapping law \"default\" belongs to the published particles"));
  CHECK(summary_of(folder / "results")["warnings"].size() == 1);
}

TEST_CASE("An interrupted sequential run leaves its states and goes on to the same results", "[apps][slow][S13]")
{
  const ScratchFolder folder;
  const auto          all_of_it = [](const std::filesystem::path &results) {
    std::string text = figures_in(results / "study.csv");
    for (const char *k : {"000", "001", "002"})
      text += content_of(results / (std::string("continuation_") + k) / "series.csv");
    return text;
  };
  goes_on_to_the_same_bits(
    folder, {small({"run", scene}, "-8e-4, -1.6e-3, -2.2e-3"), {"states/state_001_figures.h5"}, all_of_it, false},
    {SIGINT});
}

TEST_CASE("Mesh, length, area and columns that do not belong to the particles are refused before anything runs",
          "[apps][S14][slow]")
{
  const ScratchFolder folder;
  const auto          refusal = [&](const char *command, const Arguments &overrides) {
    Arguments arguments = small({command, scene}, "-1e-3");
    if (std::string(command) != "check")
      arguments.insert(arguments.end(), {"-o", "results"});
    for (const std::string &entry : overrides)
      arguments.insert(arguments.end(), {"-s", entry});
    const Outcome outcome = run(folder.path(), arguments);
    CHECK(outcome.status == 2);
    CHECK_FALSE(std::filesystem::exists(folder / "results")); // nothing was begun
    return outcome.err;
  };
  for (const char *command : {"check", "run", "transfer"})
    {
      CAPTURE(command);
      CHECK_THAT(refusal(command, {"Study/Horizontal=displacement_tip_z"}),
                 Contains("Horizontal = displacement_tip_z: the continuation's series has no such column") &&
                   Contains("Did you mean \"displacement_top_z\"?"));
      CHECK_THAT(refusal(command, {"Study/Vertical=reaction_front_y"}), Contains("no such column"));
      CHECK_THAT(refusal(command, {"Study/Area=4.41e-4"}),
                 Contains("Area = 4.41e-4: the mesh has a mean section of 0.000121 m^2 across z"));
    }
  CHECK_THAT(refusal("run", {"Study/Area=1"}), Contains("mean section of 0.000121 m^2"));
  CHECK_THAT(refusal("run", {"Particles/Uniaxial/Area=3.82e-4"}),
             Contains("Particles/Uniaxial/Area = 0.000382: across z the box around the specimen has"));
  CHECK_THAT(refusal("run", {"Study/Length=0.04"}), Contains("Length = 0.04: the mesh is 0.018 m long along z"));
  CHECK_THAT(refusal("run", {"Study/Horizontal=displacement_top_x"}), Contains("the particles are strained along z"));
  // A mesh of the size of another specimen: 50 MPa for a concrete of 40, with forces of one over the area of the other.
  CHECK_THAT(refusal("run", {"Continuum/Mesh/Box/Size=0.018, 0.018, 0.018"}),
             Contains("transfer: along x the specimen reaches from") && Contains("and the mesh from 0 to 0.018 m"));
  CHECK_THAT(
    refusal("check", {"Continuum/Mesh/Box/Size=0.011, 0.011, 0.04", "Continuum/Points/top/Position=0, 0, 0.04"}),
    Contains("along z the specimen") && Contains("to 0.04 m"));
  // One message that says what is wrong with a strength in MPa.
  CHECK_THAT(refusal("check", {"Continuum/Materials/solid/damage-plastic concrete/Tensile strength=3"}),
             Contains("Tensile strength = 3: no solid is so weak. In MPa?"));
}

TEST_CASE("A saved state is held against the mesh too, and one with stresses in another unit is refused",
          "[apps][slow][S14]")
{
  const ScratchFolder folder;
  REQUIRE(run(folder.path(), small({"transfer", scene, "-o", "first"}, "-2.2e-3")).status == 0);
  const auto state = folder / "first/states/state_000.h5";
  const auto with  = [&](const std::filesystem::path &file, const Arguments &overrides) {
    Arguments arguments = small({"run", scene, "-o", "again"}, "-2.2e-3");
    arguments.insert(arguments.end(), {"-s", "Transfer/Mapping law/Law=default", "-s", "Particles/Source=file", "-s",
                                       "Particles/Files=" + file.string()});
    for (const std::string &entry : overrides)
      arguments.insert(arguments.end(), {"-s", entry});
    return run(folder.path(), arguments);
  };
  const Outcome larger = with(state, {"Continuum/Mesh/Box/Size=0.04, 0.04, 0.018"});
  CHECK(larger.status == 2);
  CHECK_THAT(larger.err, Contains("along x " + state.string() + " reaches from") && Contains("0 to 0.04 m"));

  dem::DiscreteState scaled = postprocess::read_discrete_state(state);
  for (Eigen::Matrix3d &stress : scaled.stress)
    stress *= 1000;
  postprocess::write_discrete_state(scaled, folder / "scaled.h5");
  const Outcome outside = with(folder / "scaled.h5", {});
  CHECK(outside.status == 2);
  CHECK_THAT(outside.err, Contains("scaled.h5: transfer:") && Contains("so far outside the yield surface") &&
                            Contains("allows a share of 0.2"));
  CHECK_FALSE(std::filesystem::exists(folder / "again/summary.json"));
}

TEST_CASE("Sequential scenes with mistakes are refused with the place and what would be right", "[apps][S14]")
{
  const ScratchFolder folder;
  const auto          refusal = [&](const Arguments &overrides, const std::string &command = "run") {
    Arguments arguments = {command, scene, "-o", "results"};
    for (const std::string &entry : overrides)
      arguments.insert(arguments.end(), {"-s", entry});
    const Outcome outcome = run(folder.path(), arguments);
    CHECK(outcome.status == 2);
    CHECK_FALSE(std::filesystem::exists(folder / "results/summary.json"));
    return outcome.err;
  };
  CHECK_THAT(refusal({"Particles/Uniaxial/Instants=-1e-3, once"}),
             Contains("Instants") && Contains("separated by commas"));
  CHECK_THAT(refusal({"Particles/Uniaxial/Instants=-1e-3, 2e-3"}), Contains("one sign"));
  CHECK_THAT(refusal({"Particles/Uniaxial/Instants=-1e-3 > -2e-3"}), Contains("Instants"));
  CHECK_THAT(refusal({"Transfer/Mapping law/Law=legacy"}),
             Contains("Did you mean \"legacy12\"?") || Contains("legacy12"));
  CHECK_THAT(refusal({"Transfer/Mapping law/Law=own", "Transfer/Mapping law/Weights=0.8, 0, 0.2",
                      "Transfer/Mapping law/Hardening slope=1e5"}),
             Contains("must stay below 1"));
  CHECK_THAT(refusal({"Transfer/Mapping law/Law=own", "Transfer/Mapping law/Weights=0.8, 0, 0.2",
                      "Transfer/Mapping law/Identified for=my particles"}),
             Contains("Identified for = my particles") && Contains("breccia transfer --identify"));
  CHECK_THAT(refusal({"Continuum/Model/Analysis=explicit", "Continuum/Materials/solid/Density=2400",
                      "Continuum/Motion/End time=1"}),
             Contains("Analysis") && Contains("static"));
  CHECK_THAT(refusal({"Continuum/Model/Dimension=2"}), Contains("Dimension"));
  const std::string published = "Transfer/Mapping law/Law=default";
  CHECK_THAT(refusal({"Particles/Source=file", "Particles/Files=none.h5", published}), Contains("none.h5"));
  folder.file("text.h5", "no HDF5");
  CHECK_THAT(refusal({"Particles/Source=file", "Particles/Files=text.h5", published}), Contains("text.h5"));
  CHECK_THAT(refusal({"Particles/Source=file", "Particles/Files=none.h5"}),
             Contains("Law = identify: saved states do not say what their particles are made of"));
  const Outcome other = run(folder.path(), {"transfer", places::sources() + "/apps/scenes/quick_uniaxial.prm"});
  CHECK(other.status == 2);
  CHECK_THAT(other.err, Contains("Kind = uniaxial: a transfer wants a scene of kind sequential"));
}

TEST_CASE("A transfer past its limits is refused", "[apps][slow][S14]")
{
  const ScratchFolder folder;
  const Outcome       outcome =
    run(folder.path(), small({"run", scene, "-o", "results", "-s", "Transfer/Limits/Imbalance=1e-6"}, "-2.2e-3"));
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains("out of balance by") && Contains("the scene allows 1e-06"));
  CHECK_FALSE(std::filesystem::exists(folder / "results/summary.json"));
  // The particles need not run again for another limit.
  const Outcome resumed = run(folder.path(), small({"run", scene, "-o", "results", "--resume"}, "-2.2e-3"));
  INFO(resumed.err);
  CHECK(resumed.status == 0);
  CHECK(std::filesystem::exists(folder / "results/summary.json"));
}

TEST_CASE("bench sequential reports error and cost of every kernel and mesh", "[apps][slow]")
{
  const ScratchFolder folder;
  Arguments           arguments = small({"bench", "sequential", scene, "--quick", "-o", "bench"}, "-1e-3, -2.2e-3");
  arguments.insert(arguments.end(), {"-s", "Particles/Uniaxial/End strain=-3e-3"});
  const Outcome outcome = run(folder.path(), arguments);
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  std::istringstream csv(content_of(folder / "bench/sequential.csv"));
  std::string        line;
  std::getline(csv, line);
  int rows = 0;
  while (std::getline(csv, line))
    {
      INFO(line);
      ++rows;
      const auto fields = apps::comma_separated(line);
      REQUIRE(fields.size() == 9); // error over all that follows, and near the transfer, and how far that comes
      const auto error = apps::number_in(fields[4]), reaches = apps::number_in(fields[6]);
      REQUIRE(reaches);
      if (apps::number_in(fields[5]))
        CHECK((*reaches > 1 && *reaches <= 1.5));
      if (error)
        CHECK((*error > 0 && *error < 2));
      // Single particles, and the few within a narrow ball, are refused; past its peak a field may find no way on over several
      // elements. Then there is no error to show.
      const std::string &variant     = fields[1];
      const bool         before_peak = fields[2] == "-0.001", may_fail = variant == "nearest" || variant == "ball 3 r";
      if (before_peak && !may_fail)
        CHECK(error);
    }
  CHECK(rows == 14); // five kernels and two meshes, two instants each
  CHECK(std::filesystem::file_size(folder / "bench/sequential.png") > 0);
  CHECK_THAT(content_of(folder / "bench/sequential.md"), Contains("| kernel | moving least squares 3 r |"));
}
