// Poisson's ratio and the work of fracture that uniaxial tests report, against what is known of them.
#include "apps/figures/lab_report.h"
#include "apps/runs/uniaxial/sideways.h"
#include "dem/loading/curve_figures.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace apps_tests;

TEST_CASE("The work of fracture is the area under a curve times the gauge length", "[apps]")
{
  apps::LabNotes test;
  test.name             = "tension";
  test.gauge_length     = 0.1;
  test.section          = 1e-4;
  test.figures.strength = 2e6;
  dem::CurveFigures curve; // from rest along straight lines
  curve.add(1e-4, 2e6);
  curve.add(3e-4, 0.2e6);
  apps::note_work_of_fracture(test, curve.figures());
  CHECK(test.work_of_fracture == Approx(0.1 * (0.5 * 1e-4 * 2e6 + 0.5 * 2e-4 * 2.2e6)));
  CHECK(test.stress_left == Approx(0.1));
  test.figures.peak_passed = true;
  const auto figures       = apps::figures_of({test});
  CHECK(figures["work_of_fracture"]["value"].get<double>() == Approx(test.work_of_fracture));
  CHECK(figures["work_of_fracture"]["unit"] == "J/m^2");
  CHECK_FALSE(figures.contains("poisson_ratio"));

  apps::LabNotes cell;
  cell.figures.strength = 2e6;
  apps::note_work_of_fracture(cell, curve.figures()); // has no section to refer it to
  CHECK(cell.work_of_fracture == 0);
}

TEST_CASE("A uniaxial run reports Poisson's ratio near that of evenly spread links, and its work of fracture",
          "[apps][slow]")
{
  const ScratchFolder folder;
  const auto          figures = results_of(folder, places::sources() + "/apps/scenes/quick_uniaxial.prm",
                                           {"Loading/Tests=tension", "Output/Snapshots=0"}, {"test"})
                         .summary["figures"];
  INFO(figures.dump(1));
  const double even = (1 - 0.2) / (4 + 0.2); // doc/theory/homogenisation.md
  CHECK(figures["poisson_ratio"]["value"].get<double>() == Approx(even).margin(0.06));
  const double work = figures["work_of_fracture"]["value"], strength = figures["tensile_strength"]["value"],
               peak = figures["strain_at_tensile_peak"]["value"], length = figures["gauge_length"]["value"];
  CHECK(work > 0.5 * strength * peak * length); // more than is stored at the peak
  CHECK(figures["work_of_fracture"]["stress_left"].get<double>() < 1);
}
