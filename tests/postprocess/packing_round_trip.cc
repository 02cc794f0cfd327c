#include "base/errors.h"
#include "postprocess/hdf5/hdf5_file.h"
#include "postprocess/packings/packing_io.h"
#include "scratch_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace postprocess;
using postprocess_tests::content_of;
using postprocess_tests::ScratchFolder;

namespace
{
  /** Numbers with all 53 bits in use, of different size. */
  dem::Packing awkward_packing(const std::size_t particles)
  {
    std::mt19937_64                        random(7);
    std::uniform_real_distribution<double> unit(0.1, 1);
    dem::Packing                           packing;
    for (std::size_t i = 0; i < particles; ++i)
      {
        packing.centre.emplace_back(i + unit(random) / 3, -unit(random) * 1e-7, unit(random) * 1e3);
        packing.radius.push_back(unit(random) * std::pow(10, -double(i % 4)));
      }
    return packing;
  }

  void require_same_bits(const dem::Packing &a, const dem::Packing &b)
  {
    REQUIRE(a.centre == b.centre); // no tolerance: == on doubles without NaN or signed zeros is equality of bits
    REQUIRE(a.radius == b.radius);
    REQUIRE(a.periodic_cell.has_value() == b.periodic_cell.has_value());
    if (a.periodic_cell)
      REQUIRE(*a.periodic_cell == *b.periodic_cell);
    REQUIRE(a.material == b.material);
    REQUIRE(a.material_names == b.material_names);
    REQUIRE(a.clump == b.clump);
    REQUIRE(a.bodies.size() == b.bodies.size());
    for (std::size_t k = 0; k < a.bodies.size(); ++k)
      {
        REQUIRE(a.bodies[k].volume == b.bodies[k].volume);
        REQUIRE(a.bodies[k].centre == b.bodies[k].centre);
        REQUIRE(a.bodies[k].inertia == b.bodies[k].inertia);
      }
  }
} // namespace

TEST_CASE("a packing read back from any format has the same bits", "[postprocess]")
{
  const ScratchFolder folder;
  const auto         *name    = GENERATE("p.txt", "p.csv", "p.h5", "p.hdf5");
  dem::Packing        packing = awkward_packing(400);
  packing.centre[0]           = {1.0 / 3, 5e-324, -0.0}; // among them the smallest number, and a signed zero
  CAPTURE(name);

  SECTION("free") {}
  SECTION("periodic") { packing.periodic_cell = Eigen::Vector3d(1.0 / 3, 0.1, 1e3 + 1e-7); }
  SECTION("of three materials, the first named not the first met, the last of no particle")
  {
    for (std::size_t i = 0; i < packing.size(); ++i)
      packing.material.push_back(i % 3 == 1 ? 0 : 1);
    packing.material_names = {"mortar", "aggregate-1", "2.5"};
  }
  SECTION("with pebbles of two rigid bodies")
  {
    packing.clump.assign(packing.size(), -1);
    packing.clump[3] = packing.clump[7] = 0;
    packing.clump[5]                    = 1;
    packing.bodies.resize(2);
    for (dem::PackedBody &body : packing.bodies)
      {
        body.volume = 1.0 / 3;
        body.centre = packing.centre[3];
        body.inertia << 1.0 / 7, 0.1, 0.2, 0.1, 1.0 / 9, 0.3, 0.2, 0.3, 1.0 / 11;
      }
  }
  write_packing(packing, folder / name);
  const dem::Packing read = read_packing(folder / name);
  require_same_bits(packing, read);
  REQUIRE(std::signbit(read.centre[0].z()));
}

TEST_CASE("metadata travels with a packing and does not change it", "[postprocess]")
{
  const ScratchFolder folder;
  const auto         *name     = GENERATE("p.txt", "p.h5");
  const Metadata      metadata = {{"generator", "compaction: isotropic, 0.55"}, {"seed", "42"}, {"empty", ""}};
  const auto          packing  = awkward_packing(3);

  write_packing(packing, folder / name, metadata);
  Metadata read = read_packing_metadata(folder / name);
  for (const auto &[key, value] : metadata)
    REQUIRE(read.at(key) == value);
  require_same_bits(packing, read_packing(folder / name));
}

TEST_CASE("metadata that would break the file is refused before anything is written", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          bad = GENERATE(Metadata{{"seed", "1\n0 0 0 1"}}, Metadata{{"a:b", ""}}, Metadata{{"a/b", ""}},
                                     Metadata{{"", "x"}}, Metadata{{"periodic_cell", "1 1 1"}});
  REQUIRE_THROWS_AS(write_packing(awkward_packing(1), folder / "p.h5", bad), std::invalid_argument);
  REQUIRE(postprocess_tests::files_in(folder.path) == 0);
}

TEST_CASE("packings written by other programs are understood", "[postprocess]")
{
  const ScratchFolder folder;
  // Two particles, in every dress: (1, 2, 3) with radius 0.5 and (4, 5, 6.25) with radius 0.25.
  const std::string text = GENERATE(as<std::string>{}, "1 2 3 0.5\n4 5 6.25 0.25\n",   // bare
                                    "1\t2\t3\t0.5\r\n4\t5\t6.25\t0.25\r\n",            // tabs, line ends of Windows
                                    "1,2,3,0.5\n4,5,6.25,0.25",                        // commas, no last line end
                                    "1 , 2 , 3 , .5\n\n  4 , 5 , 6.25 , 2.5e-1  \n\n", // blanks everywhere
                                    "\xEF\xBB\xBF# made by X: 1 2 3 4\nx y z radius\n+1 2 3 5E-1\n4 5 6.25 0.25\n",
                                    "radius z y x\n0.5 3 2 1\n0.25 6.25 5 4\n", // another order
                                    "id,r [m],X [m],Y [m],Z [m],name\n1,0.5,1,2,3,7\n2,0.25,4,5,6.25,8\n",
                                    "x [m] y [m] z [m] radius [m]\n1 2 3 0.5\n4 5 6.25 0.25\n",
                                    "# z y x radius\n3 2 1 0.5\n6.25 5 4 0.25\n", // the header as a comment
                                    "# lengths x y z radius in m\n1 2 3 0.5\n# a remark\n4 5 6.25 0.25\n");
  CAPTURE(text);
  const dem::Packing packing = read_packing(folder.file("packing.dat", text));
  REQUIRE(packing.size() == 2);
  REQUIRE(packing.centre[0] == Eigen::Vector3d(1, 2, 3));
  REQUIRE(packing.centre[1] == Eigen::Vector3d(4, 5, 6.25));
  REQUIRE(packing.radius == std::vector<double>{0.5, 0.25});
  REQUIRE_FALSE(packing.periodic_cell.has_value());
}

TEST_CASE("columns are used as a header says, commented or not: diameter in place of radius, and the unit of each",
          "[postprocess]")
{
  const ScratchFolder folder;
  // (1, 2, 3) mm with radius 0.5 mm and (4, 5, 6.25) mm with radius 0.25 mm, in a cell of 8 mm.
  const std::string columns =
    GENERATE(as<std::string>{}, // in millimetres, with diameters
             "x [mm] y [mm] z [mm] diameter [mm]\n", "x(mm) y(mm) z(mm) d(mm)\n", "X_mm,Y_mm,Z_mm,Diameter_mm\n",
             "x (mm) y (mm) z (mm) diam (mm)\n", "# all lengths in millimetres\nx y z diameter\n",
             "# x|y|z|diameter\n# all in mm\n", "x [mm];y [mm];z [mm];d [mm]\n", "# x y z diameter, all in mm\n",
             "# units: mm\n# columns: x y z d\n", "# centre (x, y, z), diameter\n# coordinates and sizes [mm]\n",
             "# format x_y_z_d\n# length unit = Millimeters\n");
  const std::string rows =
    columns.find(',') == std::string::npos || columns[0] == '#' ? "1 2 3 1\n4 5 6.25 0.5\n" : "1,2,3,1\n4,5,6.25,0.5\n";
  const bool        commented = GENERATE(false, true);
  const std::string header    = commented && columns[0] != '#' ? "# " + columns : columns;
  CAPTURE(header);
  const dem::Packing read = read_packing(folder.file("p.txt", "# periodic_cell 8 8 8\n" + header + rows));
  REQUIRE(read.size() == 2);
  CHECK(read.centre[0] == Eigen::Vector3d(1e-3, 2e-3, 3e-3)); // the very numbers that a file in metres holds
  CHECK(read.centre[1] == Eigen::Vector3d(4e-3, 5e-3, 6.25e-3));
  CHECK(read.radius == std::vector<double>{0.5e-3, 0.25e-3});
  CHECK(*read.periodic_cell == Eigen::Vector3d(8e-3, 8e-3, 8e-3));
}

TEST_CASE("a unit said at the end of a file, one of the cell alone, and sizes in prose are understood", "[postprocess]")
{
  const ScratchFolder folder;
  CHECK(read_packing(folder.file("a.txt", "1 2 3 0.5\n# lengths in cm\n")).radius.front() == 0.5e-2);
  const auto own_cell = read_packing(folder.file("b.txt", "# periodic_cell 8 8 8 [mm]\n1e-3 2e-3 3e-3 0.5e-3\n"));
  CHECK(*own_cell.periodic_cell == Eigen::Vector3d(8e-3, 8e-3, 8e-3));
  CHECK(own_cell.radius.front() == 0.5e-3);
  const auto micro = read_packing(folder.file("c.txt", "# x [mm] y [mm] z [mm] r [um]\n1 2 3 500\n"));
  CHECK(micro.centre.front() == Eigen::Vector3d(1e-3, 2e-3, 3e-3));
  CHECK(micro.radius.front() == 500e-6);
  CHECK(read_packing(folder.file("d.txt", "# spheres of 4 to 5.5 mm in a box of 20 mm x 20 mm\n1 2 3 0.5\n"))
          .radius.front() == 0.5);
}

TEST_CASE("the reader's length unit holds for files that say none, of text and of HDF5, and must not contradict one",
          "[postprocess]")
{
  const ScratchFolder folder;
  const auto          mm = base::length_unit("mm");
  CHECK(read_packing(folder.file("a.txt", "1 2 3 0.5\n"), mm).centre.front() == Eigen::Vector3d(1e-3, 2e-3, 3e-3));
  // In doubt, the reader decides.
  CHECK(read_packing(folder.file("b.txt", "# exported from CAD (mm)\n1 2 3 0.5\n"), base::length_unit("m"))
          .radius.front() == 0.5);
  REQUIRE_THROWS_WITH(
    read_packing(folder.file("c.txt", "# lengths in m\n1 2 3 0.5\n"), mm),
    Catch::Matchers::Contains("c.txt, line 1: says that lengths are in m, and Length unit that they are in mm"));
  REQUIRE_THROWS_WITH(read_packing(folder.file("d.txt", "x[m] y[m] z[m] r[m]\n1 2 3 0.5\n"), mm),
                      Catch::Matchers::Contains("d.txt, line 1: a column is in [m]"));
  const double centre[3] = {1, 2, 3}, radius[1] = {0.5}, cell[3] = {8, 8, 8};
  for (const char *units : {"", "mm", "px"})
    {
      hdf5::OutputFile file(folder / (std::string("e") + units + ".h5"));
      file.write("centre", centre, {1, 3});
      file.write("radius", radius, {1});
      file.write("periodic_cell", cell, {3});
      if (*units != 0)
        file.write_text("units", units);
      file.commit();
    }
  CHECK(read_packing(folder / "emm.h5").radius.front() == 0.5e-3);
  CHECK(says_length_unit(folder / "emm.h5"));
  CHECK_FALSE(says_length_unit(folder / "e.h5"));
  REQUIRE_THROWS_WITH(read_packing(folder / "emm.h5", base::length_unit("m")),
                      Catch::Matchers::Contains("says that lengths are in mm"));
  REQUIRE_THROWS_WITH(read_packing(folder / "epx.h5"), Catch::Matchers::Contains("\"units\" is \"px\""));
  const dem::Packing read = read_packing(folder / "e.h5", mm);
  CHECK(read.centre.front() == Eigen::Vector3d(1e-3, 2e-3, 3e-3));
  CHECK(read.radius.front() == 0.5e-3);
  CHECK(*read.periodic_cell == Eigen::Vector3d(8e-3, 8e-3, 8e-3));
}

TEST_CASE("what a comment says besides key and value does not hinder a packing from being written again",
          "[postprocess]")
{
  const ScratchFolder folder;
  const auto     path = folder.file("p.txt", "# Discs of 0.35 to 0.7 mm, at rest; two dimensions: x y z radius [m]\n"
                                                 "# length unit: m\n# seed: 7\n1 2 0 0.5\n");
  const Metadata read = read_packing_metadata(path);
  CHECK(read == Metadata{{"seed", "7"}});
  write_packing(read_packing(path), folder / "again.txt", read);
  require_same_bits(read_packing(path), read_packing(folder / "again.txt"));
}

TEST_CASE("materials are words in a named column, numbered as they come; without names HDF5 has numbers alone",
          "[postprocess]")
{
  const ScratchFolder folder;
  const auto          commas = read_packing(folder.file("a.csv", "Material, x, y, z, r\nsand, 0, 0, 0, 1\n"
                                                                          "paste, 3, 0, 0, 1\nsand, 6, 0, 0, 1\n"));
  REQUIRE(commas.material == std::vector<std::int32_t>{0, 1, 0});
  REQUIRE(commas.material_names == std::vector<std::string>{"sand", "paste"});
  const auto numbered = read_packing(folder.file("b.txt", "x y z r material\n0 0 0 1 7\n3 0 0 1 0\n"));
  REQUIRE(numbered.material_names == std::vector<std::string>{"7", "0"});
  REQUIRE(read_packing(folder.file("c.txt", "x y z r matter\n0 0 0 1 7\n3 0 0 1 0\n")).material.empty());

  // Without a column to name the line is prose, whatever it says.
  REQUIRE(read_packing(folder.file("e.txt", "# materials: (see the report)\n0 0 0 1\n")).material.empty());

  dem::Packing nameless = commas;
  nameless.material_names.clear();
  write_packing(nameless, folder / "d.h5");
  REQUIRE(read_packing(folder / "d.h5").material == nameless.material);
  REQUIRE(read_packing(folder / "d.h5").material_names.empty());
  write_packing(nameless, folder / "d.txt");
  REQUIRE(read_packing(folder / "d.txt").material_names == std::vector<std::string>{"0", "1"});
}

TEST_CASE("the periodic cell of a text packing is read from its comment", "[postprocess]")
{
  const ScratchFolder folder;
  const std::string   line    = GENERATE("# periodic_cell 1 2 3.5\n", "#periodic_cell: 1, 2, 3.5\n");
  const dem::Packing  packing = read_packing(folder.file("p.txt", line + "0 0 0 0.1\n"));
  REQUIRE(packing.periodic_cell.has_value());
  REQUIRE(*packing.periodic_cell == Eigen::Vector3d(1, 2, 3.5));
}

TEST_CASE("the format of a packing is recognised by its content, not by its name", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          packing = awkward_packing(5);
  write_packing(packing, folder / "p.h5");
  std::filesystem::rename(folder / "p.h5", folder / "p.dat");
  require_same_bits(packing, read_packing(folder / "p.dat"));
}

TEST_CASE("writing the same packing twice gives the same bytes", "[postprocess]")
{
  const ScratchFolder folder;
  const auto         *extension = GENERATE(".txt", ".h5");
  const auto          packing   = awkward_packing(50);
  write_packing(packing, folder / ("a" + std::string(extension)), {{"seed", "1"}});
  write_packing(packing, folder / ("b" + std::string(extension)), {{"seed", "1"}});
  REQUIRE(content_of(folder / ("a" + std::string(extension))) == content_of(folder / ("b" + std::string(extension))));
}

TEST_CASE("a packing of 200,000 particles is written and read back", "[postprocess]")
{
  const ScratchFolder folder;
  const auto         *name    = GENERATE("p.txt", "p.h5");
  auto                packing = awkward_packing(200000); // more than one chunk of the HDF5 file
  for (auto &centre : packing.centre)
    centre *= 1e-4; // not so far out that radii no longer distinguish places
  write_packing(packing, folder / name);
  require_same_bits(packing, read_packing(folder / name));
}
