// Requirements of a laboratory on a uniaxial test: section and gauge length, figures from every step, one piece, cracks reported.
#include "apps/runs/quasi_static/lab_test.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  double value(const nlohmann::json &summary, const char *figure) { return summary["figures"][figure]["value"]; }

  /** The summary of a run of the stack with these settings, pulled only. */
  nlohmann::json pulled(const ScratchFolder &folder, std::vector<std::string> settings)
  {
    std::vector<std::string> arguments = {"run", "x.prm", "-o", "results", "-s", "Loading/Tests=tension"};
    for (const std::string &setting : settings)
      arguments.insert(arguments.end(), {"-s", setting});
    const Outcome outcome = run(folder.path(), arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return summary_in(folder / "results");
  }

  ScratchFolder &with_stack(ScratchFolder &folder)
  {
    folder.file("packing.txt", stack_packing());
    folder.file("x.prm", scene_with_file());
    return folder;
  }
} // namespace

TEST_CASE("Strength, modulus and dissipation are those of every step, whatever the rows of the series", "[apps]")
{
  ScratchFolder        folder;
  const nlohmann::json few  = pulled(with_stack(folder), {"Output/Samples=3", "Output/Snapshots=0"}),
                       many = pulled(folder, {"Output/Samples=400", "Output/Snapshots=0"});
  CHECK(few["figures"] == many["figures"]);
  CHECK(value(few, "young_modulus") > 0);
  CHECK(value(few, "tensile_strength") > 0);
  CHECK(few["tests"][0]["energy"]["damage"] == many["tests"][0]["energy"]["damage"]);
  CHECK(few["tests"][0]["steps"] == many["tests"][0]["steps"]);
}

TEST_CASE("A figure that a test does not determine is null in the summary, with the reason, and so on the terminal",
          "[apps]")
{
  ScratchFolder folder;
  with_stack(folder);
  const Outcome outcome =
    run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Loading/Tests=tension", "-s",
                        "Loading/Tension/Stop strain=3e-5", "-s", "Loading/Tension/Strain rate=0.5"});
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out,
             Contains("largest stress") && Contains("no peak") && !Contains("strength") && !Contains("nan"));
  const nlohmann::json figures = summary_in(folder / "results")["figures"];
  CHECK(figures["tensile_strength"]["value"].is_null());
  CHECK_THAT(figures["tensile_strength"]["not_determined"].get<std::string>(), Contains("may be passed yet"));
  CHECK(figures["young_modulus"]["value"].get<double>() > 0);
}

TEST_CASE("A local drop of the stress is no peak: it must have fallen for good, or the strain gone well beyond",
          "[apps]")
{
  apps::QuasiStaticResult result;
  result.load                = apps::UniaxialLoad::compression;
  result.stop_fraction       = 0.7;
  const auto determined_with = [&result](const double strain, const double stress) {
    result.add({}, strain, stress);
    return result.notes.figures.peak_passed;
  };
  CHECK_FALSE(determined_with(-9e-4, -22e6));
  CHECK_FALSE(determined_with(
    -1e-3, -21e6)); // a cascade has taken something: the end of the test in the middle of it says nothing
  CHECK(determined_with(-1.1e-3, -17e6)); // fallen below 0.8 of the largest
  CHECK_FALSE(determined_with(-1.2e-3, -25e6));
  CHECK_FALSE(determined_with(-1.7e-3, -24e6));
  CHECK(determined_with(-1.81e-3, -24e6)); // no larger stress up to 1.5 times its strain
  CHECK(result.notes.figures.strength == 25e6);

  apps::QuasiStaticResult ended;
  ended.stop_fraction = 0.95; // the user's own word for fallen
  ended.add({}, 1e-4, 3e6);
  ended.add({}, 1.1e-4, 2.84e6);
  CHECK(ended.notes.figures.peak_passed);
}

TEST_CASE("The section is nominal or the user's own, and the gauge length what the scene says", "[apps]")
{
  ScratchFolder        folder;
  const nlohmann::json nominal = pulled(with_stack(folder), {}), own = pulled(folder, {"Loading/Area=1e-4"}),
                       ends    = pulled(folder, {"Loading/Gauge length=outermost centres"}),
                       between = pulled(folder, {"Loading/Gauge length=planes", "Loading/Gauge low plane=2.5e-3",
                                                 "Loading/Gauge high plane=7.5e-3"});
  // Widths of the stack with the radii: 4.5 spacings along x, 4 + 2/6 rows of sqrt(3)/2 along y.
  const double s = 2.04e-3, width = 4.5 * s + 2e-3, depth = s * std::sqrt(3.0) / 2 * (4 + 1.0 / 3) + 2e-3;
  CHECK(value(nominal, "section") == Approx(width * depth).epsilon(1e-9));
  CHECK(value(own, "section") == 1e-4);
  CHECK(value(own, "tensile_strength") * 1e-4 ==
        Approx(value(nominal, "tensile_strength") * width * depth).epsilon(1e-12));
  CHECK(value(nominal, "gauge_length") == Approx(6 * s * std::sqrt(2.0 / 3.0)).epsilon(1e-9)); // one layer gripped
  CHECK(value(ends, "gauge_length") == value(nominal, "gauge_length"));
  CHECK(value(between, "gauge_length") == Approx(5e-3).epsilon(1e-12));
  CHECK(value(between, "young_modulus") == Approx(value(nominal, "young_modulus")).epsilon(0.15));
  CHECK(value(between, "young_modulus") != value(nominal, "young_modulus"));
}

TEST_CASE("Section and gauge length are on the terminal of run and check, and refused if wrong", "[apps][S14]")
{
  ScratchFolder folder;
  with_stack(folder);
  const Outcome check = run(folder.path(), {"check", "x.prm"});
  CHECK_THAT(check.out, Contains("section") && Contains("nominal") && Contains("gauge length"));
  const Outcome ran = run(folder.path(), {"run", "x.prm", "-o", "r", "-s", "Loading/Tests=tension"});
  CHECK_THAT(ran.out, Contains("section") && Contains("gauge length"));
  const auto refused = [&](const std::vector<std::string> &settings, const std::string &reason) {
    std::vector<std::string> arguments = {"run", "x.prm", "-o", "results"};
    for (const std::string &setting : settings)
      arguments.insert(arguments.end(), {"-s", setting});
    const Outcome outcome = run(folder.path(), arguments);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(reason));
    CHECK_FALSE(std::filesystem::exists(folder / "results"));
  };
  refused({"Loading/Area=-1"}, "Loading/Area");
  refused({"Loading/Area=large"}, "Loading/Area");
  refused({"Loading/Gauge length=planes", "Loading/Gauge low plane=3e-3", "Loading/Gauge high plane=1e-3"},
          "Gauge high plane");
  refused({"Loading/Gauge length=planes", "Loading/Gauge low plane=3e-3", "Loading/Gauge high plane=0.4"},
          "Gauge planes");
}

TEST_CASE("A specimen in several pieces, or with strays, is refused with numbers unless the scene says otherwise",
          "[apps][S14]")
{
  ScratchFolder      folder;
  std::ostringstream far_apart;
  std::istringstream lines(stack_packing());
  std::string        line;
  while (std::getline(lines, line))
    {
      double x = 0, y = 0, z = 0, radius = 0;
      std::istringstream(line) >> x >> y >> z >> radius;
      far_apart << line << '\n';
      if (line[0] != '#' && z > 8e-3)
        far_apart << x << ' ' << y << ' ' << z + 0.04 << ' ' << radius << '\n';
    }
  folder.file("x.prm", scene_with_file());
  folder.file("packing.txt", far_apart.str());
  for (const char *command : {"check", "run"})
    {
      const Outcome outcome = run(folder.path(), {command, "x.prm"});
      CHECK(outcome.status == 2);
      CHECK_THAT(outcome.err, Contains("2 pieces") && Contains("175, 50") && Contains("Loose pieces"));
    }
  folder.file("packing.txt", stack_packing() + "0 0 0.5 1e-3\n");
  const Outcome stray = run(folder.path(), {"run", "x.prm"});
  CHECK(stray.status == 2);
  CHECK_THAT(stray.err, Contains("1 of 176 particles are linked to nothing"));
  const Outcome dropped = run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Specimen/Loose pieces=drop", "-s",
                                              "Loading/Tests=tension"});
  INFO(dropped.err);
  CHECK(dropped.status == 0);
  CHECK(summary_in(folder / "results")["cost"]["particles"] == 175);
  const Outcome kept = run(folder.path(), {"check", "x.prm", "-s", "Specimen/Loose pieces=keep"});
  CHECK(kept.status == 0);
  CHECK_THAT(kept.out, Contains("particles    176"));
}

TEST_CASE("Cracked links and the crack's area are reported beside deleted ones; a crack at a grip is a warning",
          "[apps]")
{
  ScratchFolder folder;
  folder.file("packing.txt", pair_packing());
  folder.file("x.prm", scene_with_file());
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Loading/Tests=tension", "-s",
                                              "Loading/Tension/Stop strain=6e-3"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  // The one link has lost four fifths of its strength, hence nearly all of its stiffness, but is not deleted.
  CHECK_THAT(outcome.out, Contains("1 of 1 links cracked") && Contains("0 deleted") && Contains("touches a grip"));
  const nlohmann::json summary = summary_in(folder / "results");
  CHECK(summary["tests"][0]["cracked_links"] == 1);
  CHECK(summary["tests"][0]["broken_links"] == 0);
  CHECK(summary["tests"][0]["crack_area"]["value"].get<double>() > 0);
  CHECK_THAT(summary["warnings"][0].get<std::string>(), Contains("touches a grip"));
  CHECK(content_of(folder / "results/series.csv").find("\ntension,") != std::string::npos);
}
