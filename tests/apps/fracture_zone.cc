// How wide the zone is in which a body fails, and the length of a nonlocal law that makes it so wide.
#include "apps/figures/fracture_zone.h"

#include "postprocess/files/csv_table.h"
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/stack_calibration.h"
#include "tests/places.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>
#include <random>
#include <sstream>

using namespace apps_tests;

namespace
{
  /** As much at each of many places, evenly spread over a block. */
  apps::SpreadAmount even_block(const Eigen::Vector3d &middle, const Eigen::Vector3d &size, const double amount)
  {
    constexpr int      n = 40;
    apps::SpreadAmount all;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k)
          {
            const Eigen::Vector3d part = (Eigen::Vector3d(i, j, k).array() + 0.5) / n - 0.5;
            all.add(amount / (n * n * n), middle + part.cwiseProduct(size));
          }
    return all;
  }
} // namespace

TEST_CASE(
  "fracture zone: an even one has its own width, whichever way it lies, and nothing counts before the load has fallen",
  "[apps]")
{
  const Eigen::Vector3d size(0.03, 0.004, 0.05);
  const auto            before = even_block({0, 0, 0}, {0.1, 0.1, 0.1}, 3.0);
  apps::SpreadAmount    after  = before;
  const Eigen::Matrix3d turn   = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  constexpr int         n      = 40;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        after.add(2e-5, Eigen::Vector3d(0.2, 0.1, 0.3) +
                          turn * ((Eigen::Vector3d(i, j, k).array() + 0.5) / n - 0.5).matrix().cwiseProduct(size));
  apps::FractureZone zone;
  CHECK(!zone.width(3));
  zone.note(1, {});
  zone.note(5, even_block({0.5, 0, 0}, {0.1, 0.1, 0.1}, 1.0));
  zone.note(4.1, before);
  CHECK(!zone.width(3)); // nothing is lost since the peak
  zone.note(2, after);
  const double of_cells =
    std::sqrt(1 - 1.0 / (n * n)); // places in the middle of each cell have less spread than the cells
  // Moments are about the origin, a hundred times as far away as the zone is wide: four digits of the sums are lost.
  CHECK(zone.width(3).value() == Approx(0.004 * of_cells).epsilon(1e-6));
}

namespace
{
  std::string bar_with(const std::string &length, const std::string &size)
  {
    std::string scene = content_of(places::sources() + "/apps/scenes/studies/law_zone.prm");
    scene             = replaced(scene, "../../..", places::sources());
    scene             = replaced(scene, "Nonlocal length      = 0.01", "Nonlocal length = " + length);
    return replaced(scene, "Element size         = 0.008", "Element size = " + size);
  }

  /** To all digits of the summary. */
  std::string width_in(const std::filesystem::path &results, const std::string &figure)
  {
    const auto   summary = nlohmann::json::parse(content_of(results / "summary.json"));
    const double width   = summary.at("figures").at(figure).at("value");
    REQUIRE(width > 0);
    return figure + " " + summary.at("figures").at(figure).dump();
  }
} // namespace

TEST_CASE("fracture zone: a run of particles that was stopped beyond its peak goes on to the same width",
          "[apps][slow][S13]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  std::string scene = replaced(scene_with_file(), "set Strain rate = 4", "set Strain rate = 1");
  folder.file("x.prm", replaced(scene, "  set Snapshots = 5",
                                "  set Snapshots = 40\n  set Checkpoint interval = 0.01\n  set Fracture zone = true"));
  const InterruptedRun beyond_peak = {{"run", "x.prm"},
                                      {"tension_links/tension_links_000020.vtp", "checkpoint.h5"},
                                      [](const std::filesystem::path &results) {
                                        return content_of(results / "series.csv") +
                                               width_in(results, "tension_fracture_zone_width") +
                                               width_in(results, "compression_fracture_zone_width");
                                      }};
  goes_on_to_the_same_bits(folder, beyond_peak, {SIGINT, SIGKILL});
}

TEST_CASE("fracture zone: a run of a bar that was stopped beyond its peak goes on to the same width",
          "[apps][slow][S13]")
{
  const ScratchFolder folder;
  std::string         scene = bar_with("0.01", "0.008");
  folder.file("x.prm",
              replaced(scene, "set Snapshots        = 0", "set Snapshots = 20\n  set Checkpoint interval = 0.001"));
  const InterruptedRun beyond_peak = {
    {"run", "x.prm"}, {"checkpoint.h5", "solid/solid_000010.vtu"}, [](const std::filesystem::path &results) {
      return content_of(results / "series.csv") + width_in(results, "fracture_zone_width");
    }};
  goes_on_to_the_same_bits(folder, beyond_peak, {SIGINT, SIGKILL});
}

TEST_CASE("a nonlocal length is recovered within its bars from the width of the zone that fails and a curve",
          "[apps][slow]")
{
  const ScratchFolder folder;
  folder.file("truth.prm", bar_with("0.014", "0.012"));
  folder.file("bar.prm", bar_with("0.01", "0.008"));
  REQUIRE(run(folder.path(), {"run", "truth.prm", "-o", "truth"}).status == 0);
  std::mt19937               stream(9);
  std::normal_distribution<> noise(0, 1);
  const double               width =
    nlohmann::json::parse(content_of(folder / "truth/summary.json"))["figures"]["fracture_zone_width"]["value"];
  const auto         series = postprocess::read_csv_table(folder / "truth/series.csv", true, {});
  const auto        &top = series.column("displacement_top_z"), &force = series.column("reaction_top_z");
  constexpr double   deviation = 20; // N, of a peak of 3000
  std::ostringstream curve;
  curve << "displacement_top_z [m],reaction_top_z [N]\n";
  for (std::size_t row = 2; row < top.size(); row += 2)
    curve << top[row] << "," << force[row] + deviation * noise(stream) << "\n";
  folder.file("curve.csv", curve.str());
  std::ostringstream text;
  text << R"(set Kind       = calibration
set Base scene = bar.prm
subsection Search
  set Step = 0.01
end
subsection Constants
  subsection length
    set Entry   = Materials/solid/damage-plastic concrete/Nonlocal length
    set Targets = zone
    set Start = 0.01
    set Lower = 0.005
    set Upper = 0.03
  end
  subsection size
    set Entry = Materials/solid/damage-plastic concrete/Element size
    set Start = 0.008
    set Lower = 0.004
    set Upper = 0.03
  end
end
subsection Targets
  subsection zone
    set Figure             = fracture_zone_width
    set Value              = )"
       << width * (1 + 0.02 * noise(stream)) << "\n    set Standard deviation = " << 0.02 * width << R"(
  end
  subsection force
    set Curve              = curve.csv
    set Abscissa           = displacement_top_z
    set Ordinate           = reaction_top_z
    set Standard deviation = )"
       << deviation << "\n  end\nend\n";
  folder.file("calibration.prm", text.str());
  const Outcome outcome = calibrate(folder, {"-o", "out"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
  const auto constants = nlohmann::json::parse(content_of(folder / "out/calibration.json"))["constants"];
  for (const auto &[name, truth] : {std::pair("length", 0.014), std::pair("size", 0.012)})
    {
      INFO(name);
      const double value = constants[name]["value"], error = constants[name]["standard_error"];
      CHECK(constants[name]["determined"] == true);
      CHECK(std::fabs(value - truth) < 3 * error);
      CHECK(error < 0.1 * truth);
    }
}
