// breccia calibrate: constants that make runs give what was measured.
#include "apps/scene/kinds/read_scene.h"
#include "apps/studies/calibration_runs.h"
#include "apps/studies/measured_curve.h"
#include "base/errors.h"
#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** Constants of a stack of spheres that is pulled until it breaks, in part of a second. */
  std::string calibration_of_stack(const std::string &targets)
  {
    return R"(set Kind       = calibration
set Base scene = stack.prm
subsection Constants
  subsection modulus
    set Entry = Material/CPM/Normal modulus
    set Start = 22e9
    set Lower = 15e9
    set Upper = 40e9
  end
  subsection limit
    set Entry = Material/CPM/Limit elastic strain
    set Start = 1.2e-4
    set Lower = 0.4e-4
    set Upper = 2e-4
  end
  subsection unseen
    set Entry = Loading/Compression/Strain rate
    set Start = 15
    set Lower = 10
    set Upper = 20
  end
end
subsection Targets
)" + targets +
           "end\n";
  }

  const std::string figures = R"(  subsection E
    set Figure = young_modulus
    set Value  = 1e9
    set Standard deviation = 1e8
  end
  subsection f_t
    set Figure = tensile_strength
    set Value  = 1e6
    set Standard deviation = 1e5
  end
)";

  /** The same without the constant that no figure shows. */
  std::string two_constants(const std::string &targets)
  {
    const std::string text = calibration_of_stack(targets);
    const std::size_t from = text.find("  subsection unseen"), to = text.find("  end\n", from) + 6;
    return replaced(
      text.substr(0, from) + text.substr(to), "subsection Constants",
      "subsection Search\n  set Smallest sum = 1e-6\nend\nsubsection Constants"); // as many figures as constants
  }

  /** A modulus as wanted, and a strength that this stack has with a limit a little below its start. */
  std::string stack_figures(const std::string &modulus, const std::string &deviation)
  {
    std::string text = replaced(figures, "1e9", modulus);
    text             = replaced(text, "1e8", deviation);
    return replaced(text, "set Value  = 1e6", "set Value  = 5.5e6");
  }

  void write_calibration(const ScratchFolder &folder, const std::string &text)
  {
    folder.file("packing.txt", stack_packing());
    std::string scene = replaced(scene_with_file(), "set Grip thickness", "set Tests = tension\n  set Grip thickness");
    folder.file("stack.prm", replaced(scene, "set Snapshots = 5", "set Snapshots = 0"));
    folder.file("calibration.prm", text);
  }

  /** A process of its own: a calibration starts its program again for each run. */
  Outcome calibrate(const ScratchFolder &folder, const std::vector<std::string> &options)
  {
    std::vector<std::string> words = {"calibrate", "calibration.prm"};
    words.insert(words.end(), options.begin(), options.end());
    return Program(folder.path(), words).wait();
  }

  /** The curve that known constants give up to its peak, with noise: its standard deviation. Beyond the peak it is jagged. */
  double measure(const ScratchFolder &folder)
  {
    REQUIRE(run(folder.path(), {"run", "stack.prm", "-o", "truth", "-s", "Material/CPM/Normal modulus=27e9", "-s",
                                "Material/CPM/Limit elastic strain=0.8e-4"})
              .status == 0);
    const auto                 truth = postprocess::read_csv_table(folder / "truth/series.csv", true, {"test"});
    const auto                &x = truth.column("strain"), &y = truth.column("stress");
    const auto                 peak      = std::max_element(y.begin(), y.end());
    const double               deviation = 0.02 * *peak;
    std::mt19937               stream(5);
    std::normal_distribution<> noise(0, deviation);
    std::ostringstream         text;
    text.precision(17);
    text << "strain,stress\n";
    for (std::size_t row = 0; row <= std::size_t(peak - y.begin()); ++row)
      text << x[row] << ',' << y[row] + noise(stream) << '\n';
    folder.file("measured.csv", text.str());
    return deviation;
  }
} // namespace

TEST_CASE("breccia calibrate recovers known constants within their error bars and names the undetermined one",
          "[apps][slow]")
{
  const ScratchFolder folder;
  write_calibration(folder, "");
  const double       deviation = measure(folder);
  std::ostringstream target;
  target << "  subsection pull\n    set Curve = measured.csv\n    set Test = tension\n    set Standard deviation = "
         << deviation << "\n  end\n";
  write_calibration(folder, calibration_of_stack(target.str()));
  const Outcome told = calibrate(folder, {"-o", "out"});
  INFO(told.err << told.out);
  REQUIRE(told.status == 0);
  const auto found     = nlohmann::json::parse(content_of(folder / "out/calibration.json"));
  const auto constants = found["constants"];
  for (const auto &[name, truth] : {std::pair("modulus", 27e9), std::pair("limit", 0.8e-4)})
    {
      INFO(name);
      const double value = constants[name]["value"], error = constants[name]["standard_error"];
      CHECK(constants[name]["determined"] == true);
      CHECK(std::fabs(value - truth) < 3 * error);
      CHECK(error < 0.05 * truth);
      CHECK(constants[name]["band_95"][0].get<double>() < value);
    }
  CHECK(constants["unseen"]["determined"] == false);
  CHECK(constants["unseen"]["value"].get<double>() == 15);
  CHECK(constants["unseen"]["standard_error"].is_null());
  CHECK_THAT(told.out, Contains("do not determine unseen: it is held at its start, 15"));
  CHECK(found["evaluations"].get<int>() <= 40);
  CHECK_THAT(content_of(folder / "out/pull.csv"), Catch::StartsWith("strain,measured,predicted,half_width_95\n"));

  const std::string before = content_of(folder / "out/calibration.json");
  const Outcome     again  = calibrate(folder, {"-o", "out", "--processes", "3"});
  CHECK(again.status == 0);
  CHECK_THAT(again.out, Contains(" 0 new runs"));
  CHECK(content_of(folder / "out/calibration.json") == before);
}

TEST_CASE("a constant whose band fills its bounds is not called determined, and held at its start", "[apps][slow]")
{
  const ScratchFolder folder;
  // A modulus of 33 GPa known to 100 %: the band of the constant reaches beyond both bounds.
  write_calibration(folder, two_constants(stack_figures("33e9", "33e9")));
  const Outcome told = calibrate(folder, {"-o", "out"});
  INFO(told.err << told.out);
  REQUIRE(told.status == 0);
  const auto constants = nlohmann::json::parse(content_of(folder / "out/calibration.json"))["constants"];
  CHECK(constants["modulus"]["determined"] == false);
  CHECK(constants["modulus"]["value"].get<double>() == 22e9);
  CHECK(constants["limit"]["determined"] == true);
  CHECK_THAT(told.out, Contains("do not determine modulus: it is held at its start"));
}

TEST_CASE("a posterior by an emulator has bands of constants and of the curve, and the report shows them",
          "[apps][slow]")
{
  const ScratchFolder folder;
  write_calibration(folder, "");
  const double       deviation = measure(folder);
  std::ostringstream target;
  target << "  subsection pull\n    set Curve = measured.csv\n    set Test = tension\n    set Standard deviation = "
         << deviation << "\n  end\n";
  write_calibration(folder,
                    replaced(calibration_of_stack(target.str()), "subsection Targets",
                             "subsection Posterior\n  set Runs = 30\n  set Draws = 500\nend\nsubsection Targets"));
  const Outcome told = calibrate(folder, {"-o", "out"});
  INFO(told.err << told.out);
  REQUIRE(told.status == 0);
  const auto found = nlohmann::json::parse(content_of(folder / "out/calibration.json"));
  for (const auto &[name, truth] : {std::pair("modulus", 27e9), std::pair("limit", 0.8e-4)})
    {
      INFO(name);
      const auto  &own   = found["constants"][name];
      const double error = own["standard_error"], lower = own["posterior"]["band_95"][0],
                   upper = own["posterior"]["band_95"][1];
      CHECK(lower < truth + error);
      CHECK(upper > truth - error);
      CHECK(own["posterior"]["standard_deviation"].get<double>() == Approx(error).epsilon(0.5)); // nearly linear
    }
  const auto band = found["constants"]["unseen"]["posterior"]["band_95"]; // as wide as the bounds, 10 to 20
  CHECK(band[0].get<double>() < 11);
  CHECK(band[1].get<double>() > 19);
  CHECK(found["posterior"]["runs"].get<int>() == 30);
  const auto curve = postprocess::read_csv_table(folder / "out/pull.csv", true);
  for (std::size_t row = 0; row < curve.rows(); ++row)
    CHECK(curve.column("posterior_lower_95")[row] < curve.column("posterior_upper_95")[row]);
  const std::string page = content_of(folder / "out/report.html");
  CHECK_THAT(page, Contains("data:image/png;base64,iVBORw0KGgo") && Contains("posterior mean") && Contains("unseen"));
  CHECK(page.size() < 2000000);
}

TEST_CASE("a cheap model first leaves the costly one few runs, and gives the same constants", "[apps][slow]")
{
  const ScratchFolder folder;
  const std::string   text = two_constants(stack_figures("33e9", "0.5e9"));
  write_calibration(folder, text);
  REQUIRE(calibrate(folder, {"-o", "alone"}).status == 0);
  const auto with_cheap = [&](const std::string &changes) {
    write_calibration(folder,
                      replaced(text, "subsection Constants",
                               "subsection Cheap model\n  set Changes = " + changes + "\nend\nsubsection Constants"));
  };
  with_cheap("Loading/Tension/Strain rate=8; Output/Samples=20");
  const Outcome told = calibrate(folder, {"-o", "after"});
  INFO(told.err << told.out);
  REQUIRE(told.status == 0);
  const auto alone = nlohmann::json::parse(content_of(folder / "alone/calibration.json")),
             after = nlohmann::json::parse(content_of(folder / "after/calibration.json"));
  CHECK(after["cheap_evaluations"].get<int>() > 0);
  CHECK(after["evaluations"].get<int>() < alone["evaluations"].get<int>());
  CHECK(after["constants"]["modulus"]["value"].get<double>() ==
        Approx(alone["constants"]["modulus"]["value"].get<double>()).epsilon(0.02));
  with_cheap("Loading/Tension/Strain speed=8");
  const Outcome refused = calibrate(folder, {"-o", "refused"});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("Strain speed"));
}

TEST_CASE("several tests are met together by their weights, with derivatives and without", "[apps][slow]")
{
  const auto [weight, method, modulus] =
    GENERATE(table<std::string, std::string, double>({{"1", "least squares", 36e9}, // 30 GPa here and 60 GPa there
                                                      {"4", "least squares", 45e9},
                                                      {"4", "without derivatives", 45e9}}));
  const ScratchFolder folder;
  write_calibration(folder, R"(set Kind       = calibration
set Base scene = stack.prm
subsection Search
  set Smallest decrease = 1e-6
  set Method = )" + method + R"(
end
subsection Constants
  subsection modulus
    set Entry = Material/CPM/Normal modulus
    set Start = 22e9
    set Lower = 15e9
    set Upper = 40e9
  end
end
subsection Targets
  subsection E
    set Figure = young_modulus
    set Value  = 30e9
  end
  subsection other_E
    set Scene  = other.prm
    set Figure = young_modulus
    set Value  = 60e9
    set Weight = )" + weight + "\n  end\nend\n");
  folder.file("other.prm", content_of(folder / "stack.prm"));
  const Outcome told = calibrate(folder, {"-o", "out"});
  INFO(told.err << told.out);
  REQUIRE(told.status == 0);
  const auto targets = nlohmann::json::parse(content_of(folder / "out/calibration.json"))["targets"];
  CHECK(targets["E"]["predicted"].get<double>() == Approx(modulus).epsilon(5e-3)); // sum of w (E/E* - 1)^2
  CHECK(targets["other_E"]["predicted"] == targets["E"]["predicted"]);
}

TEST_CASE("replicates: the mean of the packings is compared, the same ones for every set of constants", "[apps][slow]")
{
  const ScratchFolder folder;
  std::string         text = replaced(two_constants(stack_figures("33e9", "1e9")), "subsection Targets",
                                      "subsection Replicates\n  set Entry = Specimen/Generator/Seed\n"
                                              "  set Seeds = 3, 4\nend\nsubsection Targets");
  write_calibration(folder, text);
  folder.file("stack.prm",
              replaced(content_of(folder / "stack.prm"),
                       "set Source            = file\n  set File              = packing.txt",
                       "set Source = generator\n  set Box size = 0.012, 0.012, 0.02\n  subsection Generator\n"
                       "    set Particle radius = 1e-3\n  end"));
  const Outcome told = calibrate(folder, {"-o", "out"});
  INFO(told.err << told.out);
  REQUIRE(told.status == 0);
  const auto found     = nlohmann::json::parse(content_of(folder / "out/calibration.json"));
  const auto value_of  = [&found](const std::string &name) { return found["constants"][name]["value"].get<double>(); };
  const auto number_in = [](const std::string &change) { return std::stod(change.substr(change.find('=') + 1)); };
  std::map<std::vector<double>, std::string> seeds_of; // constants -> their seeds
  double                                     sum = 0;  // of the moduli of both packings at the answer
  for (const auto &entry : std::filesystem::directory_iterator(folder / "out/journal"))
    if (entry.path().extension() == ".json")
      {
        const auto changes = nlohmann::json::parse(content_of(entry.path()))["changes"].get<std::vector<std::string>>();
        REQUIRE(changes.size() == 3);
        const std::vector<double> constants = {number_in(changes[0]), number_in(changes[1])};
        seeds_of[constants] += changes[2].back();
        const auto summary = folder.path() / "out/runs" / entry.path().stem() / "summary.json";
        if (constants == std::vector<double>{value_of("modulus"), value_of("limit")})
          sum += nlohmann::json::parse(content_of(summary))["figures"]["young_modulus"]["value"].get<double>();
      }
  CHECK(static_cast<int>(seeds_of.size()) <= found["evaluations"].get<int>());
  for (const auto &[constants, seeds] : seeds_of)
    CHECK((seeds == "34" || seeds == "43"));
  CHECK(found["targets"]["E"]["predicted"].get<double>() == Approx(sum / 2).epsilon(1e-12));
}

TEST_CASE("what a reference scene gives is what is measured, and the constants are a scene's", "[apps][slow]")
{
  const ScratchFolder folder;
  write_calibration(folder, replaced(two_constants(R"(  subsection E
    set Figure = young_modulus
    set Reference scene = stiff.prm
    set Ordinate factor = 2
  end
  subsection f_t
    set Figure = tensile_strength
    set Reference scene = truth.prm
  end
)"),
                                     "subsection Constants",
                                     "subsection Search\n  set Smallest decrease = 1e-6\nend\nsubsection Constants"));
  const std::string scene = content_of(folder / "stack.prm");
  folder.file("stiff.prm", replaced(scene, "= 25e9", "= 54e9")); // of which the runs give half
  folder.file("truth.prm", replaced(replaced(scene, "= 25e9", "= 27e9"), "= 1e-4", "= 0.8e-4"));
  const Outcome told = calibrate(folder, {"-o", "out"});
  INFO(told.err << told.out);
  REQUIRE(told.status == 0);
  const auto constants = nlohmann::json::parse(content_of(folder / "out/calibration.json"))["constants"];
  CHECK(constants["modulus"]["value"].get<double>() == Approx(27e9).epsilon(0.02));
  CHECK(constants["limit"]["value"].get<double>() == Approx(0.8e-4).epsilon(0.02));
  CHECK_THAT(content_of(folder / "out/constants.prm"),
             Contains("subsection Material\n  subsection CPM\n    set Normal modulus = "));
  CHECK(calibrate(folder, {"-o", "refused", "-s", "Targets/E/Reference scene=gone.prm"}).status == 2);
}

TEST_CASE("breccia calibrate refuses what it cannot seek before its first run, in one message", "[apps]")
{
  const ScratchFolder folder;
  const auto [from, to, said] = GENERATE(table<std::string, std::string, std::string>(
    {{"Kind       = calibration", "Kind = study", "a calibration is wanted"},
     {"set Base scene = stack.prm", "set Base scene = gone.prm", "gone.prm"},
     {"set Base scene = stack.prm", "", "\"Base scene\" is not set"},
     {"Material/CPM/Normal modulus", "Material/CPM/Normal moduli", "Normal modul"},
     {"set Lower = 15e9", "set Lower = -1", "Normal modulus"},
     {"set Lower = 15e9", "set Lower = 41e9", "must be above Lower"},
     {"set Start = 22e9", "set Start = 2e9", "must lie between Lower and Upper"},
     {"set Figure = young_modulus", "", "Targets/E/Curve"},
     {"set Value  = 1e9", "", "it must not be zero"},
     {"set Standard deviation = 1e8", "", "all or none"},
     {"set Figure = young_modulus", "set Curve = gone.csv", "gone.csv"},
     {"subsection Constants", "subsection Replicates\n set Seeds = 1\nend\nsubsection Constants",
      "wanted with Entry"}}));
  write_calibration(folder, replaced(calibration_of_stack(figures), from, to));
  const Outcome told = run(folder.path(), {"calibrate", "calibration.prm", "-o", "out"});
  INFO(from << told.err);
  CHECK(told.status == 2);
  CHECK_THAT(told.err, Contains(said));
  CHECK_FALSE(std::filesystem::exists(folder / "out/runs"));
}

TEST_CASE("every shipped study and calibration is read with the scenes of all its runs", "[apps]")
{
  int                      count = 0;
  const apps::StudyOptions nowhere;
  for (const auto &entry : std::filesystem::directory_iterator(places::sources() + "/apps/scenes/studies"))
    {
      const std::string file = entry.path().string();
      INFO(file);
      if (apps::is_of_kind(file, "study"))
        CHECK(apps::plan_of(*apps::read_study(file, {})).changes.size() > 5);
      else if (apps::is_of_kind(file, "calibration"))
        CHECK(apps::CalibrationRuns(*apps::read_calibration(file, {}), nowhere).runs_of_a_set() > 0);
      else
        CHECK_NOTHROW(apps::read_scene(file, {}));
      ++count;
    }
  CHECK(count >= 8);
}

TEST_CASE("a value that a search comes to is not questioned as a person's, whose bounds are", "[apps]")
{
  const std::string           folder = places::sources() + "/apps/scenes/studies/";
  const auto                  file   = apps::read_calibration(folder + "mortar_calibration.prm", {});
  const apps::StudyOptions    nowhere;
  const apps::CalibrationRuns runs(*file, nowhere);
  const std::string           scene = file->targets.front().scene, angle = "Material/flat-joint/Friction angle";
  // In degrees, 0.3 would be taken for radians by mistake; the bounds are 0 and 60.
  CHECK_THROWS_WITH(apps::read_scene(scene, {angle + "=0.3"}), Contains("In radians?"));
  CHECK(runs.change_of(scene, angle, 0.3) == angle + "=0.3 degrees");
  CHECK_NOTHROW(apps::read_scene(scene, {runs.change_of(scene, angle, 0.3)}));
  CHECK(runs.change_of(scene, angle, 34) == angle + "=34");
}

TEST_CASE("check of a calibration says what it takes at most, and describe knows its entries and those of a study",
          "[apps]")
{
  const ScratchFolder folder;
  write_calibration(folder, calibration_of_stack(figures));
  const Outcome told = run(folder.path(), {"check", "calibration.prm"});
  INFO(told.err);
  CHECK(told.status == 0);
  CHECK_THAT(told.out, Contains("3 constants, 2 targets; 1 runs for each set of constants, at most 200 sets") &&
                         Contains("particles") && Contains("altogether   roughly"));
  CHECK_THAT(run(folder.path(), {"describe", "Cheap model", "--kind", "calibration"}).out, Contains("Changes"));
  CHECK_THAT(run(folder.path(), {"describe", "Axial distance"}).out, Contains("Scenes of kind study"));
}

TEST_CASE("a figure that no run has is refused by name, with those that there are, when constants are sought",
          "[apps][slow]")
{
  const ScratchFolder folder;
  write_calibration(folder, replaced(calibration_of_stack(figures), "young_modulus", "younger_modulus"));
  const Outcome told = calibrate(folder, {"-o", "out"});
  CHECK(told.status == 2);
  CHECK_THAT(told.err, Contains("younger_modulus") && Contains("tensile_strength"));
}

TEST_CASE("curves are compared where they first get as far, and beyond its end a curve falls to zero", "[apps]")
{
  postprocess::CsvTable table;
  table.names   = {"strain", "stress"};
  table.units   = {"-", "Pa"};
  table.columns = {{0.1, 0.2, 0.15, 0.4}, {1, 3, 9, 1}}; // the third goes back
  const apps::CurveColumns columns{"strain", "stress", ""};
  Eigen::VectorXd          places(6);
  places << 0.05, 0.1, 0.15, 0.3, 0.42, 0.5;
  const Eigen::VectorXd found = apps::ordinates_at(places, table, columns);
  CHECK(found[0] == Approx(0.5)); // from the origin
  CHECK(found[1] == Approx(1));
  CHECK(found[2] == Approx(2));
  CHECK(found[3] == Approx(2));
  CHECK(found[4] == Approx(0.6)); // 0.02 beyond, of 0.05
  CHECK(found[5] == 0);
  for (auto &strain : table.columns[0]) // compression is negative
    strain = -strain;
  CHECK(apps::ordinates_at(-places, table, columns) == found);
  CHECK(apps::abscissae_of(table, columns) == Eigen::Vector3d(-0.1, -0.2, -0.4)); // its own: no more was observed
  table.columns = {{0}, {0}};
  CHECK_THROWS_AS(apps::abscissae_of(table, columns), base::InputError);
}
