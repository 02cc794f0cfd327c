// What ParaView would read of a continuum run, read by VTK.
#include "postprocess/files/csv_table.h"
#include "tests/apps/continuum_scenes.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>

using namespace apps_tests;

namespace
{
  /** Data of one file, and the number of the point or element at a place. */
  struct Snapshot
  {
    explicit Snapshot(const std::filesystem::path &file)
    {
      reader->SetFileName(file.c_str());
      reader->Update();
      grid = reader->GetOutput();
    }

    vtkDataArray &field(const char *name) const
    {
      vtkDataArray *found = grid->GetPointData()->GetArray(name);
      REQUIRE(found);
      return *found;
    }

    vtkDataArray &of_elements(const char *name) const
    {
      vtkDataArray *found = grid->GetCellData()->GetArray(name);
      REQUIRE(found);
      return *found;
    }

    vtkIdType cell_at(const double x, const double y) const
    {
      double    place[3] = {x, y, 0}, unit[3], weights[4];
      int       part;
      vtkIdType cell = grid->FindCell(place, nullptr, 0, 1e-12, part, unit, weights);
      REQUIRE(cell >= 0);
      return cell;
    }

    vtkIdType at(const double x, const double y) const
    {
      const double place[3] = {x, y, 0};
      return grid->FindPoint(place[0], place[1], place[2]);
    }

    vtkSmartPointer<vtkXMLUnstructuredGridReader> reader = vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
    vtkUnstructuredGrid                          *grid;
  };
} // namespace

TEST_CASE("The last snapshot of a continuum run shows what the series says", "[apps]")
{
  const ScratchFolder folder;
  folder.file("x.prm", concrete_beam_scene());
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "results"}).status == 0);
  const postprocess::CsvTable series = postprocess::read_csv_table(folder / "results/series.csv");
  const Snapshot              last(folder / "results/solid/solid_000004.vtu");
  CHECK(last.grid->GetNumberOfCells() == 147);
  // Single precision in the file.
  for (const auto &[column, x] : {std::make_pair("displacement_left_lip_x", 0.22), {"displacement_right_lip_x", 0.23}})
    CHECK(last.field("displacement").GetComponent(last.at(x, 0), 0) ==
          Approx(series.column(column).back()).epsilon(1e-5));
  double down = 0;
  for (const double x : {0.22, 0.23})
    down += last.field("reaction").GetComponent(last.at(x, 0.1), 1);
  CHECK(down == Approx(series.column("reaction_load_y").back()).epsilon(1e-5));

  double range[2];
  last.of_elements("damage").GetRange(range);
  CHECK(range[0] == 0);
  CHECK(range[1] == Approx(series.column("largest_damage").back()).epsilon(1e-6)); // single precision, no average
  // Damage stands above the notch, not at the supports.
  CHECK(last.of_elements("damage").GetTuple1(last.cell_at(0.225, 0.035)) > 0.8);
  CHECK(last.of_elements("damage").GetTuple1(last.cell_at(0.03, 0.005)) == 0);
  last.of_elements("crack_opening").GetRange(range);
  CHECK(range[1] > 0.4e-4); // the mouth of the notch is open by 1e-4, its tip at 0.7 of the height by 0.7 of that
  CHECK(range[1] < 0.8e-4);
  for (const char *name : {"stress", "strain", "plastic_strain"})
    {
      CHECK(last.field(name).GetNumberOfTuples() == last.grid->GetNumberOfPoints());
      CHECK(last.field(name).GetNumberOfComponents() == 6);
    }
  last.field("stress").GetRange(range, 2); // zz: plane stress
  CHECK(std::max(std::fabs(range[0]), std::fabs(range[1])) == 0);
}
