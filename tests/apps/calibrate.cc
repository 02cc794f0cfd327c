// breccia calibrate: constants that make runs give what was measured.
#include "postprocess/files/csv_table.h"
#include "tests/apps/scenes.h"
#include "tests/apps/stack_calibration.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

TEST_CASE("breccia calibrate recovers known constants within their error bars and names the undetermined one",
          "[apps][slow]")
{
  const ScratchFolder folder;
  write_curve_calibration(folder);
  const Outcome outcome = calibrate(folder, {"-o", "out"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
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
  CHECK_THAT(outcome.out, Contains("do not determine unseen: it is held at its start, 15"));
  CHECK(found["evaluations"].get<int>() <= 40);
  CHECK_THAT(content_of(folder / "out/pull.csv"), Catch::StartsWith("strain,measured,predicted,half_width_95\n"));

  const std::string before = content_of(folder / "out/calibration.json");
  const Outcome     again  = calibrate(folder, {"-o", "out", "--processes", "3"});
  CHECK(again.status == 0);
  CHECK_THAT(again.out, Contains(" 0 new runs"));
  CHECK(content_of(folder / "out/calibration.json") == before);

  REQUIRE(calibrate(folder, {"-o", "one_by_one", "--processes", "1"}).status == 0);
  CHECK(content_of(folder / "one_by_one/calibration.json") == before);

  const ScratchFolder elsewhere; // the page has all that it was made from
  elsewhere.file("sent.html", content_of(folder / "out/report.html"));
  std::filesystem::remove(folder / "measured.csv");
  std::filesystem::remove(folder / "stack.prm");
  REQUIRE(Program(elsewhere.path(), {"run", "sent.html", "-o", "again"}).wait().status == 0);
  CHECK(nlohmann::json::parse(content_of(elsewhere / "again/calibration.json"))["constants"] == constants);
}

TEST_CASE("known constants of flat joints are recovered within their error bars", "[apps][slow]")
{
  const ScratchFolder folder;
  write_calibration(folder, "");
  const std::string law   = R"(  set Law = flat-joint
  subsection flat-joint
    set Effective modulus    = 40e9
    set Stiffness ratio      = 2.5
    set Tensile strength     = 6e6
    set Cohesion             = 12e6
    set Friction angle       = 20
    set Friction coefficient = 0.5
    set Rings                = 2
    set Sectors              = 6
  end
)";
  std::string       scene = replaced(scene_with_file(), "set Snapshots = 5", "set Snapshots = 0");
  const std::size_t from  = scene.find("  set Law = CPM");
  scene.replace(from, scene.find("subsection Loading") - from, law + "end\n");
  folder.file("stack.prm", replaced(scene, "= 1.5", "= 1.1"));
  REQUIRE(run(folder.path(), {"run", "stack.prm", "-o", "truth"}).status == 0);
  const auto                 figures = nlohmann::json::parse(content_of(folder / "truth/summary.json"))["figures"];
  std::mt19937               stream(5);
  std::normal_distribution<> noise(0, 1);
  std::ostringstream         text;
  text << R"(set Kind       = calibration
set Base scene = stack.prm
subsection Constants
  subsection modulus
    set Entry = Material/flat-joint/Effective modulus
    set Start = 50e9
    set Lower = 20e9
    set Upper = 80e9
  end
  subsection tensile
    set Entry = Material/flat-joint/Tensile strength
    set Start = 7e6
    set Lower = 3e6
    set Upper = 12e6
  end
  subsection cohesion
    set Entry = Material/flat-joint/Cohesion
    set Start = 14e6
    set Lower = 6e6
    set Upper = 24e6
  end
end
subsection Targets
)";
  // Figures: a curve up to a brittle peak says of a strength only that it is not less.
  for (const char *name : {"young_modulus", "tensile_strength", "compressive_strength"})
    {
      const double value = figures[name]["value"], deviation = 0.02 * value;
      text << "  subsection " << name << "\n    set Figure = " << name
           << "\n    set Value = " << value + deviation * noise(stream)
           << "\n    set Standard deviation = " << deviation << "\n  end\n";
    }
  text << "end\n";
  folder.file("calibration.prm", text.str());
  const Outcome outcome = calibrate(folder, {"-o", "out"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
  const auto constants = nlohmann::json::parse(content_of(folder / "out/calibration.json"))["constants"];
  for (const auto &[name, truth] : {std::pair("modulus", 40e9), std::pair("tensile", 6e6), std::pair("cohesion", 12e6)})
    {
      INFO(name);
      const double value = constants[name]["value"], error = constants[name]["standard_error"];
      CHECK(constants[name]["determined"] == true);
      CHECK(std::fabs(value - truth) < 3 * error);
      CHECK(error < 0.1 * truth);
    }
}

TEST_CASE("a constant whose band fills its bounds is not called determined, and held at its start", "[apps][slow]")
{
  const ScratchFolder folder;
  // A modulus of 33 GPa known to 100 %: the band of the constant reaches beyond both bounds.
  write_calibration(folder, two_constants(stack_figures("33e9", "33e9")));
  const Outcome outcome = calibrate(folder, {"-o", "out"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
  const auto constants = nlohmann::json::parse(content_of(folder / "out/calibration.json"))["constants"];
  CHECK(constants["modulus"]["determined"] == false);
  CHECK(constants["modulus"]["value"].get<double>() == 22e9);
  CHECK(constants["limit"]["determined"] == true);
  CHECK_THAT(outcome.out, Contains("do not determine modulus: it is held at its start"));
  CHECK(std::filesystem::file_size(folder / "out/figures.png") > 1000);
  CHECK_THAT(content_of(folder / "out/report.html"), Contains("data:image/png;base64,iVBORw0KGgo"));

  // Sets of constants are those of all searches together: where none is left, all are sought to the end.
  const Outcome few = calibrate(folder, {"-o", "few", "-s", "Search/Most evaluations=4"});
  REQUIRE(few.status == 0);
  CHECK_THAT(few.out, Contains("say next to nothing of modulus") && !Contains("held at its start"));
  const auto found = nlohmann::json::parse(content_of(folder / "few/calibration.json"));
  CHECK(found["constants"]["modulus"]["determined"] == false);
  CHECK(found["targets"]["E"]["at_start"].get<double>() > 0);
}

TEST_CASE("a constant that the start does not show is held for good where no sets are left to see it at the answer",
          "[apps][slow]")
{
  const ScratchFolder folder;
  write_curve_calibration(folder);
  for (const int most : {5, 8})
    {
      INFO(most);
      const std::string out     = "out" + std::to_string(most);
      const Outcome     outcome = calibrate(folder, {"-o", out, "-s", "Search/Updated derivatives=true", "-s",
                                                     "Search/Most evaluations=" + std::to_string(most)});
      INFO(outcome.err << outcome.out);
      REQUIRE(outcome.status == 0);
      CHECK_THAT(outcome.out, Contains("do not determine unseen: it is held at its start, 15"));
      const auto found = nlohmann::json::parse(content_of(folder / out / "calibration.json"));
      CHECK(found["constants"]["unseen"]["value"].get<double>() == 15);
      constexpr int line = 4, derivatives = 2; // through the end, for its noise; where it is smooth, there
      CHECK(found["evaluations"].get<int>() <= most + line + derivatives);
    }
}

TEST_CASE("a posterior by an emulator has bands of constants and of the curve, and the report shows them",
          "[apps][slow]")
{
  const ScratchFolder folder;
  write_curve_calibration(folder, "subsection Posterior\n  set Runs = 30\n  set Draws = 500\nend\n");
  const Outcome outcome = calibrate(folder, {"-o", "out"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
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
  REQUIRE(calibrate(folder, {"-o", "alone", "--processes", "1"}).status == 0);
  REQUIRE(calibrate(folder, {"-o", "three", "--processes", "3"}).status == 0);
  CHECK(content_of(folder / "three/calibration.json") == content_of(folder / "alone/calibration.json"));
  const auto with_cheap = [&](const std::string &changes) {
    write_calibration(folder,
                      replaced(text, "subsection Constants",
                               "subsection Cheap model\n  set Changes = " + changes + "\nend\nsubsection Constants"));
  };
  with_cheap("Loading/Tension/Strain rate=8; Output/Samples=20");
  const Outcome outcome = calibrate(folder, {"-o", "after"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
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
  const Outcome outcome = calibrate(folder, {"-o", "out"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
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
  const Outcome outcome = calibrate(folder, {"-o", "out"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
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
  const Outcome outcome = calibrate(folder, {"-o", "out"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
  const auto constants = nlohmann::json::parse(content_of(folder / "out/calibration.json"))["constants"];
  CHECK(constants["modulus"]["value"].get<double>() == Approx(27e9).epsilon(0.02));
  CHECK(constants["limit"]["value"].get<double>() == Approx(0.8e-4).epsilon(0.02));
  CHECK_THAT(content_of(folder / "out/constants.prm"),
             Contains("subsection Material\n  subsection CPM\n    set Normal modulus = "));
  CHECK(calibrate(folder, {"-o", "refused", "-s", "Targets/E/Reference scene=gone.prm"}).status == 2);
}

TEST_CASE("with as many figures as constants a search ends where the rest is less than matters, not at its last run",
          "[apps][slow]")
{
  const bool          known = GENERATE(true, false); // standard deviations
  const ScratchFolder folder;
  std::string         text = two_constants(stack_figures("33e9", "0.5e9"));
  if (!known)
    text = replaced(replaced(text, "set Standard deviation = 0.5e9", ""), "set Standard deviation = 1e5", "");
  write_calibration(folder, text);
  const Outcome outcome = calibrate(folder, {"-o", "out"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
  const auto found = nlohmann::json::parse(content_of(folder / "out/calibration.json"));
  CHECK(found["evaluations"].get<int>() < 40); // of at most 200
  const auto &targets = found["targets"];
  CHECK(targets["E"]["predicted"].get<double>() == Approx(33e9).epsilon(known ? 0.1 * 0.5 / 33 : 2e-3));
  CHECK(targets["f_t"]["predicted"].get<double>() == Approx(5.5e6).epsilon(known ? 0.1 * 0.1 / 5.5 : 2e-3));
}
