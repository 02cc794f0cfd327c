#include "full_disk.h"
#include "postprocess/files/errors.h"
#include "postprocess/vtk/fields.h"
#include "postprocess/vtk/pvd.h"
#include "postprocess/vtk/vtk_links.h"
#include "postprocess/vtk/vtk_particles.h"
#include "postprocess/vtk/vtk_solid.h"
#include "scratch_folder.h"
#include "specimen_samples.h"

#include <catch2/catch.hpp>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

using namespace postprocess;
using Catch::Matchers::Contains;
using postprocess_tests::content_of;
using postprocess_tests::files_in;
using postprocess_tests::FullDisk;
using postprocess_tests::numbered_links;
using postprocess_tests::numbered_particles;
using postprocess_tests::ScratchFolder;

#ifdef __SANITIZE_ADDRESS__
/** VTK 9.1 forgets 32 bytes per array when the disk is full; that leak is not ours to find. */
extern "C" const char *__lsan_default_suppressions() { return "leak:libvtkIOXML"; }
#endif

namespace
{
  /** As ParaView would open it. */
  vtkSmartPointer<vtkPolyData> open(const std::filesystem::path &path)
  {
    const auto reader = vtkSmartPointer<vtkXMLPolyDataReader>::New();
    REQUIRE(reader->CanReadFile(path.c_str()) == 1);
    reader->SetFileName(path.c_str());
    reader->Update();
    REQUIRE(reader->GetErrorCode() == 0);
    return reader->GetOutput();
  }
} // namespace

TEST_CASE("files for ParaView are compressed by zlib, which readers other than VTK's know", "[postprocess]")
{
  const ScratchFolder folder;
  write_vtk_particles(folder / "p.vtp", numbered_particles(3), 0.0);
  CHECK_THAT(content_of(folder / "p.vtp"), Contains("compressor=\"vtkZLibDataCompressor\""));
}

TEST_CASE("VTK reads back every value of the particles", "[postprocess]")
{
  const ScratchFolder folder;
  const int           n         = GENERATE(0, 1, 2000);
  const auto          particles = numbered_particles(n);
  write_vtk_particles(folder / "p.vtp", particles, 0.125);
  REQUIRE(files_in(folder.path) == 1);

  const auto data = open(folder / "p.vtp");
  REQUIRE(data->GetNumberOfPoints() == n);
  REQUIRE(data->GetNumberOfCells() == n);
  REQUIRE(data->GetFieldData()->GetArray("TimeValue")->GetTuple1(0) == 0.125);

  vtkPointData *const values = data->GetPointData();
  REQUIRE(values->GetTensors() == values->GetArray("stress"));
  REQUIRE(values->GetArray("stress")->GetNumberOfComponents() == 6);
  REQUIRE(std::string(values->GetArray("stress")->GetComponentName(5)) == "XZ");
  for (int i = 0; i < n; ++i)
    {
      const double tensor[6] = {11. + 100 * i, 22. + 100 * i, 33. + 100 * i, 12, 23, 13}; // XX YY ZZ XY YZ XZ
      for (int d = 0; d < 3; ++d)
        {
          REQUIRE(data->GetPoint(i)[d] == particles.position[i][d]);
          REQUIRE(values->GetArray("displacement")->GetComponent(i, d) == particles.displacement[i][d]);
          REQUIRE(values->GetArray("velocity")->GetComponent(i, d) == particles.velocity[i][d]);
          REQUIRE(values->GetArray("angular_velocity")->GetComponent(i, d) == particles.angular_velocity[i][d]);
        }
      for (int c = 0; c < 6; ++c)
        REQUIRE(values->GetArray("stress")->GetComponent(i, c) == tensor[c]);
      REQUIRE(values->GetArray("radius")->GetTuple1(i) == particles.radius[i]);
      REQUIRE(values->GetArray("damage")->GetTuple1(i) == particles.damage[i]);
      REQUIRE(values->GetArray("broken_links")->GetTuple1(i) == i % 4);
      REQUIRE(values->GetArray("phase")->GetTuple1(i) == 0);
      REQUIRE(values->GetArray("id")->GetTuple1(i) == i + 1);
    }
}

TEST_CASE("VTK files of several materials say of what particles and links are", "[postprocess]")
{
  const ScratchFolder folder;
  auto                particles = numbered_particles(50);
  auto                links     = numbered_links(50);
  write_vtk_particles(folder / "p.vtp", particles, 0);
  write_vtk_links(folder / "l.vtp", links, particles, 0);
  REQUIRE(open(folder / "p.vtp")->GetPointData()->HasArray("material") == 0);
  REQUIRE(open(folder / "l.vtp")->GetCellData()->HasArray("material_pair") == 0);

  for (int i = 0; i < 50; ++i)
    particles.material.push_back(i % 3);
  for (int l = 0; l < 49; ++l)
    links.pair.push_back(l % 6);
  write_vtk_particles(folder / "p.vtp", particles, 0);
  write_vtk_links(folder / "l.vtp", links, particles, 0);
  for (int i = 0; i < 50; ++i)
    for (const char *name : {"material", "phase"})
      REQUIRE(open(folder / "p.vtp")->GetPointData()->GetArray(name)->GetTuple1(i) == i % 3);
  for (int l = 0; l < 49; ++l)
    REQUIRE(open(folder / "l.vtp")->GetCellData()->GetArray("material_pair")->GetTuple1(l) == l % 6);
  REQUIRE(open(folder / "l.vtp")->GetCellData()->HasArray("class") == 0);
  std::vector<std::int32_t> classes;
  for (int l = 0; l < 49; ++l)
    classes.push_back(l % 4);
  write_vtk_links(folder / "l.vtp", links, particles, 0, {}, classes);
  for (int l = 0; l < 49; ++l)
    REQUIRE(open(folder / "l.vtp")->GetCellData()->GetArray("class")->GetTuple1(l) == l % 4);
  classes.pop_back();
  REQUIRE_THROWS_AS(write_vtk_links(folder / "l.vtp", links, particles, 0, {}, classes), std::invalid_argument);
  links.pair.pop_back();
  REQUIRE_THROWS_AS(write_vtk_links(folder / "l.vtp", links, particles, 0), std::invalid_argument);
}

TEST_CASE("VTK reads back every value of the links", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          particles = numbered_particles(500);
  const auto          links     = numbered_links(500);
  write_vtk_links(folder / "l.vtp", links, particles, 0.5);

  const auto data = open(folder / "l.vtp");
  REQUIRE(data->GetNumberOfCells() == 499);
  REQUIRE(data->GetNumberOfPoints() == 500);
  vtkCellData *const values = data->GetCellData();
  for (int l = 0; l < 499; ++l)
    {
      vtkCell *const line = data->GetCell(l);
      REQUIRE(line->GetNumberOfPoints() == 2);
      for (int end = 0; end < 2; ++end)
        for (int d = 0; d < 3; ++d)
          REQUIRE(line->GetPoints()->GetPoint(end)[d] == particles.position[links.ends[l][end]][d]);
      REQUIRE(values->GetArray("normal_force")->GetTuple1(l) == links.normal_force[l]);
      REQUIRE(values->GetArray("shear_force")->GetTuple1(l) == links.shear_force[l]);
      REQUIRE(values->GetArray("normal_stress")->GetTuple1(l) == links.normal_stress[l]);
      REQUIRE(values->GetArray("shear_stress")->GetTuple1(l) == links.shear_stress[l]);
      REQUIRE(values->GetArray("normal_strain")->GetTuple1(l) == links.normal_strain[l]);
      REQUIRE(values->GetArray("damage")->GetTuple1(l) == links.damage[l]);
      REQUIRE(values->GetArray("kind")->GetTuple1(l) == l % 3);
      REQUIRE(values->GetArray("broken")->GetTuple1(l) == (l % 3 == 2 ? 1 : 0));
    }
  REQUIRE(data->GetPointData()->GetArray("radius")->GetTuple1(3) == particles.radius[3]);
}

TEST_CASE("a link to a periodic image is a line to that image, not across the cell", "[postprocess]")
{
  const ScratchFolder  folder;
  const auto           particles = numbered_particles(3);
  const auto           links     = numbered_links(3); // 0-1 and 1-2
  const dem::LinkImage image{{-3.03, 0, 0}, {-3, 0, 0}};
  write_vtk_links(folder / "l.vtp", links, particles, 0, {{}, image});

  const auto data = open(folder / "l.vtp");
  REQUIRE(data->GetNumberOfCells() == 2);
  REQUIRE(data->GetNumberOfPoints() == 4);
  const auto end = [&](const int link) {
    double x[3];
    data->GetCell(link)->GetPoints()->GetPoint(1, x);
    return Eigen::Vector3d(x);
  };
  CHECK(end(0) == particles.position[1]);
  CHECK(end(1) == particles.position[2] + image.now);
  const vtkIdType     at     = data->GetCell(1)->GetPointId(1);
  vtkPointData *const points = data->GetPointData();
  CHECK(points->GetArray("id")->GetTuple1(at) == 2 + 1);
  CHECK(points->GetArray("radius")->GetTuple1(at) == particles.radius[2]);
  CHECK(points->GetArray("displacement")->GetComponent(at, 0) == Approx(particles.displacement[2].x() - 0.03));
  CHECK(data->GetCellData()->GetArray("to_image")->GetTuple1(0) == 0);
  CHECK(data->GetCellData()->GetArray("to_image")->GetTuple1(1) == 1);
  REQUIRE_THROWS_AS(write_vtk_links(folder / "l.vtp", links, particles, 0, {image}), std::invalid_argument);
}

TEST_CASE("what is glued to a surface is a line to where it is glued, and broken where it was torn off",
          "[postprocess]")
{
  const ScratchFolder folder;
  const auto          particles = numbered_particles(3);
  auto                links     = numbered_links(3); // 0-1 and 1-2
  links.glue                    = {
                       {2, 0},    {4, 4},  {{1, 2, 3}, {4, 5, 6}}, {{0, 0, 1}, {0, 0, 2}}, {0, 1}, {7, 0}, {8, 0}, {9, 0}, {10, 0},
                       {1e-3, 0}, {0.5, 1}};
  write_vtk_links(folder / "l.vtp", links, particles, 0);
  const auto data = open(folder / "l.vtp");
  REQUIRE(data->GetNumberOfCells() == 4);
  REQUIRE(data->GetNumberOfPoints() == 5);
  const auto end = [&](const int link, const int which) {
    double x[3];
    data->GetCell(link)->GetPoints()->GetPoint(which, x);
    return Eigen::Vector3d(x);
  };
  CHECK(end(2, 0) == particles.position[2]);
  CHECK(end(2, 1) == Eigen::Vector3d(1, 2, 3));
  CHECK(end(3, 0) == particles.position[0]);
  vtkCellData *const values = data->GetCellData();
  CHECK(values->GetArray("normal_force")->GetTuple1(2) == 7);
  CHECK(values->GetArray("broken")->GetTuple1(2) == 0);
  CHECK(values->GetArray("broken")->GetTuple1(3) == 1);
  CHECK(values->GetArray("surface")->GetTuple1(1) == -1);
  CHECK(values->GetArray("surface")->GetTuple1(3) == 4);
  CHECK(data->GetPointData()->GetArray("id")->GetTuple1(3) == -1);
}

TEST_CASE("arrays carry the units that are declared for them", "[postprocess]")
{
  const ScratchFolder folder;
  auto                particles = numbered_particles(5);
  auto                links     = numbered_links(5);
  particles.material            = {0, 1, 0, 1, 0};
  links.pair                    = {0, 1, 2, 1};
  links.glue                    = {{0}, {0}, {{1, 2, 3}}, {{0, 0, 0}}, {0}, {1}, {1}, {1}, {1}, {0}, {0}};
  dem::RankOutput piece; // which has all that there can be
  piece.particles = piece.points = particles;
  piece.number = piece.number_of_point = {4, 3, 2, 1, 0};
  piece.links                          = links;
  piece.line                           = {0, 1, 2, 3, 4};
  piece.several_materials = piece.glued = true;
  write_vtk_particles(folder / "p.vtp", piece, 0);
  write_vtk_links(folder / "l.vtp", piece, 0, std::vector<dem::LinkImage>(4), std::vector<std::int32_t>{0, 1, 2, 1});
  for (const char *kind : {"particles", "links"})
    {
      const auto       data = open(folder / (std::string(1, kind[0]) + ".vtp"));
      const FieldFile &file = field_file(kind);
      int              seen = 0;
      for (const Field &f : file.fields)
        {
          INFO(kind << ": " << f.name);
          vtkDataSetAttributes *values = data->GetPointData();
          if (f.of == Field::Of::cells)
            values = data->GetCellData();
          vtkDataArray *const array = values->GetArray(f.name.c_str());
          REQUIRE(array != nullptr);
          CHECK(array->GetNumberOfComponents() == f.components);
          const char *const unit = array->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
          CHECK(std::string(unit ? unit : "") == (f.unit == "-" ? "" : f.unit));
          ++seen;
        }
      CHECK(seen == data->GetPointData()->GetNumberOfArrays() + data->GetCellData()->GetNumberOfArrays());
    }
}

TEST_CASE("a solid is read back with its elements, tensors and element values", "[postprocess]")
{
  const ScratchFolder folder;
  fem::SolidSnapshot  solid; // two squares side by side
  solid.place         = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
  solid.element_type  = 9;
  solid.element_nodes = 4;
  solid.elements      = {0, 1, 4, 3, 1, 2, 5, 4};
  solid.at_nodes      = {{"displacement", "m", 3, std::vector<float>(18, 0.5f)}, {"stress", "", 6, {}}};
  for (int i = 0; i < 36; ++i)
    solid.at_nodes[1].values.push_back(static_cast<float>(i));
  solid.of_elements = {{"damage", "", 1, {0.25f, 0.997f}}, {"own_history", "N/m", 1, {1, 2}}};
  write_vtk_solid(folder / "s.vtu", solid, 0.5);

  const auto reader = vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
  reader->SetFileName((folder / "s.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid *const grid = reader->GetOutput();
  REQUIRE(grid->GetNumberOfCells() == 2);
  REQUIRE(grid->GetNumberOfPoints() == 6);
  CHECK(grid->GetCell(1)->GetPointId(2) == 5);
  CHECK(grid->GetPointData()->GetTensors() == grid->GetPointData()->GetArray("stress"));
  CHECK(grid->GetPointData()->GetArray("stress")->GetComponent(2, 3) == 15);
  CHECK(std::string(grid->GetPointData()->GetArray("stress")->GetComponentName(3)) == "XY");
  vtkDataArray *const damage = grid->GetCellData()->GetArray("damage");
  REQUIRE(damage != nullptr);
  CHECK(damage->GetTuple1(1) == 0.997f);
  CHECK(grid->GetPointData()->GetArray("damage") == nullptr);
  CHECK(std::string(grid->GetCellData()->GetArray("own_history")->GetInformation()->Get(vtkDataArray::UNITS_LABEL())) ==
        "N/m");
  CHECK(std::string(grid->GetPointData()->GetArray("stress")->GetInformation()->Get(vtkDataArray::UNITS_LABEL())) ==
        "Pa");

  CHECK_THROWS_WITH(write_vtk_solid(folder / "missing/s.vtu", solid, 0), Contains("missing"));
  solid.of_elements.front().values.pop_back();
  CHECK_THROWS_AS(write_vtk_solid(folder / "s.vtu", solid, 0), std::invalid_argument);
  CHECK(files_in(folder.path) == 1);
}

TEST_CASE("a record and its pieces are read as one solid, with units and names of components", "[postprocess]")
{
  const ScratchFolder folder;
  fem::SolidSnapshot  solid; // a square
  solid.place         = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  solid.element_type  = 9;
  solid.element_nodes = 4;
  solid.elements      = {0, 1, 3, 2};
  solid.at_nodes      = {{"displacement", "m", 3, std::vector<float>(12, 0.5f)}, {"stress", "", 6, {}}};
  for (int i = 0; i < 24; ++i)
    solid.at_nodes[1].values.push_back(static_cast<float>(i));
  solid.of_elements = {{"damage", "", 1, {0.25f}}};
  write_vtk_solid(folder / piece_name("s", 0, ".vtu"), solid, 0.5);
  solid.of_elements[0].values[0] = 0.75f;
  write_vtk_solid(folder / piece_name("s", 1, ".vtu"), solid, 0.5);
  write_vtk_solid_record(folder / "s.pvtu", solid, {"s.0.vtu", "s.1.vtu"});

  const auto reader = vtkSmartPointer<vtkXMLPUnstructuredGridReader>::New();
  REQUIRE(reader->CanReadFile((folder / "s.pvtu").c_str()) == 1);
  reader->SetFileName((folder / "s.pvtu").c_str());
  reader->Update();
  vtkUnstructuredGrid *const grid = reader->GetOutput();
  REQUIRE(grid->GetNumberOfCells() == 2);
  REQUIRE(grid->GetNumberOfPoints() == 8);
  CHECK(grid->GetCellData()->GetArray("damage")->GetTuple1(0) == 0.25);
  CHECK(grid->GetCellData()->GetArray("damage")->GetTuple1(1) == 0.75);
  vtkDataArray *const stress = grid->GetPointData()->GetArray("stress");
  CHECK(grid->GetPointData()->GetTensors() == stress);
  CHECK(stress->GetComponent(7, 5) == 23);
  CHECK(std::string(stress->GetComponentName(5)) == "XZ");
  CHECK(std::string(stress->GetInformation()->Get(vtkDataArray::UNITS_LABEL())) == "Pa");
}

TEST_CASE("a links file without any link opens and has every column", "[postprocess]")
{
  const ScratchFolder folder;
  const int           n = GENERATE(0, 1, 3);
  write_vtk_links(folder / "l.vtp", dem::LinkOutput(), numbered_particles(n), 0);
  const auto data = open(folder / "l.vtp");
  REQUIRE(data->GetNumberOfCells() == 0);
  REQUIRE(data->GetNumberOfPoints() == n);
  for (const char *const name :
       {"normal_force", "shear_force", "normal_stress", "shear_stress", "normal_strain", "damage", "kind", "broken"})
    {
      REQUIRE(data->GetCellData()->GetArray(name) != nullptr);
      REQUIRE(data->GetCellData()->GetArray(name)->GetNumberOfTuples() == 0);
    }
}

TEST_CASE("VTK writers refuse columns that do not belong together", "[postprocess]")
{
  const ScratchFolder folder;
  auto                particles = numbered_particles(3);
  auto                links     = numbered_links(3);
  links.ends[1][1]              = 3;
  REQUIRE_THROWS_WITH(write_vtk_links(folder / "l.vtp", links, particles, 0),
                      Contains("a link ends at particle 3 of 3"));
  links.damage.pop_back();
  REQUIRE_THROWS_WITH(write_vtk_links(folder / "l.vtp", links, particles, 0), Contains("damage has 1 entries, not 2"));
  particles.stress.pop_back();
  REQUIRE_THROWS_WITH(write_vtk_particles(folder / "p.vtp", particles, 0), Contains("stress has 2 entries, not 3"));
  REQUIRE(files_in(folder.path) == 0);
}

TEST_CASE("a full disk leaves the earlier VTK file and is reported", "[postprocess]")
{
  const ScratchFolder folder;
  write_vtk_particles(folder / "p.vtp", numbered_particles(2), 0);
  const std::string earlier   = content_of(folder / "p.vtp");
  const auto        particles = numbered_particles(5000);
  std::string       message;
  {
    const FullDisk limit(10000);
    try
      {
        write_vtk_particles(folder / "p.vtp", particles, 1);
      }
    catch (const OutputError &error)
      {
        message = error.what();
      }
  }
  REQUIRE_THAT(message, Contains("p.vtp: cannot be written"));
  REQUIRE(content_of(folder / "p.vtp") == earlier);
  REQUIRE(files_in(folder.path) == 1);
  REQUIRE_THROWS_AS(write_vtk_particles(folder / "no/p.vtp", particles, 1), OutputError);
}

TEST_CASE("a collection lists its snapshots with times after each of them", "[postprocess]")
{
  const ScratchFolder folder;
  PvdCollection       snapshots(folder / "out", "particles");
  REQUIRE(snapshots.next() == folder / "out/particles/particles_000000.vtp");
  snapshots.add(0);
  REQUIRE(snapshots.next() == folder / "out/particles/particles_000001.vtp");
  snapshots.add(1e-5 / 3);
  REQUIRE(snapshots.size() == 2);
  REQUIRE(content_of(folder / "out/particles.pvd") ==
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n"
          "    <DataSet timestep=\"0\" part=\"0\" file=\"particles/particles_000000.vtp\"/>\n"
          "    <DataSet timestep=\"3.3333333333333337e-06\" part=\"0\" file=\"particles/particles_000001.vtp\"/>\n"
          "  </Collection>\n</VTKFile>\n");
  REQUIRE(std::filesystem::is_directory(folder / "out/particles"));
  folder.file("taken", "");
  REQUIRE_THROWS_AS(PvdCollection(folder / "taken", "particles"), OutputError);
}
