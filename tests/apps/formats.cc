// doc/formats.md against what runs write.
#include "dem/laws/all.h"
#include "postprocess/files/csv_table.h"
#include "postprocess/vtk/fields.h"
#include "tests/apps/continuum_scenes.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cstdlib>
#include <regex>
#include <set>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string formats() { return content_of(places::sources() + "/doc/formats.md"); }

  /** Names in the first column of the tables after a heading, "`a`, `b` and others" apart. */
  std::set<std::string> columns_documented(const std::string &heading, const std::string &until)
  {
    const std::string text  = formats();
    const auto        begin = text.find(heading), end = text.find(until, begin);
    REQUIRE(begin != std::string::npos);
    REQUIRE(end != std::string::npos);
    const std::string     tables = text.substr(begin, end - begin);
    const std::regex      row("\n\\| ([^|]*) \\|"), name("`([A-Za-z_]+)`");
    std::set<std::string> names;
    for (std::sregex_iterator r(tables.begin(), tables.end(), row), none; r != none; ++r)
      {
        const std::string cell = (*r)[1];
        for (std::sregex_iterator n(cell.begin(), cell.end(), name); n != none; ++n)
          names.insert((*n)[1]);
      }
    return names;
  }

  /** What a scene names itself, and one component for all. */
  std::string general(const std::string &column)
  {
    const std::regex of_name("(reaction|displacement)_.*_[xyz]"), component("(strain|stress)_(xx|yy|zz|yz|zx|xy)");
    return std::regex_replace(std::regex_replace(column, of_name, "$1_NAME_x"), component, "$1_xx");
  }

  void check_series(const std::filesystem::path &file, const std::set<std::string> &documented)
  {
    std::string header = content_of(file);
    header             = header.substr(0, header.find('\n'));
    const std::regex name("([^,\\[]+?)( \\[[^\\]]*\\])?(,|$)");
    int              columns = 0;
    for (std::sregex_iterator n(header.begin(), header.end(), name), none; n != none; ++n, ++columns)
      {
        INFO(file << ": " << (*n)[1]);
        CHECK(documented.count(general((*n)[1])) == 1);
      }
    CHECK(columns > 5);
  }

  template <typename Reader>
  vtkSmartPointer<vtkDataSet> open(const std::filesystem::path &file)
  {
    const auto reader = vtkSmartPointer<Reader>::New();
    REQUIRE(reader->CanReadFile(file.c_str()) == 1);
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader->GetOutput();
  }

  /** Every array of the file is declared, and every declared one is there, but for those of special cases. */
  void check_fields(vtkDataSet &data, const std::string &kind, const bool with_special = false)
  {
    const postprocess::FieldFile &file = postprocess::field_file(kind);
    std::set<std::string>         expected, found;
    for (const postprocess::Field &f : file.fields)
      {
        vtkDataSetAttributes *values = data.GetPointData();
        if (f.of == postprocess::Field::Of::cells)
          values = data.GetCellData();
        if (f.only.empty() || with_special)
          expected.insert(f.name);
        if (vtkDataArray *const array = values->GetArray(f.name.c_str()))
          {
            found.insert(f.name);
            CHECK(array->GetNumberOfComponents() == f.components);
          }
      }
    for (const std::string &name : expected)
      {
        INFO(kind << " without " << name);
        CHECK(found.count(name) == 1);
      }
    for (vtkDataSetAttributes *values : {static_cast<vtkDataSetAttributes *>(data.GetPointData()),
                                         static_cast<vtkDataSetAttributes *>(data.GetCellData())})
      for (int a = 0; a < values->GetNumberOfArrays(); ++a)
        {
          INFO(kind << " with " << values->GetArrayName(a));
          CHECK(found.count(values->GetArrayName(a)) == 1);
        }
  }

  std::filesystem::path first_file(const std::filesystem::path &folder)
  {
    std::set<std::filesystem::path> files;
    for (const auto &entry : std::filesystem::directory_iterator(folder))
      files.insert(entry.path());
    REQUIRE(!files.empty());
    return *files.begin();
  }
} // namespace

TEST_CASE("doc/formats.md lists the fields of all files for ParaView", "[apps]")
{
  INFO("the chapter \"Files for ParaView\" is to hold, as they are:\n" << postprocess::fields_as_markdown());
  CHECK(formats().find(postprocess::fields_as_markdown()) != std::string::npos);
}

TEST_CASE("doc/formats.md lists what laws add to the links of ParaView files, with its unit", "[apps]")
{
  const auto listed = [](const char *law, const auto &history) {
    for (const dem::LinkQuantity &quantity : history)
      if (quantity.shown)
        {
          INFO(law << ": " << quantity.name);
          const std::regex row("\\n\\| `" + quantity.name + "(_0)?`[^|]*\\| " + quantity.unit + " \\| " + law + " \\|");
          CHECK(std::regex_search(formats(), row));
        }
  };
  listed("contact-bond", dem::ContactBond::history());
  listed("parallel-bond", dem::ParallelBond::history());
  listed("flat-joint", dem::FlatJoint::history());
}

TEST_CASE("A run of particles writes the fields and columns that doc/formats.md lists", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", pair_packing());
  folder.file("x.prm", scene_with_file());
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "out"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  check_fields(*open<vtkXMLPolyDataReader>(first_file(folder / "out/tension_particles")), "particles");
  check_fields(*open<vtkXMLPolyDataReader>(first_file(folder / "out/tension_links")), "links");
  check_series(folder / "out/series.csv", columns_documented("**Particles**", "**Solids**"));
}

TEST_CASE("A run of a solid writes the fields and columns that doc/formats.md lists, damage as it is in the element",
          "[apps]")
{
  const ScratchFolder folder;
  folder.file("x.prm", concrete_beam_scene());
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "out"}).status == 0);
  const auto last = open<vtkXMLUnstructuredGridReader>(folder / "out/solid/solid_000004.vtu");
  check_fields(*last, "solid", true);
  double range[2];
  last->GetCellData()->GetArray("damage")->GetRange(range);
  const auto series = postprocess::read_csv_table(folder / "out/series.csv");
  CHECK(range[1] == Approx(series.column("largest_damage").back()).epsilon(1e-6)); // single precision
  check_series(folder / "out/series.csv", columns_documented("**Solids**", "## Files for ParaView"));
}

TEST_CASE("The ParaView macro names only arrays that are declared, and all that it names at one place", "[apps]")
{
  const std::string     macro = content_of(places::sources() + "/postprocess/paraview/view_run.py");
  const std::regex      constant("\n[A-Z_]+ = \\(\"([^\"]+)\", \"(POINTS|CELLS)\", \"([^\"]+)\"\\)");
  std::set<std::string> kinds;
  int                   constants = 0;
  for (std::sregex_iterator m(macro.begin(), macro.end(), constant), none; m != none; ++m, ++constants)
    {
      INFO((*m)[0]);
      kinds.insert((*m)[1]);
      const postprocess::Field &field = postprocess::field_file((*m)[1]).field((*m)[3]); // throws if there is none
      CHECK((field.of == postprocess::Field::Of::points) == ((*m)[2] == "POINTS"));
    }
  CHECK(constants >= 8);
  CHECK(kinds == std::set<std::string>{"links", "particles", "solid", "transferred particles"});
  // No other array by name: display properties take the constants.
  const std::regex literal("\\[\"(POINTS|CELLS)\", \"[^\"]");
  CHECK(!std::regex_search(macro, literal));
}

TEST_CASE("A run lists the files that it left, and no picture that could not be drawn", "[apps][slow]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", pair_packing());
  folder.file("x.prm", scene_with_file());
  folder.file("bar.prm", impact_scene());
  const Outcome drawn = run(folder.path(), {"run", "x.prm", "-o", "drawn"});
  CHECK_THAT(drawn.out, Contains("summary.json") && Contains("series.csv") && Contains("curve.png") &&
                          Contains("tension_crack.png") && Contains("tension_particles.pvd"));

  const std::string path = ::getenv("PATH");
  ::setenv("PATH", folder.path().c_str(), 1); // where there is no gnuplot, nor the ssh that MPI searches for
  const Outcome bare  = run(folder.path(), {"run", "x.prm", "-o", "bare"}),
                again = run(folder.path(), {"run", "x.prm", "-o", "drawn"}),
                solid = run(folder.path(), {"run", "bar.prm", "-o", "bar"});
  ::setenv("PATH", path.c_str(), 1);
  for (const Outcome &outcome : {bare, again, solid}) // the second finds pictures of an earlier run in its folder
    {
      CHECK(outcome.status == 0);
      CHECK_THAT(outcome.err, Contains("no curve.png") && Contains("gnuplot is not installed"));
      CHECK_THAT(outcome.out, Contains("series.csv") && !Contains(".png"));
    }
}
