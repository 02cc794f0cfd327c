// Section Laboratory of scenes of kind "particles", through the program: the shipped tests on rock, refusals, resuming.
#include "postprocess/files/csv_table.h"
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <iomanip>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string rock(const char *name) { return places::sources() + "/apps/scenes/rock_" + name + ".prm"; }

  double of_laboratory(const Results &found, const char *figure)
  {
    const auto &given = found.summary["figures"]["laboratory"][figure];
    INFO(figure << " " << given.dump());
    REQUIRE(given["value"].is_number());
    return given["value"].get<double>();
  }

  bool exists(const ScratchFolder &folder, const std::string &file)
  {
    return std::filesystem::exists(folder.path() / "results" / file);
  }

  /** Of a run without snapshots, which must end past its peak. */
  Results run_of(const ScratchFolder &folder, const char *name, std::vector<std::string> changes = {})
  {
    changes.push_back("Output/Snapshots=0");
    Results found = results_of(folder, rock(name), changes);
    CHECK(found.summary["ended_by"] == "test");
    CHECK(found.balance_error() < 1e-2);
    return found;
  }
} // namespace

TEST_CASE("rock between platens breaks with figures, log and pictures of its cracks", "[apps][laboratory][slow]")
{
  const ScratchFolder folder;
  const Results       found = results_of(folder, rock("compression"), {"Output/Snapshots=2"});
  CHECK(found.summary["ended_by"] == "test");
  const double strength = of_laboratory(found, "compressive_strength");
  CHECK(of_laboratory(found, "compressive_strength_moving_average") <= strength);
  CHECK(of_laboratory(found, "young_modulus") > 5e9);
  CHECK(of_laboratory(found, "poisson_ratio") > 0);
  CHECK(of_laboratory(found, "poisson_ratio") < 0.6);
  CHECK(found.summary["figures"]["laboratory"]["quasi_static"].contains("holds"));
  CHECK(found.summary["figures"]["laboratory"]["quasi_static"]["strength_at_half_the_speed"]["value"].is_null());
  for (const char *file : {"stress_strain.csv", "stress_strain.png", "breaks.csv", "breaks.png", "directions.png",
                           "forces.png", "particles_breaks.pvd"})
    {
      INFO(file);
      CHECK(exists(folder, file));
    }
  const auto breaks =
    postprocess::read_csv_table(folder.path() / "results" / "breaks.csv", false, {"mode", "pair", "surface"});
  CHECK(breaks.rows() > 20);
  const auto &time = breaks.column("time");
  CHECK(std::is_sorted(time.begin(), time.end()));
  // Most cracks of a smooth specimen lie along the load: across it bonds are pulled.
  const auto &along = breaks.column("normal_y");
  const auto  steep =
    std::count_if(along.begin(), along.end(), [](const double n) { return std::abs(n) < std::sqrt(0.5); });
  CHECK(2 * steep > static_cast<std::ptrdiff_t>(along.size()));

  // The series knows nothing of the peak between its rows; the curve of the test does.
  const auto  curve   = postprocess::read_csv_table(folder.path() / "results" / "stress_strain.csv");
  const auto &largest = curve.column("largest_stress");
  CHECK(*std::max_element(largest.begin(), largest.end()) == Approx(strength).epsilon(1e-12));
}

TEST_CASE("rock that is split or bent fails at a stress like that at which it is pulled apart",
          "[apps][laboratory][slow]")
{
  const ScratchFolder pulled, split, bent;
  const double        tension   = of_laboratory(run_of(pulled, "tension"), "tensile_strength");
  const double        splitting = of_laboratory(run_of(split, "splitting"), "splitting_strength");
  const double        flexural  = of_laboratory(run_of(bent, "bending"), "flexural_strength");
  INFO("tension " << tension << ", splitting " << splitting << ", bending " << flexural);
  CHECK(tension > 1e6);
  for (const double other : {splitting, flexural})
    {
      CHECK(other > 0.5 * tension);
      CHECK(other < 3 * tension);
    }
}

TEST_CASE("rock under pressure from the sides is stronger, by walls as by a membrane", "[apps][laboratory][slow]")
{
  const ScratchFolder walls, membrane, higher;
  const Results       by_walls    = run_of(walls, "biaxial");
  const Results       by_membrane = run_of(membrane, "biaxial", {"Laboratory/Confinement=membrane"});
  const Results       at_more     = run_of(higher, "biaxial", {"Laboratory/Confining pressure=8e6"});
  const double        one         = of_laboratory(by_walls, "deviator_strength"),
               other              = of_laboratory(by_membrane, "deviator_strength"),
               more               = of_laboratory(at_more, "largest_deviator");
  INFO("walls " << one << ", membrane " << other << ", at 8 MPa " << more);
  CHECK(of_laboratory(by_membrane, "young_modulus_by_gauges") ==
        Approx(of_laboratory(by_walls, "young_modulus_by_gauges")).epsilon(0.05));
  CHECK(other == Approx(one).epsilon(0.25)); // a membrane lets it bulge
  CHECK(more > one);                         // hardly falls any more, so that a strength need not be determined
  CHECK(of_laboratory(by_walls, "axial_strength") == Approx(one + 5e6));
}

TEST_CASE("strength of a cube of spheres rises with the pressure around it", "[apps][laboratory][slow]")
{
  double last = 0;
  for (const char *pressure : {"2e6", "8e6"})
    {
      const ScratchFolder folder;
      const Results       found =
        run_of(folder, "triaxial", {std::string("Laboratory/Confining pressure=") + pressure, "Laboratory/Speed=0.6"});
      const double strength = of_laboratory(found, "axial_strength");
      INFO("at " << pressure << " Pa " << strength);
      CHECK(strength > last + 6e6); // more than the pressure alone adds
      last = strength;
    }
}

namespace
{
  /** Everything but timings and pictures. */
  std::string bits_of(const std::filesystem::path &results)
  {
    return content_of(results / "series.csv") + content_of(results / "stress_strain.csv") +
           content_of(results / "breaks.csv") + listing_of(results / "particles_breaks");
  }
} // namespace

TEST_CASE("a test of the laboratory that is interrupted or killed goes on to the same bits", "[apps][laboratory][slow]")
{
  const ScratchFolder folder;
  goes_on_to_the_same_bits(
    folder,
    {{"run", rock("biaxial"), "-s", "Output/Snapshots=100", "-s", "Output/Samples=100", "-s", "Time/End time=0.01",
      "-s", "Specimen/Box size=0.012, 0.02, 1", "-s", "Laboratory/Confinement=membrane", "-s", "Laboratory/Speed=0.4",
      "-s", "Output/Checkpoint interval=0.01"},
     {"checkpoint.h5", "particles_breaks/particles_breaks_000004.vtp"},
     bits_of},
    {SIGINT, SIGKILL});
}

TEST_CASE("a loading is repeated at half the speed from where it began, as a run of its own would do it",
          "[apps][laboratory][slow]")
{
  const ScratchFolder            folder, alone;
  const std::vector<std::string> small = {"Specimen/Box size=0.012, 0.02, 1", "Laboratory/Speed=1",
                                          "Output/Samples=200"};
  const auto                     with  = [&](const std::vector<std::string> &more) {
    auto all = small;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  // Glued, so that the loading begins with the first step: at half the speed it is another run altogether.
  const Results both = run_of(folder, "tension", with({"Laboratory/Check speed=true"}));
  const Results slow = run_of(alone, "tension", with({"Laboratory/Speed=0.5"}));
  CHECK(content_of(folder / "results/stress_strain_at_half_the_speed.csv") ==
        content_of(alone / "results/stress_strain.csv"));
  const double fast = of_laboratory(both, "tensile_strength"), half = of_laboratory(slow, "tensile_strength");
  const auto  &how = both.summary["figures"]["laboratory"]["quasi_static"];
  CHECK(how["strength_at_half_the_speed"]["value"].get<double>() == half);
  CHECK(how["change_at_half_the_speed"]["value"].get<double>() == Approx(std::abs(half / fast - 1)).epsilon(1e-12));
  CHECK(std::abs(half / fast - 1) > 0.005); // so fast it is that this shows
  CHECK(how["holds"] == false);
  // What the test itself finds does not depend on it.
  const ScratchFolder without;
  const Results       plain = run_of(without, "tension", small);
  CHECK(content_of(folder / "results/series.csv") == content_of(without / "results/series.csv"));
  CHECK(content_of(folder / "results/stress_strain.csv") == content_of(without / "results/stress_strain.csv"));
  CHECK(plain.summary["figures"]["laboratory"]["quasi_static"]["strength_at_half_the_speed"]["value"].is_null());
}

TEST_CASE("a loading at half the speed that is interrupted goes on to the same bits", "[apps][laboratory][slow]")
{
  // Under a membrane it begins after the pressure has come on. Stopped at the end of the test or in its repetition.
  const std::vector<std::string> changes = {"Output/Snapshots=100",
                                            "Output/Samples=100",
                                            "Time/End time=0.01",
                                            "Specimen/Box size=0.012, 0.02, 1",
                                            "Laboratory/Confinement=membrane",
                                            "Laboratory/Confining pressure=2e6",
                                            "Material/flat-joint/Cohesion=10e6",
                                            "Material/flat-joint/Friction coefficient=0.1",
                                            "Laboratory/Speed=0.05",
                                            "Output/Checkpoint interval=0.01",
                                            "Laboratory/Check speed=true"};
  const ScratchFolder            folder;
  const Results                  counted = results_of(folder, rock("biaxial"), changes);
  // Otherwise nothing is repeated. Slow as it is, the repetition finds the strength of the test.
  CHECK(counted.summary["figures"]["laboratory"]["quasi_static"]["strength_at_half_the_speed"]["value"].get<double>() ==
        Approx(of_laboratory(counted, "deviator_strength")).epsilon(0.05));
  std::size_t snapshots = 0;
  for ([[maybe_unused]] const auto &file : std::filesystem::directory_iterator(folder / "results/particles_breaks"))
    ++snapshots;
  std::vector<std::string> words = {"run", rock("biaxial")};
  for (const std::string &change : changes)
    words.insert(words.end(), {"-s", change});
  const auto all_bits = [](const std::filesystem::path &results) {
    return bits_of(results) + content_of(results / "stress_strain_at_half_the_speed.csv");
  };
  const auto snapshot = [](const std::size_t number) {
    std::string digits = std::to_string(number);
    digits.insert(0, 6 - digits.size(), '0');
    return "particles_breaks/particles_breaks_" + digits + ".vtp";
  };
  goes_on_to_the_same_bits(folder, {words, {"checkpoint.h5", snapshot(snapshots - 1)}, all_bits}, {SIGINT});
}

TEST_CASE("a family under several pressures has a strength that rises along a line", "[apps][laboratory][slow]")
{
  const ScratchFolder folder;
  const Outcome       outcome =
    run(folder.path(), {"bench", "confined", rock("biaxial"), "--pressures", "8e6,2e6", "-o", "family", "-s",
                        "Specimen/Box size=0.012, 0.02, 1", "-s", "Laboratory/Speed=0.2"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto rows = postprocess::read_csv_table(folder / "family/confined.csv", true);
  REQUIRE(rows.rows() == 2);
  CHECK(rows.column("pressure") == std::vector<double>{2e6, 8e6});
  const auto &strength = rows.column("axial_strength");
  CHECK(strength[1] > strength[0] + 6e6); // more than the pressure alone adds
  for (const double error : rows.column("balance_error"))
    CHECK(error < 1e-2);
  // The line through two points, and its angle.
  const double       k = (strength[1] - strength[0]) / 6e6;
  std::ostringstream angle;
  angle << std::fixed << std::setprecision(1) << std::asin((k - 1) / (k + 1)) * 180 / M_PI;
  CHECK_THAT(content_of(folder / "family/confined.md"), Contains("angle of friction " + angle.str() + " degrees"));
  CHECK(std::filesystem::file_size(folder / "family/confined.png") > 0);
  const Outcome refused = run(folder.path(), {"bench", "confined", rock("compression"), "-o", "none"});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("needs biaxial or triaxial compression"));
}

TEST_CASE("rows of a test and its snapshots show all of it, wherever its largest strain lies",
          "[apps][laboratory][slow]")
{
  std::vector<std::string> series;
  for (const char *largest : {"0.02", "0.2"})
    {
      const ScratchFolder folder;
      const Results       found = results_of(folder, rock("tension"),
                                             {"Specimen/Box size=0.012, 0.02, 1", "Laboratory/Speed=0.5", "Output/Samples=40",
                                              "Output/Snapshots=10", "Laboratory/Ramp steps=200",
                                              std::string("Laboratory/Largest strain=") + largest});
      CHECK(found.summary["ended_by"] == "test");
      const double peak   = of_laboratory(found, "strain_at_peak");
      const auto   rows   = postprocess::read_csv_table(folder.path() / "results/series.csv");
      const auto  &strain = rows.column("strain");
      const auto   before = std::count_if(strain.begin(), strain.end(), [&](const double e) { return e < peak; });
      CHECK(before > 20);
      CHECK(rows.rows() < 400);
      CHECK(strain.back() > peak);
      std::size_t snapshots = 0;
      for ([[maybe_unused]] const auto &file :
           std::filesystem::directory_iterator(folder / "results/particles_particles"))
        ++snapshots;
      CHECK(snapshots > 10);
      CHECK(snapshots < 100);
      CHECK(exists(folder, "stress_strain.png"));
      CHECK_FALSE(exists(folder, "curve.png")); // between rows it would not know of the peak
      series.push_back(content_of(folder / "results/series.csv"));
    }
  CHECK(series[0] == series[1]);
}

TEST_CASE("a summary warns of a loading that was not static, and reports the deviator", "[apps][laboratory][slow]")
{
  const ScratchFolder folder;
  const Results       found = results_of(folder, rock("biaxial"),
                                         {"Specimen/Box size=0.012, 0.02, 1", "Laboratory/Speed=2", "Output/Snapshots=0"});
  const auto         &lab   = found.summary["figures"]["laboratory"];
  REQUIRE(lab["quasi_static"]["holds"] == false);
  CHECK_THAT(found.summary["warnings"].dump(), Contains("was not static up to"));
  CHECK_FALSE(lab.contains("largest_stress"));
  CHECK(of_laboratory(found, "largest_deviator") > 0);
}

TEST_CASE("strengths that a test under pressure has not found are figures with a reason", "[apps][laboratory][slow]")
{
  const ScratchFolder folder;
  const Results       found = results_of(
          folder, rock("biaxial"),
          {"Specimen/Box size=0.012, 0.02, 1", "Laboratory/Speed=2", "Laboratory/Largest strain=1e-4", "Output/Snapshots=0"});
  const auto &lab = found.summary["figures"]["laboratory"];
  for (const char *name : {"deviator_strength", "axial_strength"})
    {
      INFO(name);
      REQUIRE(lab.contains(name));
      CHECK(lab[name]["value"].is_null());
      CHECK_FALSE(lab[name]["not_determined"].get<std::string>().empty());
    }
}

TEST_CASE("a cylinder is loaded only when it stands still under its pressure", "[apps][laboratory][slow]")
{
  const ScratchFolder folder;
  const Results       found =
    results_of(folder, rock("cylinder"), {"Specimen/Genesis/Classes=4e-3-5e-3: 1", "Output/Snapshots=0"});
  // A specimen that still moved inwards when its loading began had a ratio of secants below zero.
  CHECK(of_laboratory(found, "poisson_ratio") > 0.5 * of_laboratory(found, "poisson_ratio_by_slopes"));
  // Section of the mould, in which it grew.
  CHECK(of_laboratory(found, "stress_over_force") == Approx(4 / (M_PI * 0.02 * 0.02)).epsilon(1e-9));
}

TEST_CASE("what a laboratory cannot do is refused with the entry", "[apps][laboratory]")
{
  const ScratchFolder folder;
  is_refused(folder, rock("compression"), {"Laboratory/Axis=z"}, "in two dimensions the axes are x and y");
  is_refused(folder, rock("compression"), {"Laboratory/Test=triaxial compression", "Laboratory/Confining pressure=1e6"},
             "Physics/Dimension is 2");
  is_refused(folder, rock("triaxial"), {"Laboratory/Test=biaxial compression"}, "Take the triaxial one");
  is_refused(folder, rock("bending"), {"Laboratory/Body axis=y"}, "is the axis of the load");
  is_refused(folder, rock("bending"), {"Laboratory/Span=0.2"}, "beyond its supports");
  is_refused(folder, rock("compression"), {"Laboratory/Smoothing depth=0.02"}, "Smoothing depth");
  is_refused(folder, rock("compression"), {"Laboratory/Smoothing depth=0.0006"}, "up to half its radius");
  is_refused(folder, rock("tension"), {"Laboratory/Glued layer=0.03"}, "would meet");
  is_refused(folder, rock("compression"), {"Gravity/Acceleration=0, -9.81, 0"}, "would not know of an equilibrium");
  is_refused(folder, rock("compression"), {"Probes/stress/Quantity=kinetic energy"}, "a probe has that name");
}
