// Hard case S5, continuum: through the program, on a mesh of Gmsh.
#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

TEST_CASE("S5: indirect control follows the snap-back of a bar with one damaging element to 1 %", "[stability]")
{
  const apps_tests::ScratchFolder folder;
  const apps_tests::Outcome       outcome =
    apps_tests::run(folder.path(), {"run", places::sources() + "/apps/scenes/snap_back.prm", "-o", "results"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const postprocess::CsvTable series = postprocess::read_csv_table(folder / "results/series.csv");
  const auto                 &load = series.column("load_x"), &end = series.column("displacement_end_x");

  // An elastic bar in series with the damaging element, where sigma = f_t exp(-w_c / w_f) with w_c = h (kappa_D + omega f_t/E);
  // the plastic strain that the element has at the peak stays.
  const double E = 30e9, f_t = 3e6, w_f = 3e-5, length = 1, section = 0.05 * 0.05;
  const auto   peak    = static_cast<std::size_t>(std::max_element(load.begin(), load.end()) - load.begin());
  const double plastic = end[peak] - load[peak] / section * length / E; // elongation
  double       worst   = 0;
  int          past    = 0;
  for (std::size_t i = peak; i < load.size(); ++i)
    {
      const double stress = load[i] / section;
      if (stress > 0.98 * load[peak] / section)
        continue;
      ++past;
      worst = std::max(worst, std::fabs(end[i] / (stress * length / E - w_f * std::log(stress / f_t) + plastic) - 1));
    }
  CAPTURE(past, worst, load[peak] / section, end[peak], end.back());
  CHECK(load[peak] / section == Approx(f_t).epsilon(0.01));
  CHECK(past > 20);
  CHECK(worst < 0.01);
  CHECK(end.back() < 0.75 * *std::max_element(end.begin(), end.end())); // it did snap back
}
