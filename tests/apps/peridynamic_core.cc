// Scenes of kind "peridynamic_core": elements with a core of bonds.
#include "tests/apps/runs_in_process.h"
#include "tests/apps/scene_runs.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string scene_file() { return places::sources() + "/apps/scenes/peridynamic_core.prm"; }

  /** The scene with a coarser core, which is quick. */
  std::vector<std::string> coarse(std::vector<std::string> more = {})
  {
    more.insert(more.begin(),
                {"Core/Grid/Spacing=0.005", "Core/Displacements/load/Lower=-0.006, 0.044, -1", "Output/Snapshots=0"});
    return more;
  }

  /** Without its notch, never breaking, and pressed slowly enough to be nearly in equilibrium. */
  apps::RunResult whole_beam(const ScratchFolder &folder, std::vector<std::string> more)
  {
    std::string       text  = content_of(scene_file());
    const std::size_t notch = text.find("  subsection Cracks\n"), after = text.find("  subsection No-fail zones\n");
    REQUIRE(notch < after);
    std::ofstream(folder / "whole.prm") << text.erase(notch, after - notch);
    more.insert(more.end(), {"Core/Material/Fracture energy=0", "Time/End time=8e-3"});
    return run_in_process(apps::read_scene(folder / "whole.prm", coarse(more)), folder / "results");
  }
} // namespace

TEST_CASE("A notched beam with a peridynamic core breaks near the load of linear fracture mechanics", "[apps][slow]")
{
  // K_I = P S / (B W^1.5) f(a/W) of a beam on supports 4 W apart (ASTM E399), K_Ic = sqrt(E G) in plane stress.
  const double a = 1.0 / 3, f = 3 * std::sqrt(a) * (1.99 - a * (1 - a) * (2.15 - 3.93 * a + 2.7 * a * a)) /
                                (2 * (1 + 2 * a) * std::pow(1 - a, 1.5));
  const double          load = std::sqrt(30e9 * 100.0) * 0.1 * std::pow(0.1, 1.5) / (0.4 * f);
  const ScratchFolder   folder;
  const apps::RunResult result =
    run_in_process(apps::read_scene(scene_file(), {"Output/Snapshots=0"}), folder / "results");
  CHECK(-result.figure("core_held_y/least").value.value() ==
        Approx(load).epsilon(0.15)); // its horizon is a ninth of the ligament
  CHECK(result.figure("broken_bonds/end").value.value() > 0);
  CHECK(result.figure("energy_balance_error").value.value() < 1e-3);
  const std::vector<double> &kinetic = result.series.column("energy_core_kinetic"),
                            &strain  = result.series.column("energy_core_strain");
  const double largest =
    std::max(*std::max_element(kinetic.begin(), kinetic.end()), *std::max_element(strain.begin(), strain.end()));
  CHECK(std::abs(result.figure("handshake_spurious").value.value()) < 1e-6 * largest);
}

TEST_CASE("A beam with a peridynamic core that stops half way goes on to the same bits, fracture included", "[apps]")
{
  const ScratchFolder      folder;
  const apps::CheckedScene scene = apps::read_scene(
    scene_file(), coarse({"Time/End time=2e-3", "Core/Displacements/load/y=-30 * t^2", "Output/Samples=20"}));
  const apps::RunResult whole = run_in_process(scene, folder / "whole");
  CHECK(whole.figure("broken_bonds/end").value.value() > whole.series.column("broken_bonds").front());
  apps::RunRequest request = apps::request_of(scene);
  request.output_folder    = folder / "parts";
  int requested            = 0;
  request.stop             = [&] { return ++requested > 14; };
  REQUIRE(scene.scene->run(request).end == apps::RunResult::End::interrupted);
  request.stop                = nullptr;
  request.resume              = true;
  const apps::RunResult parts = scene.scene->run(request);
  CHECK(parts.series.columns == whole.series.columns);
  CHECK(content_of(folder / "parts/nodes.csv") == content_of(folder / "whole/nodes.csv"));
  CHECK(parts.summary["figures"] == whole.summary["figures"]);
}

TEST_CASE("A scene with a core of another material than its elements is doubted, and check says how it steps", "[apps]")
{
  const auto said = [](const std::vector<std::string> &more) {
    return apps::read_scene(scene_file(), coarse(more)).scene->forecast();
  };
  const std::string like = said({}), unlike = said({"Core/Material/Young modulus=10e9"});
  CHECK_THAT(like, Contains("handshake    ") && Contains("steps        ") && Contains("duration     "));
  CHECK_THAT(like, !Contains("not of one material"));
  CHECK_THAT(unlike, Contains("not of one material"));
}

TEST_CASE("A beam with a peridynamic core is as stiff as one of elements alone, the nearer the shorter the horizon",
          "[apps][slow]")
{
  const ScratchFolder folder;
  // Of elements alone: the load on the same places of the upper edge, in equilibrium.
  std::string text = content_of(scene_file());
  const auto  cut  = [&](const std::string &from, const std::string &to) {
    const std::size_t begin = text.find(from), end = to.empty() ? text.size() : text.find(to, begin);
    REQUIRE(begin != std::string::npos);
    text.erase(begin, end - begin);
  };
  cut("subsection Core\n", "");
  cut("    set Density = 2400\n", "    subsection isotropic");
  cut("set Kind = peridynamic_core\n\nsubsection Continuum\n", "  subsection Model");
  text.erase(text.rfind("end\n"));
  text += "set Kind = continuum\nsubsection Supports\n  subsection load\n    set From = -0.006, 0.05, 0\n"
          "    set To = 0.006, 0.05, 0\n    set Displacement x = 0\n    set Displacement y = -1e-6 * t\n  end\nend\n";
  std::ofstream(folder / "elements.prm") << text;
  const apps::RunResult elements =
    run_in_process(apps::read_scene(folder / "elements.prm", {"Output/Snapshots=0", "Mesh/Boxes/beam/Divisions x=96",
                                                              "Mesh/Boxes/beam/Divisions y=20"}),
                   folder / "elements");
  const double wanted = std::abs(elements.series.column("reaction_load_y").back()) / 1e-6;
  const auto   error  = [&](const std::vector<std::string> &more) {
    std::filesystem::remove_all(folder / "results");
    const apps::RunResult      result = whole_beam(folder, more);
    const std::vector<double> &time = result.series.column("time"), &force = result.series.column("core_held_y");
    double                     sum = 0, moved = 0; // least squares over the later half
    for (std::size_t n = time.size() / 2; n < time.size(); ++n)
      {
        const double u = 3 * time[n] * time[n];
        sum += u * -force[n];
        moved += u * u;
      }
    return std::abs(sum / moved / wanted - 1);
  };
  // Free edges of the core lack bonds within a horizon: half of that, half of the error; the surface correction takes most of it.
  const std::vector<std::string> fine = {"Core/Grid/Spacing=0.0025", "Core/Displacements/load/Lower=-0.006, 0.047, -1"};
  std::vector<std::string>       surface = fine;
  surface.emplace_back("Core/Horizon/Surface correction=true");
  const double wide = error({}), narrow = error(fine), corrected = error(surface);
  CAPTURE(wanted, wide, narrow, corrected);
  CHECK(wide < 0.10);
  CHECK(narrow == Approx(wide / 2).epsilon(0.1));
  CHECK(corrected < 0.015);
}

namespace
{
  /** A plate that is stretched at an even rate, its sides driven as the exact motion says; the core lies in it with all four sides. */
  const char *const stretched_plate = R"(set Kind = peridynamic_core
subsection Continuum
  subsection Model
    set Dimension = 2
    set Plane     = stress
    set Thickness = 0.01
  end
  subsection Mesh
    set Source = bodies
    subsection Boxes
      subsection plate
        set Corner      = -0.2, -0.2, 0
        set Size        = 0.4, 0.4, 0
        set Divisions x = 20
        set Divisions y = 20
        set Material    = steel
      end
    end
  end
  subsection Materials
    subsection steel
      set Law     = isotropic elastic
      set Density = 7800
      subsection isotropic elastic
        set Young modulus = 200e9
        set Poisson ratio = 0.333333333333
      end
    end
  end
  subsection Supports
    subsection left
      set From           = -0.2, -0.2, 0
      set To             = -0.2, 0.2, 0
      set Displacement x = 10 * t * x
      set Displacement y = -10 / 3 * t * y
    end
    subsection right
      set From           = 0.2, -0.2, 0
      set To             = 0.2, 0.2, 0
      set Displacement x = 10 * t * x
      set Displacement y = -10 / 3 * t * y
    end
  end
  subsection Motion
    set Initial velocity x = 10 * x
    set Initial velocity y = -10 / 3 * y
  end
end
subsection Core
  subsection Body
    set Size      = 0.24, 0.24
    set Thickness = 0.01
  end
  subsection Grid
    set Spacing = 0.005
  end
  subsection Horizon
    set Ratio   = 4
    set Volumes = partial
  end
  subsection Material
    set Young modulus = 200e9
    set Density       = 7800
    set Calibration   = axis
  end
end
subsection Handshake
  set Sides   = left, right, bottom, top
  set Overlap = 0.06
end
subsection Time
  set End time = 2e-4
end
subsection Output
  set Samples   = 5
  set Snapshots = 0
end
)";
} // namespace

TEST_CASE("An even strain of elements with a peridynamic core inside stays even", "[apps]")
{
  const ScratchFolder folder;
  std::ofstream(folder / "even.prm") << stretched_plate;
  // Waves have crossed the plate more than twice. Over the displacement of its sides:
  const auto error = [&](const std::vector<std::string> &changes, const double within) {
    std::filesystem::remove_all(folder / "results");
    const apps::RunResult result = run_in_process(apps::read_scene(folder / "even.prm", changes), folder / "results");
    CHECK(result.figure("energy_balance_error").value.value() < 1e-10);
    const postprocess::CsvTable nodes = postprocess::read_csv_table(folder / "results/nodes.csv");
    double                      worst = 0;
    for (std::size_t n = 0; n < nodes.rows(); ++n)
      if (const double x = nodes.column("x")[n], y = nodes.column("y")[n]; std::max(std::abs(x), std::abs(y)) < within)
        worst = std::max({worst, std::abs(nodes.column("u_x")[n] - 10 * 2e-4 * x),
                          std::abs(nodes.column("u_y")[n] + 10 * 2e-4 / 3 * y)});
    return worst / (10 * 2e-4 * 0.2);
  };
  const std::string strict = "Handshake/Ties=strict", wide = "Core/Grid/Spacing=0.01";
  const double      coarse_ties = error({}, 0.06), of_all = error({strict}, 1), of_wide = error({strict, wide}, 1);
  CAPTURE(coarse_ties, of_all, of_wide);
  CHECK(coarse_ties <
        0.003); // where bonds are alone: the outermost nodes, which are light, means around nodes do not hold
  CHECK(of_all < 0.003);
  CHECK(of_all < of_wide / 3); // at half the horizon
}

namespace
{
  /** A bar of elements along which a bump runs; of section Continuum, or of a scene of its own. */
  const char *const bar = R"(  subsection Model
    set Dimension = 2
    set Plane     = stress
    set Thickness = 0.005
  end
  subsection Mesh
    set Source = bodies
    subsection Boxes
      subsection bar
        set Corner      = -0.8, -0.02, 0
        set Size        = 1.6, 0.04, 0
        set Divisions x = 160
        set Divisions y = 4
        set Material    = concrete
      end
    end
  end
  subsection Materials
    subsection concrete
      set Law     = isotropic elastic
      set Density = 2400
      subsection isotropic elastic
        set Young modulus = 25e9
        set Poisson ratio = 0.333333333333
      end
    end
  end
  subsection Points
    subsection p
      set Position = -0.3, 0, 0
    end
    subsection r
      set Position = 0.3, 0, 0
    end
  end
  subsection Motion
    set Initial velocity x = exp(-((x+0.4)/0.05)^2)
  end
)";

  /** What its middle is as well. */
  const char *const bar_core = R"(subsection Core
  subsection Body
    set Size      = 0.28, 0.04
    set Thickness = 0.005
  end
  subsection Grid
    set Spacing = 0.005
  end
  subsection Horizon
    set Volumes = partial
  end
  subsection Material
    set Young modulus = 25e9
    set Density       = 2400
    set Calibration   = axis
  end
end
subsection Handshake
  set Overlap = 0.04
end
)";

  const char *const often = "subsection Output\n  set Samples   = 270\n  set Snapshots = 0\nend\n";

  /** Of a column at a time between two rows. */
  double column_at(const postprocess::CsvTable &series, const std::string &column, const double time)
  {
    const std::vector<double> &times = series.column("time"), &values = series.column(column);
    const auto after = std::clamp<std::ptrdiff_t>(std::lower_bound(times.begin(), times.end(), time) - times.begin(), 1,
                                                  static_cast<std::ptrdiff_t>(times.size()) - 1);
    const auto n     = static_cast<std::size_t>(after);
    const double part = (time - times[n - 1]) / (times[n] - times[n - 1]);
    return values[n - 1] + part * (values[n] - values[n - 1]);
  }

  /** Mean velocity over 8 us [m/s]. */
  double velocity_at(const postprocess::CsvTable &series, const std::string &column, const double time)
  {
    constexpr double half = 4e-6;
    return (column_at(series, column, time + half) - column_at(series, column, time - half)) / (2 * half);
  }
} // namespace

TEST_CASE("A peridynamic core sends back less than a twentieth of a wave that comes from the elements", "[apps]")
{
  // Beside the same bar of elements alone, in which waves disperse alike.
  const ScratchFolder folder;
  std::ofstream(folder / "core.prm") << "set Kind = peridynamic_core\nsubsection Continuum\n"
                                     << bar << "end\n"
                                     << bar_core << "subsection Time\n  set End time = 0.27e-3\nend\n"
                                     << often;
  std::ofstream(folder / "elements.prm") << "set Kind = continuum\n" << bar << often;
  const apps::RunResult with    = run_in_process(apps::read_scene(folder / "core.prm", {}), folder / "with"),
                        without = run_in_process(apps::read_scene(folder / "elements.prm", {"Model/Analysis=explicit",
                                                                                            "Motion/End time=0.27e-3"}),
                                                 folder / "without");
  const double speed            = std::sqrt(25e9 / 2400);
  double       arriving = 0, back = 0, on = 0, on_alone = 0;
  for (double t = 1e-5; t < 0.26e-3; t += 1e-6)
    {
      arriving = std::max(arriving, velocity_at(without.series, "displacement_p_x", t));
      on       = std::max(on, velocity_at(with.series, "displacement_r_x", t));
      on_alone = std::max(on_alone, velocity_at(without.series, "displacement_r_x", t));
      if (t < 0.8 / speed) // before the other half comes back from the end
        back = std::max(back, std::abs(velocity_at(with.series, "displacement_p_x", t) -
                                       velocity_at(without.series, "displacement_p_x", t)));
    }
  CAPTURE(arriving, back, on, on_alone);
  CHECK(arriving > 0.4);
  CHECK(back > 0);
  CHECK(back < 0.05 * arriving);
  CHECK(on == Approx(on_alone).epsilon(0.01));
}
