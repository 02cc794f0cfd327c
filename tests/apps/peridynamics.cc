// Scenes of kind "peridynamics": what they find, refuse and remember.
#include "tests/apps/runs_in_process.h"
#include "tests/apps/scene_runs.h"
#include "tests/places.h"

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <vector>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string scene_of(const std::string &name)
  {
    return places::sources() + "/apps/scenes/peridynamic_" + name + ".prm";
  }

  apps::RunResult run_of(const ScratchFolder &folder, const std::string &name, const std::vector<std::string> &changes)
  {
    std::vector<std::string> all = changes;
    all.emplace_back("Output/Snapshots=0");
    return run_in_process(apps::read_scene(scene_of(name), all), folder / "results");
  }

  /** It is stopped half way, goes on, and is compared with one that was not: rows, nodes and figures. */
  void goes_on(const std::string &name, const std::vector<std::string> &changes, const int requested_before)
  {
    const ScratchFolder      folder;
    std::vector<std::string> all = changes;
    all.emplace_back("Output/Snapshots=0");
    const apps::CheckedScene scene   = apps::read_scene(scene_of(name), all);
    const apps::RunResult    whole   = run_in_process(scene, folder / "whole");
    apps::RunRequest         request = apps::request_of(scene);
    request.output_folder            = folder / "parts";
    int requested                    = 0;
    request.stop                     = [&] { return ++requested > requested_before; };
    REQUIRE(scene.scene->run(request).end == apps::RunResult::End::interrupted);
    request.stop                = nullptr;
    request.resume              = true;
    const apps::RunResult parts = scene.scene->run(request);
    CHECK(parts.series.columns == whole.series.columns);
    CHECK(content_of(folder / "parts/nodes.csv") == content_of(folder / "whole/nodes.csv"));
    CHECK(parts.summary["figures"] == whole.summary["figures"]);
  }

  /** Largest errors of u_x on y = 0 and of u_y on x = 0 of the pulled plate [%], from the table of nodes. */
  std::pair<double, double> errors_of_tension(const std::filesystem::path &table)
  {
    const postprocess::CsvTable nodes = postprocess::read_csv_table(table);
    CHECK(nodes.names == std::vector<std::string>{"x", "y", "z", "u_x", "u_y", "u_z", "damage", "volume"});
    CHECK(nodes.units == std::vector<std::string>{"m", "m", "m", "m", "m", "m", "-", "m^3"});
    double x_error = 0, y_error = 0;
    for (std::size_t n = 0; n < nodes.rows(); ++n)
      {
        const double x = nodes.column("x")[n], y = nodes.column("y")[n];
        if (std::abs(y) < 0.0051)
          x_error = std::max(x_error, std::abs(nodes.column("u_x")[n] + 1e-3 / 3 * x));
        if (std::abs(x) < 0.0051)
          y_error = std::max(y_error, std::abs(nodes.column("u_y")[n] - 1e-3 * y));
      }
    return {100 * x_error / (1e-3 / 3 * 0.495), 100 * y_error / (1e-3 * 0.245)};
  }
} // namespace

namespace
{
  /** Every name that comparisons with other codes write; of alternatives the first. */
  const char *const all_names = R"(set Kind = peridynamics
subsection Body
  set Size      = 0.5, 0.4
  set Thickness = 0.02
end
subsection Grid
  set Spacing = 0.02
  set Layout  = cell-centred
end
subsection Horizon
  set Ratio   = 3.015
  set Volumes = full
end
subsection Material
  set Young modulus    = 200e9
  set Model            = prototype
  set Critical stretch = 0.0058
  set Calibration      = none
end
subsection Holes
  subsection middle
    set Centre = 0, 0
    set Radius = 0.06
  end
end
subsection Tractions
  subsection one
    set Boundary = left
    set Value    = -150e6, 0
    set Weight   = paper
    set Form     = transfer
  end
  subsection other
    set Boundary = right
    set Value    = 150e6, 0
    set Weight   = paper
    set Form     = transfer
  end
end
subsection Analysis
  set Method = static
end
subsection Output
  set Snapshots = 0
end
)";
} // namespace

TEST_CASE("Scenes and results have the names that comparisons with other codes rely on", "[apps]")
{
  const ScratchFolder folder;
  std::ofstream(folder / "names.prm") << all_names;
  const auto run_with = [&](const std::vector<std::string> &changes) {
    std::filesystem::remove_all(folder / "results");
    return run_in_process(apps::read_scene(folder / "names.prm", changes), folder / "results");
  };
  const auto check = [&](const std::vector<std::string> &changes) {
    CAPTURE(changes);
    const apps::RunResult result = run_with(changes);
    const std::string     nodes  = content_of(folder / "results/nodes.csv");
    CHECK(nodes.substr(0, nodes.find('\n')) == "x [m],y [m],z [m],u_x [m],u_y [m],u_z [m],damage [-],volume [m^3]");
    CHECK(postprocess::read_csv_table(folder / "results/nodes.csv").rows() ==
          result.summary["cost"]["nodes"].get<std::size_t>());
    const nlohmann::json summary = nlohmann::json::parse(content_of(folder / "results/summary.json"));
    CHECK(summary["figures"]["lattice"]["young_modulus"]["value"].is_number());
    CHECK(summary["figures"]["lattice"]["poisson_ratio"]["value"].is_number());
    return summary["figures"];
  };
  const nlohmann::json found = check({});
  // The load factor times the first traction.
  CHECK(found["first_break"]["value"].get<double>() ==
        Approx(150e6 * found["first_break"]["load_factor"].get<double>()).epsilon(1e-12));
  check({"Grid/Layout=boundary nodes"});
  check({"Horizon/Volumes=partial", "Material/Calibration=axis"});
  check({"Material/Model=general", "Material/Calibration=bulk"});
  check({"Material/Critical stretch=0", "Material/Fracture energy=72640"});
  check({"Tractions/one/Weight=consistent", "Tractions/other/Weight=consistent"});
  check({"Tractions/one/Form=layer", "Tractions/other/Form=layer"});
  check({"Tractions/one/Boundary=bottom", "Tractions/one/Value=0, -150e6", "Tractions/other/Boundary=top",
         "Tractions/other/Value=0, 150e6"});
  check({"Analysis/Method=relaxation"});
  check({"Analysis/Method=motion", "Analysis/End time=2e-5", "Material/Density=8000"});
  check({"Body/Size=0.5, 0.4, 0.1", "Horizon/Ratio=2", "Tractions/one/Boundary=back",
         "Tractions/one/Value=0, 0, -150e6", "Tractions/other/Boundary=front", "Tractions/other/Value=0, 0, 150e6"});
}

TEST_CASE("Of a body that nothing holds the rigid motion is removed from the table of nodes", "[apps]")
{
  const ScratchFolder folder;
  run_of(folder, "tension", {"Grid/Spacing=0.02"});
  const postprocess::CsvTable nodes  = postprocess::read_csv_table(folder / "results/nodes.csv");
  double                      sum[3] = {0, 0, 0}, most = 0, volume = 0;
  for (std::size_t n = 0; n < nodes.rows(); ++n)
    {
      const double v = nodes.column("volume")[n], x = nodes.column("x")[n], y = nodes.column("y")[n],
                   ux = nodes.column("u_x")[n], uy = nodes.column("u_y")[n];
      volume += v;
      sum[0] += v * ux;
      sum[1] += v * uy;
      sum[2] += v * (x * uy - y * ux);
      most = std::max({most, std::abs(ux), std::abs(uy)});
    }
  CHECK(most > 0);
  for (const double part : sum)
    CHECK(std::abs(part) < 1e-12 * most * volume);
}

TEST_CASE("A plate that a scene pulls has the published errors, calibrated and not, at rest by either method", "[apps]")
{
  const ScratchFolder folder;
  const auto          check = [&](const std::vector<std::string> &changes, const double across, const double along) {
    const apps::RunResult result = run_of(folder, "tension", changes);
    const auto [x, y]            = errors_of_tension(folder / "results/nodes.csv");
    CHECK(x == Approx(across).margin(0.2).epsilon(0));
    CHECK(y == Approx(along).margin(0.2).epsilon(0));
    return result;
  };
  check({}, 3.4, 0.8);
  const apps::RunResult raw = check({"Material/Calibration=none"}, 7.7, 5.4);
  CHECK(raw.figure("lattice/young_modulus").value.value() == Approx(1.0486 * 200e9).epsilon(5e-5));
  CHECK(raw.figure("lattice/poisson_ratio").value.value() == Approx(0.3182).margin(5e-5));
  check({"Material/Calibration=none", "Analysis/Method=relaxation", "Analysis/Kinematics=nonlinear"}, 7.7, 5.4);
}

TEST_CASE("The rod of a scene has the displacement of the continuum", "[apps]")
{
  const ScratchFolder   folder;
  const apps::RunResult result = run_of(folder, "bar", {});
  CHECK(result.figure("largest_displacement").value.value() == Approx(1e-3 * 0.495).epsilon(1e-10));
}

TEST_CASE("The first bond of a scene's plate with a hole breaks at 377.5 MPa, whether the load comes to it or not",
          "[apps]")
{
  const ScratchFolder   folder;
  const apps::RunResult below = run_of(folder, "hole", {"Material/Critical stretch=0.0058"});
  CHECK(below.figure("first_break").value.value() == Approx(377.5e6).margin(0.2e6).epsilon(0));
  CHECK(below.summary["figures"]["broken_bonds"] == 0);
}

TEST_CASE("The plate with a hole holds at 376 MPa and breaks through at 380 MPa", "[apps][slow]")
{
  const ScratchFolder   folder;
  const apps::RunResult holds =
    run_of(folder, "hole",
           {"Material/Critical stretch=0.0058", "Tractions/below/Value=0, -376e6", "Tractions/above/Value=0, 376e6"});
  CHECK(holds.summary["figures"]["broken_bonds"] == 0);
  const apps::RunResult breaks = run_of(folder, "fracture", {});
  CHECK(breaks.figure("broken_through").value.value() == Approx(380e6).epsilon(1e-12));
  CHECK(breaks.figure("first_break").value.value() == Approx(377.5e6).margin(0.2e6).epsilon(0));
}

TEST_CASE("A traction on a boundary that has cracked is doubted", "[apps]")
{
  const ScratchFolder            folder;
  const std::vector<std::string> cut = {"Grid/Spacing=0.02", "Cracks/corner/From=0, 0.26", "Cracks/corner/To=0, 0.2"};
  const auto                     outcome = [](const apps::RunResult &result) {
    return result.summary["warnings"].dump().find("Tractions/above: damage is") != std::string::npos;
  };
  CHECK_FALSE(outcome(run_of(folder, "tension", {"Grid/Spacing=0.02"})));
  // Between two columns of nodes; a second crack beside it leaves one column hanging by its lower bonds.
  std::vector<std::string> twice = cut;
  twice.emplace_back("Cracks/beside/From=0.02, 0.26");
  twice.emplace_back("Cracks/beside/To=0.02, 0.2");
  const apps::RunResult cracked = run_of(folder, "tension", twice);
  CHECK(outcome(cracked));
  CHECK_THAT(cracked.words, Catch::Contains("\nwarning      Tractions/above: damage is"));
}

TEST_CASE("Bodies that are torn to pieces at rest end as broken through, by either solver and kinematics", "[apps]")
{
  const ScratchFolder folder;
  for (const char *kinematics : {"linear", "nonlinear"})
    for (const char *solver : {"direct", "iterative"})
      {
        CAPTURE(kinematics, solver);
        const apps::RunResult torn =
          run_of(folder, "fracture",
                 {"Grid/Spacing=0.025", "Analysis/Load increments=2", "Material/Critical stretch=0.003",
                  "Tractions/below/Value=0, -2e9", "Tractions/above/Value=0, 2e9",
                  std::string("Analysis/Kinematics=") + kinematics, std::string("Analysis/Solver=") + solver});
        CHECK(torn.figure("broken_through").value.has_value());
        std::filesystem::remove_all(folder / "results");
      }
}

namespace
{
  /** Places of nodes at a crack: those that lost more than a third of their bonds. */
  std::vector<Eigen::Vector2d> crack_in(const std::filesystem::path &table)
  {
    const postprocess::CsvTable  nodes = postprocess::read_csv_table(table);
    std::vector<Eigen::Vector2d> found;
    for (std::size_t n = 0; n < nodes.rows(); ++n)
      if (nodes.column("damage")[n] > 0.35)
        found.emplace_back(nodes.column("x")[n], nodes.column("y")[n]);
    return found;
  }
} // namespace

TEST_CASE("Cracks leave the notches of a struck plate at 65 to 70 degrees, as measured, slower than Rayleigh waves",
          "[apps][slow]")
{
  // Kalthoff and Winkler (1988). The notches go down to y = 0; a crack that goes on has 0 degrees to them.
  const ScratchFolder   folder;
  const apps::RunResult found = run_of(folder, "impact", {});
  for (const int side : {-1, 1})
    {
      // The direction of least squares of what is cracked 5 mm to 50 mm from the tip, on the side away from the blow.
      std::vector<Eigen::Vector2d> path;
      for (const Eigen::Vector2d &x : crack_in(folder / "results/nodes.csv"))
        if (const Eigen::Vector2d from(side * x.x() - 0.025, -x.y());
            from.minCoeff() > 0 && from.norm() > 5e-3 && from.norm() < 50e-3)
          path.push_back(from);
      REQUIRE(path.size() > 50);
      Eigen::Vector2d middle = Eigen::Vector2d::Zero();
      for (const Eigen::Vector2d &x : path)
        middle += x / static_cast<double>(path.size());
      double xx = 0, xy = 0, yy = 0;
      for (const Eigen::Vector2d &x : path)
        {
          xx += (x - middle).x() * (x - middle).x();
          xy += (x - middle).x() * (x - middle).y();
          yy += (x - middle).y() * (x - middle).y();
        }
      const double angle = 0.5 * std::atan2(2 * xy, yy - xx) * 180 / std::acos(-1.0);
      CAPTURE(side, angle);
      CHECK(angle > 65);
      CHECK(angle < 70);
    }
  // While the two run alone, 25 to 45 microseconds after the blow: both grow by what is released over the energy of a crack.
  const std::vector<double> &time = found.series.column("time"), &released = found.series.column("energy_released");
  const auto                 at = [&](const double t) {
    return released[static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), t) - time.begin())];
  };
  const double speed    = (at(45e-6) - at(25e-6)) / (2 * 22170 * 0.001) / 20e-6,
               shear    = std::sqrt(190e9 / (2 * 1.25) / 8000),
               rayleigh = (0.862 + 1.14 * 0.25) / 1.25 * shear; // Bergmann's formula, Poisson's ratio 1/4
  CAPTURE(speed, rayleigh);
  CHECK(speed > 0.5 * rayleigh);
  CHECK(speed < rayleigh);
}

TEST_CASE("A crack in glass branches, once and on both sides alike", "[apps][slow]")
{
  const ScratchFolder folder;
  run_of(folder, "branching", {});
  /** Heights at which a column of nodes is cracked, apart by more than three spacings. */
  std::map<int, std::vector<double>> heights;
  for (const Eigen::Vector2d &x : crack_in(folder / "results/nodes.csv"))
    heights[static_cast<int>(std::floor(x.x() / 0.0005))].push_back(x.y());
  const auto branches = [&](const double x) {
    std::vector<double> at = heights[static_cast<int>(std::floor(x / 0.0005))];
    std::sort(at.begin(), at.end());
    int n = at.empty() ? 0 : 1;
    for (std::size_t k = 1; k < at.size(); ++k)
      n += at[k] - at[k - 1] > 1.6e-3 ? 1 : 0;
    return n;
  };
  CHECK(branches(-0.01) == 1); // the notch
  CHECK(branches(0.010) == 1);
  CHECK(branches(0.035) == 2);
}

TEST_CASE("An interface breaks at its own critical stretch in a scene of two materials", "[apps]")
{
  const ScratchFolder folder;
  std::string         text   = content_of(scene_of("bar"));
  const std::string   single = "  set Young modulus = 200e9\n";
  REQUIRE(text.find(single) != std::string::npos);
  std::ofstream(folder / "two.prm") << text.erase(text.find(single), single.size());
  const std::vector<std::string> two  = {"Output/Snapshots=0",
                                         "Materials/one/Young modulus=200e9",
                                         "Materials/one/Critical stretch=5e-3",
                                         "Materials/other/Young modulus=200e9",
                                         "Materials/other/Critical stretch=5e-3",
                                         "Regions/right/Material=other",
                                         "Regions/right/Shape=box",
                                         "Regions/right/Lower=0, -1, -1",
                                         "Regions/right/Upper=1, 1, 1"};
  std::vector<std::string>       weak = two;
  for (const char *entry : {"Material=one", "Other material=other", "Critical stretch=2e-3"})
    weak.push_back(std::string("Interfaces/joint/") + entry);
  const apps::RunResult joined = run_in_process(apps::read_scene(folder / "two.prm", two), folder / "joined");
  const apps::RunResult held   = run_in_process(apps::read_scene(folder / "two.prm", weak), folder / "held");
  CHECK(joined.figure("first_break").value.value() == Approx(5e-3 * 200e9).epsilon(1e-6));
  CHECK(held.figure("first_break").value.value() == Approx(2e-3 * 200e9).epsilon(1e-6));
  CHECK(held.summary["figures"]["lattice_of"]["other"]["neighbours"] == 6);
}

TEST_CASE("A peridynamic run that was stopped goes on to the same bits, fracture included", "[apps][slow]")
{
  const std::vector<std::string> coarse = {"Grid/Spacing=0.001", "Analysis/End time=3e-5"};
  goes_on("branching", coarse, 40);
  std::vector<std::string> repelling = coarse;
  repelling.emplace_back("Analysis/Repulsion=15");
  goes_on("branching", repelling, 40);
  goes_on("bending", {"Grid/Spacing=0.02"}, 3);
  goes_on("fracture", {"Grid/Spacing=0.0125", "Analysis/Load increments=4", "Material/Critical stretch=0.004"}, 3);
}

TEST_CASE("What check says of a peridynamic motion is what its run takes", "[apps]")
{
  const ScratchFolder      folder;
  const apps::CheckedScene scene =
    apps::read_scene(scene_of("branching"), {"Grid/Spacing=0.001", "Analysis/End time=2e-5", "Output/Snapshots=0"});
  const std::string     said  = scene.scene->forecast();
  const apps::RunResult found = run_in_process(scene, folder / "results");
  CHECK_THAT(said, Contains("steps        ") && Contains("nodes        4000"));
  const double steps = std::stod(said.substr(said.find("steps        ") + 13));
  CHECK(found.summary["figures"]["steps"].get<double>() == Approx(steps).margin(1.01));
  CHECK(found.figure("energy_balance_error").value.value() < 1e-3);
}
