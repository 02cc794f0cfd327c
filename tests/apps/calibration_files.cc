// breccia calibrate: what is read and refused before anything runs.
#include "apps/scene/kinds/read_scene.h"
#include "apps/studies/calibration_doubts.h"
#include "apps/studies/calibration_runs.h"
#include "apps/studies/measured_curve.h"
#include "base/errors.h"
#include "postprocess/files/csv_table.h"
#include "tests/apps/scenes.h"
#include "tests/apps/stack_calibration.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>

using namespace apps_tests;
using Catch::Contains;

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
     {"set Lower = 15e9", "set Lower = 15e9\n    set Targets = gone", "there is no target gone"},
     {"set Figure = young_modulus",
      "set Figure = young_modulus\n set Reference scene = stack.prm\n set Reference figure = gone",
      "reference of target E"},
     {"set Figure = young_modulus", "", "Targets/E/Curve"},
     {"set Value  = 1e9", "", "it must not be zero"},
     {"set Standard deviation = 1e8", "", "all or none"},
     {"set Figure = young_modulus", "set Curve = gone.csv", "gone.csv"},
     {"subsection Constants", "subsection Replicates\n set Seeds = 1\nend\nsubsection Constants",
      "wanted with Entry"}}));
  write_calibration(folder, replaced(calibration_of_stack(two_figures()), from, to));
  const Outcome outcome = run(folder.path(), {"calibrate", "calibration.prm", "-o", "out"});
  INFO(from << outcome.err);
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains(said));
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
      if (apps::kind_of_file(file) == apps::FileOf::study)
        CHECK(apps::plan_of(*apps::read_study(file, {})).changes.size() >= 5);
      else if (apps::kind_of_file(file) == apps::FileOf::calibration)
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
  write_calibration(folder, calibration_of_stack(two_figures()));
  const Outcome outcome = run(folder.path(), {"check", "calibration.prm"});
  INFO(outcome.err);
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("3 constants, 2 targets; 1 runs for each set of constants, at most 200 sets") &&
                            Contains("particles") && Contains("altogether   roughly"));
  CHECK_THAT(run(folder.path(), {"describe", "Cheap model", "--kind", "calibration"}).out, Contains("Changes"));
  CHECK_THAT(run(folder.path(), {"describe", "Axial distance"}).out, Contains("Scenes of kind study"));
}

TEST_CASE("a target that no run has is refused before the first run by name, with those that there are", "[apps]")
{
  const ScratchFolder folder;
  const auto [from, to, said] = GENERATE(table<std::string, std::string, std::string>(
    {{"young_modulus", "younger_modulus", "target E: there is no figure younger_modulus"},
     {"set Figure = young_modulus\n    set Value  = 1e9", "set Curve = measured.csv\n    set Ordinate = stretch",
      "target E: series.csv has no column stretch"}}));
  write_calibration(folder, replaced(calibration_of_stack(two_figures()), from, to));
  folder.file("measured.csv", "strain,stretch\n1e-5,1e5\n2e-5,2e5\n");
  const Outcome outcome = run(folder.path(), {"calibrate", "calibration.prm", "-o", "out"}); // starts no other process
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains(said) && (Contains("tensile_strength") || Contains("mean_damage")));
  CHECK_FALSE(std::filesystem::exists(folder / "out/runs"));
}

TEST_CASE("a curve that ends at its peak is distinguished from one that goes on", "[apps]")
{
  CHECK(apps::ends_at_its_peak(Eigen::Vector3d(1, 2, 3)));
  CHECK(apps::ends_at_its_peak(Eigen::Vector3d(-1, -2, -3))); // compression is negative
  CHECK_FALSE(apps::ends_at_its_peak(Eigen::Vector3d(1, 3, 2.9)));
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
