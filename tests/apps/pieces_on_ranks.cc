// Snapshots of particles in a piece per rank, read by VTK: together they are what one rank writes to one file.
#include "tests/apps/program.h"
#include "tests/apps/same_on_ranks.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPPolyDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

using namespace apps_tests;

namespace
{
  const std::vector<std::string> in_pieces = {"Output/Pieces=per rank"};

  /** A cube of concrete of 768 particles, three bricks, pulled and crushed. */
  std::string small_concrete(const std::vector<std::string> &more)
  {
    std::vector<std::string> changes = {"Specimen/Box size=0.02, 0.02, 0.02", "Output/Snapshots=4"};
    changes.insert(changes.end(), more.begin(), more.end());
    return run_of("concrete_uniaxial.prm", changes);
  }

  std::string periodic_cell(const std::vector<std::string> &more)
  {
    std::vector<std::string> changes = {"Output/Snapshots=2"};
    changes.insert(changes.end(), more.begin(), more.end());
    return run_of("periodic_cell.prm", changes);
  }

  /** As ParaView would open it. */
  template <typename Reader>
  vtkSmartPointer<vtkPolyData> open(const std::filesystem::path &path)
  {
    const auto reader = vtkSmartPointer<Reader>::New();
    REQUIRE(reader->CanReadFile(path.c_str()) == 1);
    reader->SetFileName(path.c_str());
    reader->Update();
    REQUIRE(reader->GetErrorCode() == 0);
    return reader->GetOutput();
  }

  using Row = std::vector<double>;

  void put(Row &row, vtkDataSetAttributes &values, const vtkIdType tuple)
  {
    for (int a = 0; a < values.GetNumberOfArrays(); ++a)
      if (std::string(values.GetArrayName(a)) != "line")
        for (int c = 0; c < values.GetArray(a)->GetNumberOfComponents(); ++c)
          row.push_back(values.GetArray(a)->GetComponent(tuple, c));
  }

  void put_point(Row &row, vtkPolyData &data, const vtkIdType point)
  {
    row.insert(row.end(), data.GetPoint(point), data.GetPoint(point) + 3);
    put(row, *data.GetPointData(), point);
  }

  /** All that there is to know of points and cells, in an order of their own. */
  std::vector<Row> rows_of_particles(vtkPolyData &data)
  {
    REQUIRE(data.GetNumberOfCells() == data.GetNumberOfPoints());
    std::map<double, Row> by_number;
    for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i)
      put_point(by_number[data.GetPointData()->GetArray("id")->GetTuple1(i)], data, i);
    std::vector<Row> rows;
    for (auto &[number, row] : by_number)
      rows.push_back(std::move(row));
    CHECK(static_cast<vtkIdType>(rows.size()) == data.GetNumberOfPoints());
    return rows;
  }

  std::vector<Row> rows_of_links(vtkPolyData &data)
  {
    vtkDataArray *const                 line = data.GetCellData()->GetArray("line");
    std::vector<std::pair<double, Row>> rows;
    for (vtkIdType l = 0; l < data.GetNumberOfCells(); ++l)
      {
        Row row;
        REQUIRE(data.GetCell(l)->GetNumberOfPoints() == 2);
        for (int end = 0; end < 2; ++end)
          put_point(row, data, data.GetCell(l)->GetPointId(end));
        put(row, *data.GetCellData(), l);
        rows.emplace_back(line ? line->GetTuple1(l) : static_cast<double>(l), std::move(row));
      }
    std::sort(rows.begin(), rows.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    std::vector<Row> sorted;
    for (auto &[number, row] : rows)
      sorted.push_back(std::move(row));
    return sorted;
  }

  /** Names, units and components of fields. */
  std::vector<std::string> fields_of(vtkPolyData &data)
  {
    std::vector<std::string> fields;
    for (vtkDataSetAttributes *values : {static_cast<vtkDataSetAttributes *>(data.GetPointData()),
                                         static_cast<vtkDataSetAttributes *>(data.GetCellData())})
      for (int a = 0; a < values->GetNumberOfArrays(); ++a)
        {
          vtkDataArray &array = *values->GetArray(a);
          std::string   field = array.GetName() + std::string(" ") + array.GetDataTypeAsString();
          if (array.HasInformation() && array.GetInformation()->Has(vtkDataArray::UNITS_LABEL()))
            field += std::string(" ") + array.GetInformation()->Get(vtkDataArray::UNITS_LABEL());
          for (int c = 0; c < array.GetNumberOfComponents(); ++c)
            field += std::string(" ") + (array.GetComponentName(c) ? array.GetComponentName(c) : "-");
          if (array.GetName() != std::string("line"))
            fields.push_back(field);
        }
    return fields;
  }

  struct Found
  {
    std::size_t snapshots = 0, pieces = 0, empty = 0, classed = 0;
    double      broken = 0, to_images = 0;
  };

  double sum_of(vtkPolyData &data, const char *field)
  {
    vtkDataArray *const array = data.GetCellData()->GetArray(field);
    double              sum   = 0;
    for (vtkIdType l = 0; array && l < data.GetNumberOfCells(); ++l)
      sum += array->GetTuple1(l);
    return sum;
  }

  /** Compare a snapshot in pieces with one of one file. */
  void compare(const std::filesystem::path &record, const std::filesystem::path &file, Found &found)
  {
    INFO(record);
    const auto together = open<vtkXMLPPolyDataReader>(record), one = open<vtkXMLPolyDataReader>(file);
    CHECK(fields_of(*together) == fields_of(*one));
    CHECK(together->GetNumberOfCells() == one->GetNumberOfCells());
    if (one->GetCellData()->HasArray("kind"))
      CHECK((rows_of_links(*together) == rows_of_links(*one)));
    else
      CHECK((rows_of_particles(*together) == rows_of_particles(*one)));
    ++found.snapshots;
    found.broken += sum_of(*one, "broken");
    found.to_images += sum_of(*one, "to_image");
    found.classed += one->GetCellData()->HasArray("class") != 0;
  }

  bool is_of_particles(const std::string &name)
  {
    return name.find("_particles") != std::string::npos || name.find("_links") != std::string::npos;
  }

  /** All snapshots of a run, which its lists name, beside those of a run in one file each. */
  Found compare_all(const std::filesystem::path &pieces, const std::filesystem::path &whole)
  {
    Found found;
    for (const auto &[name, content] : results_in(pieces))
      {
        const std::filesystem::path file(name);
        if (file.extension() == ".pvtp")
          compare(pieces / file, (whole / file).replace_extension(".vtp"), found);
        if (file.extension() == ".pvd" && is_of_particles(name))
          CHECK(occurrences(".pvtp", content) == occurrences(".vtp", content_of(whole / file)));
        if (file.extension() != ".vtp" || !is_of_particles(name))
          continue;
        ++found.pieces;
        found.empty += open<vtkXMLPolyDataReader>(pieces / file)->GetNumberOfPoints() == 0;
        const std::string stem = file.stem().string(); // NAME_000003.1
        CHECK(occurrences('"' + file.filename().string() + '"',
                          content_of(pieces / file.parent_path() / (stem.substr(0, stem.rfind('.')) + ".pvtp"))) == 1);
      }
    for (const auto &[name, content] : results_in(whole))
      if (!is_of_particles(name) && name != "coupled.pvd") // which lists them
        {
          INFO(name);
          CHECK((content_of(pieces / name) == content));
        }
    return found;
  }

  void run(const ScratchFolder &folder, const int ranks, const std::string &words)
  {
    const int status = shell_in(folder, "BRECCIA_CHECK_RANKS=1 " + program_on(ranks, 1) + words);
    INFO(content_of(folder / "said"));
    REQUIRE(status == 0);
  }
} // namespace

TEST_CASE("Pieces per rank are together the one file of one rank, of a cell and its images", "[apps][mpi][ranks]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  run(folder, 0, periodic_cell({}) + " -o whole");
  for (const int ranks : {0, 2})
    {
      const std::string name = std::to_string(ranks) + "_ranks";
      run(folder, ranks, periodic_cell(in_pieces) + " -o " + name);
      const Found found = compare_all(folder / name, folder / "whole");
      CHECK(found.pieces == found.snapshots * static_cast<std::size_t>(std::max(ranks, 1)));
      CHECK(found.to_images > 0);
    }
}

TEST_CASE("Pieces per rank are together the one file of one rank, of links of several classes", "[apps][mpi][ranks]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  run(folder, 0, run_of("two_materials.prm", {"Output/Snapshots=2"}) + " -o whole");
  run(folder, 2, run_of("two_materials.prm", {"Output/Snapshots=2", in_pieces[0]}) + " -o pieces");
  CHECK(compare_all(folder / "pieces", folder / "whole").classed > 0);
}

TEST_CASE("Pieces per rank are together the one file of one rank, of concrete on more ranks than bricks too",
          "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  run(folder, 0, small_concrete({}) + " -o whole");
  for (const int ranks : {2, 3, 5})
    {
      const std::string name = std::to_string(ranks) + "_ranks";
      run(folder, ranks, small_concrete(in_pieces) + " -o " + name);
      const Found found = compare_all(folder / name, folder / "whole");
      CHECK(found.pieces == found.snapshots * static_cast<std::size_t>(ranks));
      CHECK(found.empty == (ranks == 5 ? 2 * found.snapshots : 0));
      CHECK(found.broken > 0);
    }
}

TEST_CASE("Particles beside a solid are shown in a piece per rank, and listed with it", "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  const std::string   scene = run_of("plate_impact.prm");
  run(folder, 0, scene + " -o whole");
  run(folder, 3, scene + " -s 'Output/Pieces=per rank' -o pieces");
  const std::string list = content_of(folder / "pieces/coupled.pvd");
  CHECK(occurrences(".pvtp", list) > 0);
  CHECK(compare_all(folder / "pieces", folder / "whole").snapshots > 0);
  CHECK(occurrences("particles_particles_000000.vtp", list) == 0);
}

TEST_CASE("Pieces of a run that was interrupted on three ranks and went on on two are those that its records name",
          "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  run(folder, 0, small_concrete({}) + " -o whole");
  const std::string words = small_concrete(in_pieces);
  interrupt_on_three(folder, words);
  // As if it had gone further than its last checkpoint.
  const std::filesystem::path shown = folder / "results/running/compression_links";
  std::filesystem::create_directories(shown);
  std::filesystem::copy_file(folder / "results/running/tension_links/tension_links_000000.2.vtp",
                             shown / "compression_links_000001.2.vtp");
  run(folder, 2, words + " -o results --resume");
  CHECK(compare_all(folder / "results", folder / "whole").snapshots > 0);
}

TEST_CASE("Where one rank cannot write its piece, all ranks are gone in a moment with one message",
          "[apps][mpi][ranks][slow][S14]")
{
  if (places::skipped_without_mpirun())
    return;
  // Another thing has the name of a piece of the second rank.
  are_gone_where_one_cannot_write(
    small_concrete(in_pieces), "tension_links/tension_links_000000.pvtp",
    "for i in 1 2 3; do mkdir results/running/tension_links/tension_links_00000$i.1.vtp; done", ".1.vtp");
}
