// Numbers in another unit: questioned, and taken when the unit is named; the unit of lengths in files; what check reports of extents.
#include "apps/text/column_unit.h"
#include "tests/apps/continuum_scenes.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  struct OddNumber
  {
    std::string scene, entry, value, unit, question;
  };

} // namespace

TEST_CASE("A number of another unit is questioned in every dimension, and taken with its unit named", "[apps]")
{
  const auto odd = GENERATE(
    OddNumber{"quick_uniaxial.prm", "Material/CPM/Cohesion", "3", "Pa", "no solid is so weak. In MPa?"},
    OddNumber{"quick_uniaxial.prm", "Material/CPM/Limit elastic strain", "1", "-", "a pure number, e.g. 1e-4"},
    OddNumber{"quick_uniaxial.prm", "Material/CPM/Friction coefficient", "38", "-", "0.78 for 38 degrees"},
    OddNumber{"quick_uniaxial.prm", "Specimen/Density", "2.4", "kg/m^3", "In t/m^3 or g/cm^3?"},
    OddNumber{"rock_triaxial.prm", "Laboratory/Confining pressure", "5", "Pa", "In MPa or kPa?"},
    OddNumber{"mortar_window.prm", "Material/flat-joint/Tensile strength", "6", "Pa", "no solid is so weak"},
    OddNumber{"rock_triaxial.prm", "Material/parallel-bond/Friction angle", "0.5", "degrees", "In radians?"},
    OddNumber{"plate_with_hole.prm", "Boundary conditions/right/Traction x", "1", "Pa", "In MPa or kPa?"},
    OddNumber{"notched_beam.prm", "Materials/solid/damage-plastic concrete/Fracture energy", "0.11", "J/m^2",
              "about 100 is usual. In N/mm?"},
    OddNumber{"notched_beam.prm", "Materials/solid/damage-plastic concrete/Young modulus", "30000", "Pa", "so soft"},
    OddNumber{"notched_beam.prm", "Mesh/Notched beam/Length", "450", "m", "In mm?"},
    OddNumber{"bouncing_sphere.prm", "Gravity/Acceleration", "0, 0, -9810", "m/s^2", "In mm/s^2?"},
    OddNumber{"quick_uniaxial.prm", "Specimen/Generator/Particle radius", "1.5", "m", "In mm?"},
    OddNumber{"quick_uniaxial.prm", "Loading/Area", "900", "m^2", "that is large. In mm^2?"},
    OddNumber{"jointed_network.prm", "Specimen/Joints/flat/smooth-joint/Normal stiffness", "200", "Pa/m", "In MPa/mm?"},
    OddNumber{"pressed_spheres.prm", "Walls/box/Upper", "46, 46, 300", "m", "that is far away. In mm?"},
    OddNumber{"bar_impact.prm", "Boundary conditions/left/Displacement x", "5", "m", "that is far. In mm?"},
    OddNumber{"plate_with_hole.prm", "Boundary conditions/right/Traction x", "1*t", "Pa", "In MPa or kPa?"},
    OddNumber{"plate_with_hole.prm", "Body force/y", "-24*t", "N/m^3", "In kN/m^3?"},
    OddNumber{"quick_uniaxial.prm", "Loading/Tension/Strain rate", "100", "1/s", "In per mille or per cent a second?"},
    OddNumber{"bouncing_sphere.prm", "Time/End time", "500", "s", "In ms or us?"},
    OddNumber{"rock_compression.prm", "Laboratory/Smoothing depth", "1", "m", "a small part of a particle"},
    OddNumber{"bouncing_sphere.prm", "Initial velocity/ball/Velocity z", "-1500", "m/s", "In mm/s?"});
  const ScratchFolder folder;
  INFO(odd.scene << ": " << odd.entry << " = " << odd.value);
  const auto check = [&](const std::string &value) {
    // A later entry that nothing takes ends the reading.
    return run(folder.path(),
               {"check", places::scene(odd.scene), "-s", odd.entry + "=" + value, "-s", "Output/Samples=none"});
  };
  const Outcome requested = check(odd.value);
  CHECK(requested.status == 2);
  CHECK_THAT(requested.err, Contains(odd.entry + " = " + odd.value + ": ") && Contains(odd.question) &&
                              Contains("If it is meant, name the unit: " + odd.value + " " + odd.unit));
  CHECK_THAT(check(odd.value + " " + odd.unit).err, Contains("Output/Samples = none: expected a whole number"));
}

TEST_CASE("The thickness and the end of a peridynamic body are questioned, and taken with their unit named", "[apps]")
{
  const ScratchFolder folder;
  const auto          check = [&](const std::string &change) {
    return run(folder.path(), {"check", places::scene("peridynamic_branching.prm"), "-s", change});
  };
  CHECK_THAT(check("Body/Thickness=10").err, Contains("Body/Thickness = 10: that is large. In mm?"));
  CHECK(check("Body/Thickness=10 m").status == 0);
  CHECK_THAT(check("Analysis/End time=500").err,
             Contains("Analysis/End time = 500: that is long") && Contains("name the unit: 500 s"));
}

TEST_CASE("A column of any usual unit is put into that of the System", "[apps]")
{
  struct Case
  {
    const char *from, *to;
    double      of_one;
  };
  for (const Case &one :
       {Case{"MPa", "Pa", 1e6}, Case{"N/mm^2", "Pa", 1e6}, Case{"GPa", "Pa", 1e9}, Case{"kN", "N", 1e3},
        Case{"mm", "m", 1e-3}, Case{"um", "m", 1e-6}, Case{"mm^2", "m^2", 1e-6}, Case{"cm^3", "m^3", 1e-6},
        Case{"%", "-", 1e-2}, Case{"per mille", "-", 1e-3}, Case{"ms", "s", 1e-3}, Case{"min", "s", 60},
        Case{"mm/s", "m/s", 1e-3}, Case{"g", "kg", 1e-3}, Case{"deg", "rad", 0.017453292519943295}, Case{"m", "m", 1},
        Case{"-", "-", 1}, Case{"N/m", "N/m", 1}, Case{"", "", 1}})
    {
      INFO(one.from);
      postprocess::CsvTable table{{"x"}, {one.from}, {{1.0, 3.0}}, "t.csv", {}};
      apps::put_in_si(table, 0);
      CHECK(table.units[0] == one.to);
      CHECK(table.columns[0][1] == Approx(3 * one.of_one).epsilon(1e-14));
    }
  postprocess::CsvTable table{{"x"}, {"psi"}, {{1.0}}, "t.csv", {}};
  CHECK_THROWS_WITH(apps::put_in_si(table, 0), Contains("t.csv: column x is in [psi], which is not known"));
}

TEST_CASE("The stress of a cell's leg is questioned, and taken with its unit named", "[apps]")
{
  const ScratchFolder folder;
  const auto          check = [&](const std::string &target) {
    return run(folder.path(), {"check", places::scene("periodic_cell.prm"), "-s", "Loading/Leg 1/yy=" + target, "-s",
                               "Output/Samples=none"});
  };
  CHECK_THAT(check("stress -1").err, Contains("Leg 1/yy = stress -1: a solid hardly feels so small a load."));
  for (const char *meant : {"stress -1 Pa", "stress -1e6", "strain -1", "stress 0"})
    CHECK_THAT(check(meant).err, Contains("Output/Samples = none: expected a whole number"));
}

TEST_CASE("Numbers in lists are questioned, and taken where each names its unit", "[apps]")
{
  const auto odd =
    GENERATE(OddNumber{"mortar_window.prm", "Specimen/Genesis/Classes", "1: 0.4, 2-3: 0.6", "m", "In mm?"},
             OddNumber{"concrete_aggregates.prm", "Specimen/Genesis/Aggregates/Sizes", "5, 7, 9", "m", "In mm?"},
             OddNumber{"transfer_compression.prm", "Particles/Uniaxial/Instants", "-1 > -0.5", "-", "In per cent?"},
             OddNumber{"impact_beam.prm", "Particles/Impact/Impactor velocities", "2000", "m/s", "In mm/s?"},
             OddNumber{"wave_transmission.prm", "Waves/Wavelengths", "400, 640", "m", "that is long. In mm?"},
             OddNumber{"tumbling_bodies.prm", "More particles/brick/Corners",
                       "-15, -7, -5; 15, -7, -5; -15, 7, -5; 15, 7, -5; -15, -7, 6; 15, -7, 6; -15, 7, 6; 15, 7, 6",
                       "m", "that is large for a body of pebbles. In mm?"});
  const ScratchFolder folder;
  INFO(odd.scene << ": " << odd.entry << " = " << odd.value);
  const auto check = [&](const std::string &value) {
    // A later entry that nothing takes ends the reading.
    const std::string last = odd.entry.find("Particles") == 0 ? "Study/Least force=none" :
                             odd.entry.find("Waves") == 0     ? "Waves/Angle=none" :
                                                                "Output/Samples=none";
    return run(folder.path(), {"check", places::scene(odd.scene), "-s", odd.entry + "=" + value, "-s", last});
  };
  const Outcome requested = check(odd.value);
  CHECK(requested.status == 2);
  CHECK_THAT(requested.err,
             Contains(odd.entry + " = ") && Contains(odd.question) && Contains("If it is meant, name the unit: "));
  std::string       named = odd.value;
  const std::size_t colon = named.find(':');
  if (colon == std::string::npos)
    for (std::size_t end = named.find_first_of(",;"); end != std::string::npos;
         end             = named.find_first_of(",;", end + 5))
      named.insert(end, " " + odd.unit);
  else
    named = "1 m: 0.4, 2-3 m: 0.6";
  CHECK_THAT(check(colon == std::string::npos ? named + " " + odd.unit : named).err,
             !Contains(odd.question) && Contains(" = none: expected"));
}

TEST_CASE("Numbers of the command line are questioned as those of scenes", "[apps]")
{
  const ScratchFolder folder;
  const auto          refused = [&](const std::vector<std::string> &words, const std::string &question) {
    const Outcome outcome = run(folder.path(), words);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(question) && Contains("If it is meant, name the unit: "));
  };
  refused({"pack", "--radius", "1.5", "--count", "64", "-o", "p.txt"}, "that is large for a particle. In mm?");
  refused({"pack", "--radius", "1e-3", "--box", "40,40,80", "-o", "p.txt"}, "In mm?");
  const std::vector<std::string> homogenise = {"homogenise", "p.txt", "--interaction-ratio", "1.5"};
  const auto                     with       = [&](std::vector<std::string> more) {
    more.insert(more.begin(), homogenise.begin(), homogenise.end());
    return more;
  };
  refused(with({"--normal-modulus", "25", "--shear-ratio", "0.2"}), "In GPa or MPa?");
  refused(with({"--normal-modulus", "25e9", "--shear-ratio", "0.2", "--installation-gap", "1"}), "In mm?");
  CHECK(run(folder.path(), {"pack", "--radius", "1.5 m", "--count", "64", "-o", "p.txt"}).status == 0);
  CHECK(run(folder.path(), with({"--normal-modulus", "25 Pa", "--shear-ratio", "0.2"})).status == 0);
}

TEST_CASE("A soft concrete is taken as its own hint says", "[apps]")
{
  const ScratchFolder folder;
  const std::string   law   = "Materials/solid/damage-plastic concrete/";
  const auto          check = [&](const std::string &modulus, const std::string &strength) {
    return run(folder.path(), {"check", places::scene("notched_beam.prm"), "-s", law + "Young modulus=" + modulus, "-s",
                               law + "Tensile strength=" + strength, "-s", "Mesh/Notched beam/Fine size=0.02"});
  };
  CHECK_THAT(check("5e5", "3e6").err, Contains("name the unit: 5e5 Pa"));
  CHECK_THAT(check("5e5 Pa", "900").err, Contains("name the unit: 900 Pa"));
  const Outcome meant = check("5e5 Pa", "900 Pa");
  INFO(meant.err);
  CHECK(meant.status == 0);
}

TEST_CASE("A packing in millimetres is questioned where no unit is given, and read with it", "[apps]")
{
  const ScratchFolder folder;
  folder.file("x.prm", scene_with_file());
  std::string millimetres;
  for (const char *place : {"0 0 0", "0 0 2", "0 0 4", "0 2 0", "0 2 2", "0 2 4", "2 0 0", "2 0 2", "2 0 4"})
    millimetres += std::string(place) + " 1\n";
  folder.file("packing.txt", millimetres);
  is_refused(folder, "x.prm", {}, "a particle of radius 1 m, and nothing says the unit. In mm?");
  const std::vector<std::string> quick = {"Loading/Tests=tension", "Loading/Tension/Strain rate=1e-4"};
  const std::string extents            = "extents      x -0.001 to 0.003 m, y -0.001 to 0.003 m, z -0.001 to 0.005 m\n"
                                         "  radius       0.001 m\n";
  auto              with               = quick;
  with.emplace_back("Specimen/Length unit=mm");
  const Outcome by_scene = outcome_of(folder, "check", "x.prm", with);
  CHECK(by_scene.status == 0);
  CHECK_THAT(by_scene.out, Contains(extents));
  folder.file("packing.txt", "# lengths in mm\n" + millimetres);
  CHECK_THAT(outcome_of(folder, "check", "x.prm", quick).out, Contains(extents));
  is_refused(folder, "x.prm", {"Specimen/Length unit=m"}, "packing.txt, line 1: says that lengths are in mm");
}

TEST_CASE("A commented header of diameters gives the stiffness of the cell that it is", "[apps]")
{
  const ScratchFolder folder;
  const auto          homogenise = [&](const std::string &packing, const std::vector<std::string> &more = {}) {
    folder.file("cell.txt", packing);
    std::vector<std::string> words = {"homogenise",       "cell.txt", "--interaction-ratio", "1.05",
                                      "--normal-modulus", "25e9",     "--shear-ratio",       "0.2"};
    words.insert(words.end(), more.begin(), more.end());
    return run(folder.path(), words);
  };
  const auto stiffness = [](const Outcome &outcome) {
    INFO(outcome.err);
    CHECK(outcome.status == 0);
    return outcome.out.substr(0, outcome.out.find("  solved "));
  };
  const std::string cell = "# periodic_cell 0.004 0.004 0.004\n", by_radius = cell + "0.002 0.002 0.002 0.002\n";
  const std::string right = stiffness(homogenise(by_radius));
  CHECK_THAT(right, Contains("1 particles, 3 links"));
  CHECK(stiffness(homogenise(cell + "# x y z diameter\n0.002 0.002 0.002 0.004\n")) == right);
  CHECK(stiffness(homogenise("# periodic_cell 4 4 4\n2 2 2 2\n", {"--length-unit", "mm"})) == right);
  CHECK(homogenise(cell + "# x y z size\n0.002 0.002 0.002 0.004\n").status == 2);
  CHECK_THAT(homogenise(by_radius, {"--length-unit", "furlong"}).err,
             Contains("furlong: expected one of m, cm, mm, um"));
}

TEST_CASE("check reports the extents of the particles, whatever the kind of scene", "[apps][slow]")
{
  const ScratchFolder folder;
  for (const char *scene :
       {"own_packing.prm", "quasi_static.prm", "bonded_beam.prm", "periodic_cell.prm", "homogenisation_sweep.prm",
        "bending_with_core.prm", "beam_and_spheres.prm", "transfer_compression.prm"})
    {
      const Outcome found = run(folder.path(), {"check", places::scene(scene)});
      INFO(scene << "\n" << found.out << found.err);
      CHECK_THAT(found.out, Contains("\n  extents      x "));
      CHECK_THAT(found.out, Contains("\n  radius       ") || Contains("\n  radii        "));
    }
}

TEST_CASE("A mesh in millimetres is questioned, and read with its unit", "[apps]")
{
  const ScratchFolder folder;
  std::string         large = two_squares_mesh();
  for (const auto &[from, to] : std::vector<std::pair<std::string, std::string>>{
         {"2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n",
          "2 1000 0 0\n3 2000 0 0\n4 0 1000 0\n5 1000 1000 0\n6 2000 1000 0\n"}})
    large = replaced(large, from, to);
  folder.file("two.msh", large);
  folder.file("x.prm", two_squares_scene());
  is_refused(folder, "x.prm", {}, "two.msh: the mesh is 2000 m long along x. In mm? Set Mesh/Length unit = mm");
  const Results found = results_of(folder, "x.prm", {"Mesh/Length unit=mm"});
  CHECK(found.summary["figures"]["final_displacement_end_x"]["value"].get<double>() == Approx(1.5e-4).epsilon(1e-9));
}
