// Classes of links in files for ParaView, read by VTK and held against the materials of the particles that each link joins.
#include "postprocess/files/csv_table.h"
#include "tests/apps/concrete_stack.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/apps/uneven_lattice.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

using namespace apps_tests;

namespace
{
  vtkSmartPointer<vtkPolyData> lines_in(const std::filesystem::path &file)
  {
    const auto reader = vtkSmartPointer<vtkXMLPolyDataReader>::New();
    reader->SetFileName(file.c_str());
    reader->Update();
    REQUIRE(reader->GetErrorCode() == 0);
    return reader->GetOutput();
  }

  vtkDataArray &field(vtkDataSetAttributes *values, const char *name)
  {
    vtkDataArray *const found = values->GetArray(name);
    INFO(name);
    REQUIRE(found);
    return *found;
  }

  /** Of a mix whose mortar is material 0: of the mortar, of the interface, within one number of the aggregate. */
  int class_of(const int one, const int other) { return one != other ? 1 : one == 0 ? 0 : 2; }

  const std::vector<std::string> names = {"mortar", "interface", "aggregate"};

  /** What the snapshots of a run have had. */
  struct Seen
  {
    std::size_t                               files  = 0;
    std::array<std::array<std::size_t, 3>, 3> links  = {}; ///< by class and kind, in all files
    std::array<std::size_t, 3>                at_end = {}; ///< by class, but for contacts, in the last file
    std::map<int, std::pair<double, double>>  moduli;      ///< by class, of whole links: least and largest [Pa]
  };

  /** Stress over strain of a link that is not damaged. @return 0 where it is, or hardly strained */
  double modulus_of(vtkPolyData &lines, const vtkIdType link)
  {
    vtkCellData *const values = lines.GetCellData();
    const double       strain = field(values, "normal_strain").GetTuple1(link);
    if (field(values, "kind").GetTuple1(link) != 0 || field(values, "damage").GetTuple1(link) != 0 ||
        std::abs(strain) < 1e-8)
      return 0;
    return field(values, "normal_stress").GetTuple1(link) / strain;
  }

  /** Every link of a file has the class of its ends. */
  void check_file(vtkPolyData &particles, vtkPolyData &lines, Seen &seen)
  {
    vtkDataArray &material = field(particles.GetPointData(), "material"), &id = field(lines.GetPointData(), "id"),
                 &kind = field(lines.GetCellData(), "kind"), &number = field(lines.GetCellData(), "class");
    seen.at_end = {};
    for (vtkIdType l = 0; l < lines.GetNumberOfCells(); ++l)
      {
        vtkCell *const line = lines.GetCell(l);
        const auto     of   = [&](const int end) {
          return static_cast<int>(material.GetTuple1(static_cast<vtkIdType>(id.GetTuple1(line->GetPointId(end))) - 1));
        };
        const int expected = class_of(of(0), of(1)), found = static_cast<int>(number.GetTuple1(l)),
                  how = static_cast<int>(kind.GetTuple1(l));
        REQUIRE(found == expected);
        ++seen.links[static_cast<std::size_t>(found)][static_cast<std::size_t>(how)];
        seen.at_end[static_cast<std::size_t>(found)] += how != 1;
        if (const double modulus = modulus_of(lines, l); modulus != 0)
          {
            auto &[least, largest] = seen.moduli.try_emplace(found, modulus, modulus).first->second;
            least                  = std::min(least, modulus);
            largest                = std::max(largest, modulus);
          }
      }
  }

  /** Of all snapshots of a test. @param prefix of its files: "tension_", or nothing */
  Seen snapshots_of(const std::filesystem::path &results, const std::string &prefix)
  {
    Seen seen;
    for (;; ++seen.files)
      {
        const auto file = [&](const std::string &what) {
          const std::string name = prefix + what, digits = std::to_string(seen.files);
          return results / name / (name + "_" + std::string(6 - digits.size(), '0') + digits + ".vtp");
        };
        if (!std::filesystem::exists(file("links")))
          return seen;
        INFO(file("links"));
        check_file(*lines_in(file("particles")), *lines_in(file("links")), seen);
      }
  }

  /** The figures by class of the summary are those of the last snapshot, number for number. */
  void agrees(const Seen &seen, const nlohmann::json &classes)
  {
    REQUIRE(seen.files > 1);
    REQUIRE(classes.size() == names.size());
    for (std::size_t k = 0; k < names.size(); ++k)
      {
        INFO(names[k]);
        CHECK(classes[k]["class"] == names[k]);
        CHECK(classes[k]["links"] == seen.at_end[k]);
        CHECK(seen.at_end[k] > 0);
      }
  }

  std::size_t of_kind(const Seen &seen, const std::size_t kind)
  {
    return seen.links[0][kind] + seen.links[1][kind] + seen.links[2][kind];
  }

  nlohmann::json run_in(const ScratchFolder &folder, const std::string &scene)
  {
    folder.file("x.prm", scene);
    const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return nlohmann::json::parse(content_of(folder / "results/summary.json"));
  }
} // namespace

TEST_CASE("Links in files for ParaView are of the class of their ends, broken ones as well", "[apps][mesoscale][slow]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  const auto summary = run_in(folder, concrete_stack());
  for (std::size_t which : {0, 1})
    {
      const std::string test = which == 0 ? "tension" : "compression";
      const Seen        seen = snapshots_of(folder / "results", test + "_");
      agrees(seen, summary["tests"][which]["link_classes"]);
      CHECK(of_kind(seen, 2) > 0);
    }
}

namespace
{
  /** A periodic cell of concrete, in equilibrium or in motion. */
  std::string cell_of(const std::string &kind, const std::string &specimen, const std::string &rest)
  {
    return "set Kind = " + kind +
           "\nsubsection Specimen\n  set Source = file\n  set File = packing.txt\n  set Interaction ratio = 1.5\n" +
           specimen + mix_of_two_sizes() + "end\n" + material_of_concrete() + rest;
  }
} // namespace

TEST_CASE("Links of periodic cells in files for ParaView are of the class of their ends, across faces as well",
          "[apps][mesoscale][slow]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", uneven_lattice(6));
  const auto still = run_in(folder, cell_of("quasi_static", "  set Body = cell\n",
                                            "subsection Loading\n  set Tests = tension\n  set Axis = x\n"
                                            "  subsection Tension\n    set Stop strain = 1e-4\n"
                                            "    set Strain step = 1e-5\n  end\nend\n"
                                            "subsection Output\n  set Points per snapshot = 4\nend\n"));
  agrees(snapshots_of(folder / "results", "tension_"), still["tests"][0]["link_classes"]);
  std::filesystem::remove_all(folder / "results");
  const auto moving = run_in(folder, cell_of("cell", "  set Density = 4800\n",
                                             "subsection Loading\n  subsection Leg 1\n    set Duration = 2e-4\n"
                                             "    set xx = strain 2e-4\n  end\nend\n"
                                             "subsection Output\n  set Samples = 10\n  set Snapshots = 3\nend\n"));
  agrees(snapshots_of(folder / "results", "cell_"), moving["link_classes"]);
}

TEST_CASE("Links of particles inside a solid are of the class of their ends in files for ParaView, and as stiff as it",
          "[apps][mesoscale][structure][volume][slow]")
{
  const ScratchFolder folder;
  const Results       found = results_of(folder, places::sources() + "/apps/scenes/size_effect_plane.prm",
                                         {"Path/Stop fraction=0.8", "Output/Points per snapshot=5"}, {"control"});
  const Seen          seen  = snapshots_of(folder / "results", "");
  agrees(seen, found.summary["link_classes"]);
  // 25 GPa of the mortar, half of it across an interface, two and a half times within an aggregate.
  for (const auto &[number, modulus] : std::map<int, double>{{0, 25e9}, {1, 12.5e9}, {2, 62.5e9}})
    {
      INFO(names[static_cast<std::size_t>(number)]);
      REQUIRE(seen.moduli.count(number) == 1);
      CHECK(seen.moduli.at(number).first == Approx(modulus).epsilon(1e-6));
      CHECK(seen.moduli.at(number).second == Approx(modulus).epsilon(1e-6));
    }
}

namespace
{
  const std::string specimen_in_solid = R"(subsection Specimen
  set Source            = file
  set File              = packing.txt
  set Box size          = 0.012, 0.012, 0.036
  set Interaction ratio = 1.5
)";

  /** A bar of elements whose middle third is particles of concrete, held at its back and pulled at its front. */
  std::string core_in_motion()
  {
    return "set Kind = coupled\nsubsection Continuum\n  subsection Model\n    set Dimension = 3\n  end\n"
           "  subsection Mesh\n    set Source = box\n    subsection Box\n"
           "      set Size        = 0.012, 0.012, 0.036\n      set Divisions x = 3\n      set Divisions y = 3\n"
           "      set Divisions z = 9\n    end\n  end\n  subsection Materials\n    subsection solid\n"
           "      set Law     = isotropic elastic\n      set Density = 2500\n      subsection isotropic elastic\n"
           "        set Young modulus = 20e9\n        set Poisson ratio = 0.2\n      end\n    end\n  end\n"
           "  subsection Boundary conditions\n    subsection back\n      set Displacement z = 0\n    end\n"
           "    subsection front\n      set Displacement z = 0.2*t\n    end\n  end\nend\n"
           "subsection Handshakes\n  subsection core\n    set Low          = -1, -1, 0.012\n"
           "    set High         = 1, 1, 0.024\n    set Overlap      = 0.004\n    set Damage limit = 1\n  end\nend\n"
           "subsection Particles\n" +
           specimen_in_solid + "  set Density = 4800\n" + mix_of_two_sizes() + "end\n" + material_of_concrete() +
           "end\nsubsection Time\n  set End time = 4e-5\n  set Damping  = 0.1\nend\n"
           "subsection Output\n  set Samples   = 20\n  set Snapshots = 4\nend\n";
  }

  /** Elastic energies of the links of a file [J], by class, of moduli 25 GPa along and a fifth of it across. */
  std::array<double, 3> energies_in(vtkPolyData &lines)
  {
    const auto value = [&](const char *name, const vtkIdType l) {
      return field(lines.GetCellData(), name).GetTuple1(l);
    };
    std::array<double, 3> found = {};
    for (vtkIdType l = 0; l < lines.GetNumberOfCells(); ++l)
      {
        std::array<double, 3> one = {}, other = {};
        lines.GetPoint(lines.GetCell(l)->GetPointId(0), one.data());
        lines.GetPoint(lines.GetCell(l)->GetPointId(1), other.data());
        const double length = std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]);
        const double along  = value("normal_force", l) * value("normal_stress", l) / 25e9,
                     across = value("shear_force", l) * value("shear_stress", l) / 5e9;
        found[static_cast<std::size_t>(value("class", l))] += 0.5 * length * (along + across);
      }
    return found;
  }
} // namespace

TEST_CASE("Links of particles inside a solid in motion are of the class of their ends in files for ParaView",
          "[apps][mesoscale][coupled][volume]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", uneven_lattice(6));
  const auto summary = run_in(folder, core_in_motion());
  agrees(snapshots_of(folder / "results", "particles_"), summary["link_classes"]);
  for (const auto &each : summary["link_classes"])
    CHECK((each["mean_damage"] > 0) == (each["class"] != "aggregate"));
}

TEST_CASE("A solid with a core of a mix is as stiff as bounds by the energy of its links of each class say",
          "[apps][mesoscale][structure][volume][slow]")
{
  const ScratchFolder folder;
  const auto          elastic = [&](const std::string &aggregate, const std::string &interface) {
    std::filesystem::remove_all(folder / "results");
    return results_of(folder, places::sources() + "/apps/scenes/size_effect_plane.prm",
                               {"Path/End=1e-9", "Path/Step=1e-9", "Output/Points per snapshot=1",
                       "Specimen/Mix/Aggregates/Stiffness factor=" + aggregate,
                       "Specimen/Mix/Interface/Stiffness factor=" + interface},
                               {"control"})
      .series;
  };
  const auto   alike    = elastic("1", "1");
  const auto   energies = energies_in(*lines_in(folder / "results/links/links_000001.vtp"));
  const double whole = alike.column("energy_stored").back(), solid = alike.column("energy_solid_stored").back();
  // Parts of bonds that lie within elements are taken off (doc/theory/static-handshake.md, 2).
  const double counted_twice = solid + energies[0] + energies[1] + energies[2] - whole;
  CHECK(counted_twice > 0);
  CHECK(counted_twice < 0.05 * whole);
  const double found = elastic("2.5", "0.5").column("reaction_load_y").back() / alike.column("reaction_load_y").back();
  // The motions of links that are all alike, in those that are not, and their forces: neither stores the least energy.
  // Of what is counted twice all may be of the interface for the upper bound, and of aggregates for the lower.
  const double upper = (solid + energies[0] + 0.5 * (energies[1] - counted_twice) + 2.5 * energies[2]) / whole,
               lower = whole / (solid + energies[0] + energies[1] / 0.5 + (energies[2] - counted_twice) / 2.5);
  INFO(lower << " < " << found << " < " << upper);
  CHECK(upper - lower < 0.3);
  CHECK(found > lower);
  CHECK(found < upper);
}

TEST_CASE("Links of moving particles are of the class of their ends in files for ParaView, new contacts as well",
          "[apps][mesoscale]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", uneven_lattice(6));
  const auto summary =
    run_in(folder, "set Kind = particles\n" + replaced(specimen_in_solid, "0.036", "0.012") + "  set Density = 4800\n" +
                     mix_of_two_sizes() + "end\n" + material_of_concrete() +
                     "subsection Initial velocity\n  subsection all\n    set Velocity x = 2e4*z\n  end\nend\n"
                     "subsection Time\n  set End time = 2e-5\nend\n"
                     "subsection Output\n  set Samples = 6\n  set Snapshots = 3\nend\n");
  const Seen seen = snapshots_of(folder / "results", "particles_");
  agrees(seen, summary["link_classes"]);
  CHECK(of_kind(seen, 1) > 0);
  CHECK(of_kind(seen, 2) > 0);
}

TEST_CASE("Links of one material have no class in files for ParaView", "[apps][mesoscale]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", scene_with_file());
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Loading/Tests=tension"});
  REQUIRE(outcome.status == 0);
  const auto links = lines_in(folder / "results/tension_links/tension_links_000000.vtp");
  CHECK(links->GetNumberOfCells() > 0);
  CHECK(links->GetCellData()->HasArray("class") == 0);
}
