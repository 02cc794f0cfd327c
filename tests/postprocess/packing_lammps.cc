// Packings in files of other programs: there and back, and what they leave open.
#include "base/errors.h"
#include "postprocess/packings/packing_io.h"
#include "scratch_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace postprocess;
using Catch::Contains;
using postprocess_tests::content_of;
using postprocess_tests::ScratchFolder;

namespace
{
  dem::Packing uneven_spheres(const bool periodic, const bool of_materials)
  {
    std::mt19937_64                        random(11);
    std::uniform_real_distribution<double> unit(0.1, 1);
    dem::Packing                           packing;
    for (int i = 0; i < 300; ++i)
      {
        packing.centre.emplace_back(i + unit(random) / 3, -unit(random) * 1e-7, unit(random) * 1e3);
        packing.radius.push_back(unit(random) * std::pow(10, -double(i % 4)));
        if (of_materials)
          packing.material.push_back(i % 3);
      }
    if (periodic)
      packing.periodic_cell = Eigen::Vector3d(1.0 / 3, 301.1, 1e3 + 1e-7);
    return packing;
  }

  const char *const data_of_write_data = "LAMMPS data file via write_data, version 23 Jun 2022, timestep = 1000\n"
                                         "\n"
                                         "3 atoms\n2 atom types\n\n"
                                         "-1 9 xlo xhi\n0 10 ylo yhi\n0 10 zlo zhi\n\n"
                                         "Atoms # sphere\n\n"
                                         "3 2 1.5 2500 3 3 3 0 0 0\n"
                                         "1 1 1 2500 1 1 1 0 0 0\n"
                                         "2 1 2 2500 5 5 5 0 -1 0\n\n"
                                         "Velocities\n\n3 0 0 0 0 0 0\n1 0 0 0 0 0 0\n2 0 0 0 0 0 0\n";

  std::string with(std::string text, const std::string &from, const std::string &to)
  {
    return text.replace(text.find(from), from.size(), to);
  }
} // namespace

TEST_CASE("a packing read back from files of LAMMPS has the same bits", "[postprocess]")
{
  const ScratchFolder folder;
  const auto         *name     = GENERATE("p.data", "p.lmp", "p.dump", "p.lammpstrj");
  const bool          periodic = GENERATE(false, true), of_materials = GENERATE(false, true);
  CAPTURE(name, periodic, of_materials);
  const dem::Packing packing = uneven_spheres(periodic, of_materials);
  write_packing(packing, folder / name);
  const dem::Packing read = read_packing(folder / name);
  CHECK(read.centre == packing.centre);
  CHECK(read.radius == packing.radius);
  CHECK(read.material == packing.material);
  CHECK(read.material_names == (of_materials ? std::vector<std::string>{"1", "2", "3"} : std::vector<std::string>{}));
  REQUIRE(read.periodic_cell.has_value() == periodic);
  if (periodic)
    CHECK(*read.periodic_cell == *packing.periodic_cell);
  // And on to text and back again: nothing is lost on the way.
  write_packing(read, folder / "again.txt");
  write_packing(read_packing(folder / "again.txt"),
                folder / ("again" + std::filesystem::path(name).extension().string()));
  CHECK(content_of(folder / ("again" + std::filesystem::path(name).extension().string())) == content_of(folder / name));
}

TEST_CASE("a file of write_data is understood: any order, images, types; its box is no cell, as it does not say so",
          "[postprocess]")
{
  const ScratchFolder folder;
  const dem::Packing  read = read_packing(folder.file("x.data", data_of_write_data));
  CHECK(read.radius == std::vector<double>{0.5, 1, 0.75}); // by number
  CHECK(read.centre[2] == Eigen::Vector3d(3, 3, 3));
  CHECK(read.material == std::vector<std::int32_t>{0, 0, 1});
  CHECK_FALSE(read.periodic_cell.has_value());
  CHECK_FALSE(says_length_unit(folder / "x.data"));
  const dem::Packing in_mm = read_packing(folder / "x.data", base::length_unit("mm"));
  CHECK(in_mm.radius[2] == 0.75e-3);
  CHECK(in_mm.centre[1] == Eigen::Vector3d(5e-3, 5e-3, 5e-3));
  write_packing(read, folder / "ours.data"); // says metres
  CHECK(says_length_unit(folder / "ours.data"));
  CHECK_THROWS_WITH(read_packing(folder / "ours.data", base::length_unit("mm")), Contains("lengths are in m,"));
}

TEST_CASE("a dump is understood: columns in any order, its last snapshot, a cell that does not begin at zero",
          "[postprocess]")
{
  const ScratchFolder folder;
  const std::string   snapshot = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n"
                                 "-2 2\n-2 2\n0 8\nITEM: ATOMS radius vx zu yu xu id\n";
  const dem::Packing  read     = read_packing(
         folder.file("x.dump", snapshot + "1 0 9 9 9 1\n1 0 9 9 9 2\n" + snapshot + "0.5 7 1 1 1 2\n0.25 7 3 0 -1 1\n"));
  CHECK(read.radius == std::vector<double>{0.25, 0.5});
  CHECK(read.centre[0] == Eigen::Vector3d(1, 2, 3));
  CHECK(*read.periodic_cell == Eigen::Vector3d(4, 4, 8));
  CHECK(read.material.empty());
}

TEST_CASE("files of LAMMPS that are no packing are refused with their line", "[postprocess]")
{
  const ScratchFolder folder;
  const std::string   data    = data_of_write_data;
  const auto          refused = [&](const char *name, const std::string &text, const std::string &message) {
    CHECK_THROWS_WITH(read_packing(folder.file(name, text)), Contains(name) && Contains(message));
  };
  refused("a.data", with(data, "Atoms # sphere", "Atoms # atomic"), "line 10: atom style atomic");
  refused("a.data", with(data, "Atoms # sphere", "Bonds"), "has no section Atoms");
  refused("a.data", with(data, "1 1 1 2500", "1 1 0 2500"), "atom 1 has no size");
  refused("a.data", with(data, "3 3 3 0 0 0", "3 3 three 0 0 0"), "line 12");
  refused("a.data", with(data, "3 3 3 0 0 0", "3 3 3 0"), "line 12: found 8 columns");
  refused("a.data", with(data, "zlo zhi\n", "zlo zhi\n0 0 0 xy xz yz\n"), "line 9: the box is triclinic");
  refused("a.data", data.substr(0, data.find("2 1 2 2500")), "ends where atom 3 of 3 should stand");
  const std::string dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n0 1\n"
                           "ITEM: ATOMS x y z radius\n.5 .5 .5 .1\n";
  refused("a.dump", dump, "periodic along 2 of three edges");
  refused("a.dump", with(dump, "radius", "mass"), "line 9: columns must be x y z");
  refused("a.dump", with(dump, ".5 .1", ".5"), "line 10: found 3 columns, expected 4");

  dem::Packing discs       = uneven_spheres(true, false);
  discs.periodic_cell->z() = INFINITY;
  CHECK_THROWS_WITH(write_packing(discs, folder / "d.dump"), Contains("periodic along some edges"));
  CHECK_FALSE(std::filesystem::exists(folder / "d.dump"));
}

TEST_CASE("types of LAMMPS that no atom is of are kept, there and back", "[postprocess]")
{
  const ScratchFolder folder;
  const std::string   data = with(data_of_write_data, "2 atom types", "4 atom types");
  const dem::Packing  read = read_packing(folder.file("x.data", with(data, "3 2 1.5", "3 3 1.5")));
  CHECK(read.material == std::vector<std::int32_t>{0, 0, 2});
  CHECK(read.material_names == std::vector<std::string>{"1", "2", "3", "4"});
  write_packing(read, folder / "y.data");
  CHECK_THAT(content_of(folder / "y.data"), Contains("\n4 atom types\n"));
  CHECK(read_packing(folder / "y.data").material_names == read.material_names);
  write_packing(read, folder / "y.dump"); // says nothing of types beyond the last that is used
  CHECK(read_packing(folder / "y.dump").material == read.material);
  CHECK(read_packing(folder / "y.dump").material_names == std::vector<std::string>{"1", "2", "3"});
  CHECK_THROWS_WITH(read_packing(folder.file("z.data", with(data, "3 2 1.5", "3 5 1.5"))),
                    Contains("line 12: type 5: expected a whole number from 1 to 4"));
  CHECK_THROWS_WITH(read_packing(folder.file("z.data", with(data, "3 2 1.5", "3 1.5 1.5"))), Contains("type 1.5"));
}

TEST_CASE("a packing read back from a file for YADE has the same bits", "[postprocess]")
{
  const ScratchFolder folder;
  const bool          periodic = GENERATE(false, true), of_materials = GENERATE(false, true);
  CAPTURE(periodic, of_materials);
  dem::Packing packing = uneven_spheres(periodic, of_materials);
  if (of_materials)
    packing.material_names = {"mortar", "unused", "3", "steel"}; // the last has no particle
  for (std::int32_t &number : packing.material)
    number = number == 1 ? 2 : number;
  write_packing(packing, folder / "p.yade", {{"seed", "11"}});
  const std::string text = content_of(folder / "p.yade");
  CHECK(text.rfind(of_materials ? "#format x_y_z_r_matId\n" : "#format x_y_z_r\n", 0) == 0);
  CHECK_THAT(text, !Contains("\n\n")); // its reader takes no blank line
  const dem::Packing read = read_packing(folder / "p.yade");
  CHECK(read.centre == packing.centre);
  CHECK(read.radius == packing.radius);
  CHECK(read.material == packing.material);
  CHECK(read.material_names == packing.material_names);
  CHECK(read_packing_metadata(folder / "p.yade").at("seed") == "11");
  REQUIRE(read.periodic_cell.has_value() == periodic);
  if (periodic)
    CHECK(*read.periodic_cell == *packing.periodic_cell);
  write_packing(read, folder / "again.yade", {{"seed", "11"}});
  CHECK(content_of(folder / "again.yade") == text);
}

TEST_CASE("what has no place in a file for YADE is refused, and so is a number that names no material", "[postprocess]")
{
  const ScratchFolder folder;
  dem::Packing        clumped = uneven_spheres(false, false);
  clumped.bodies.resize(1);
  CHECK_THROWS_WITH(write_packing(clumped, folder / "p.yade"), Contains("rigid bodies"));
  dem::Packing discs       = uneven_spheres(true, false);
  discs.periodic_cell->z() = INFINITY;
  CHECK_THROWS_WITH(write_packing(discs, folder / "p.yade"), Contains("periodic along some edges"));
  CHECK_FALSE(std::filesystem::exists(folder / "p.yade"));
  const char *const text = "#format x_y_z_r_matId\n# materials a b\n0 0 0 1 0\n3 0 0 1 2\n";
  CHECK_THROWS_WITH(read_packing(folder.file("x.yade", text)), Contains("line 4: material 2") && Contains("names 2"));
}

TEST_CASE("tables of YADE with the number of a material, and of PFC with position columns, are read", "[postprocess]")
{
  const ScratchFolder folder;
  const dem::Packing  yade =
    read_packing(folder.file("yade.txt", "#format x_y_z_r_matId\n0\t0\t0\t0.5\t1\n0\t0\t1\t0.5\t0\n0\t0\t2\t0.5\t1\n"));
  CHECK(yade.radius == std::vector<double>(3, 0.5));
  CHECK(yade.material == std::vector<std::int32_t>{0, 1, 0});
  CHECK(yade.material_names == std::vector<std::string>{"1", "0"});
  const dem::Packing pfc =
    read_packing(folder.file("pfc.csv", "id,density,radius,pos_x,pos_y,pos_z\n7,2500,0.5,1,2,3\n9,2500,0.25,4,5,6\n"));
  CHECK(pfc.radius == std::vector<double>{0.5, 0.25});
  CHECK(pfc.centre[1] == Eigen::Vector3d(4, 5, 6));
}
