#include "base/errors.h"
#include "postprocess/files/errors.h"
#include "postprocess/hdf5/hdf5_file.h"
#include "postprocess/packings/packing_io.h"
#include "scratch_folder.h"

#include <catch2/catch.hpp>

using namespace postprocess;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using postprocess_tests::content_of;
using postprocess_tests::ScratchFolder;

namespace
{
  dem::Packing two_particles() { return {{{0, 0, 0}, {1, 0, 0}}, {0.5, 0.5}, std::nullopt}; }

  struct Refusal
  {
    std::string text, message; ///< of the file; after "FILE"
  };

  const std::string of_diameters =
    ": speaks of diameters, and the fourth column is taken for the radius. Say what it is above the rows: \"# x y z "
    "diameter\", or \"# x y z radius\".";
} // namespace

TEST_CASE("a faulty text packing is refused with file, line and reason", "[postprocess]")
{
  const auto refusal = GENERATE(
    Refusal{"0 0 0 1\n0 0 1\n", ", line 2: found 3 columns, expected 4: x y z radius."},
    Refusal{"0 0 0 1 7\n", ", line 1: found 5 columns, expected 4: x y z radius."},
    Refusal{"id x y z r\n1 0 0 0 1\n2 0 0 1\n", ", line 3: found 4 columns, expected 5 as in the header."},
    Refusal{"# note\n0 0 zero 1\n", ", line 2: \"zero\" is not a number."},
    Refusal{"0 0 1.5m 1\n", ", line 1: \"1.5m\" is not a number."},
    Refusal{"0 0 1e999 1\n", ", line 1: \"1e999\" is not a number."},
    Refusal{"0 0 nan 1\n", ", line 1: \"nan\": only finite numbers are allowed."},
    Refusal{"nan 0 0 1\n", ", line 1: \"nan\": only finite numbers are allowed."},
    Refusal{"0 0 0 -inf\n", ", line 1: \"-inf\": only finite numbers are allowed."},
    Refusal{"0 0 0 1\n9 9 9 0\n", ", line 2: radius = 0: must be above 0."},
    Refusal{"0 0 0 -1e-3\n", ", line 1: radius = -1e-3: must be above 0."},
    Refusal{"x y z\n0 0 0\n",
            ", line 1: the header must name each of the columns x, y, z and radius (or diameter) once."},
    Refusal{"x y z r radius\n",
            ", line 1: the header must name each of the columns x, y, z and radius (or diameter) once."},
    Refusal{"# x y z size\n0 0 0 1\n",
            ", line 1: the header must name each of the columns x, y, z and radius (or diameter) once."},
    Refusal{"# x y z of centres\n0 0 0 1\n",
            ", line 1: seems to name the 4 columns below, and not each of x, y, z and radius (or diameter) once. Name "
            "them so, e.g. \"# x y z radius\", or reword the comment."},
    Refusal{"# column 4 is the diameter\n0 0 0 1\n", ", line 1" + of_diameters},
    Refusal{"0 0 0 1\n# x y z diameter\n", ", line 2" + of_diameters},
    Refusal{"# positions and diameters.\n0 0 0 1\n", ", line 1" + of_diameters},
    Refusal{"# cx cy cz rad\n0 0 0 1\n",
            ", line 1: seems to name the 4 columns below, and not each of x, y, z and radius (or diameter) once. Name "
            "them so, e.g. \"# x y z radius\", or reword the comment."},
    Refusal{"x y z radius [mm]\n0 0 0 1\n", ", line 1: some of the columns x, y, z and radius (or diameter) have a "
                                            "unit and others none: name it for each."},
    Refusal{"# x y z radius [mm]\n0 0 0 1\n", ", line 1: some of the columns x, y, z and radius (or diameter) have a "
                                              "unit and others none: name it for each."},
    Refusal{"x(px) y(px) z(px) r(px)\n0 0 0 1\n",
            ", line 1: the column x is in [px]: lengths may be in m, cm, mm, um."},
    Refusal{"# x(px) y(px) z(px) r(px)\n0 0 0 1\n",
            ", line 1: the column x is in [px]: lengths may be in m, cm, mm, um."},
    Refusal{"x[m] y[m] z[mm] r[m]\n0 0 0 1\n", ", line 1: x, y and z are not in one unit."},
    Refusal{"# lengths in mm\n# x [m] y [m] z [m] r [m]\n0 0 0 1\n",
            ", line 2: a column is in [m], and lengths of the file are said to be in mm. Keep one of the two."},
    Refusal{"# lengths in mm\n0 0 0 1\n# all lengths in metres\n",
            ", line 3: says that lengths are in m, and line 1 that they are in mm. Keep one of the two."},
    Refusal{"# exported from CAD (mm)\n0 0 0 1\n",
            ", line 1: this comment names the unit mm, and nothing says whether the lengths of the file are in it. Add "
            "\"# lengths in mm\", or \"# lengths in m\"."},
    Refusal{"# body 1 0 0 0 1 1 1 0 0 0\n# lengths in mm\nx y z r clump\n0 0 0 1 0\n",
            ": the lines \"# body\" are in m, and the places of particles in mm. Write both in m."},
    Refusal{"0 0 0 1\nx y z radius\n", ", line 2: \"x\" is not a number."},
    Refusal{"# periodic_cell 1 1\n0 0 0 1\n", ", line 1: periodic_cell has 2 edge lengths, expected 3: LX LY LZ [m]."},
    Refusal{"# periodic_cell 1 1 -1\n", ", line 1: periodic_cell edge = -1: must be above 0."},
    Refusal{"x y z r material\n0 0 0 1\n", ", line 2: found 4 columns, expected 5 as in the header."},
    Refusal{"x y z r material\n0 0 0 1 -1\n", ", line 2: material \"-1\": a material's name begins with a letter or "
                                              "digit, and goes on with these and any of . _ + -."},
    Refusal{"# materials a b\nx y z r material\n0 0 0 1 c\n",
            ", line 3: material \"c\" is not in the line \"# materials\"."},
    Refusal{"# materials a a\nx y z r material\n0 0 0 1 a\n", ", line 1: the material \"a\" is named twice."},
    Refusal{"x y z r material material\n0 0 0 1 a a\n", ", line 1: the header names the column material twice."},
    Refusal{"# periodic_cell 1 1 1\n# periodic_cell 1 1 2\n", ", line 2: periodic_cell is there a second time."},
    Refusal{std::string("0 0 0 1\n1 0 0\0 1\n", 17),
            ", line 2: holds a zero byte: this is no plain text. Save it as such (UTF-8, not UTF-16)."},
    Refusal{"0 0 \x1b[31m 1\n", ", line 1: \"?[31m\" is not a number."},
    Refusal{"0 0 " + std::string(1000, 'z') + " 1\n", ", line 1: \"" + std::string(60, 'z') + "...\" is not a number."},
    Refusal{
      "# periodic_cell 0.01 0.01 0.01\n0 0 0 1e-3\n5e-3 0 0 1e10\n",
      ": particle 2: its radius is more than 5 edges of the periodic cell: it would touch hundreds of its own images."},
    Refusal{"x y z radius clump\n0 0 0 1 -1\n4 0 0 1 0\n",
            ": particle 2: clump = 0: the packing says of no rigid body what it is. In a text each is a line \"# body "
            "VOLUME X Y Z IXX IYY IZZ IYZ IXZ IXY\" before the first particle, in HDF5 a row of \"bodies\". Add "
            "these, or leave the column clump out."},
    Refusal{"", ": holds no particle. Give lines of x y z radius [m]."},
    Refusal{"# only a comment\nx y z radius\n", ": holds no particle. Give lines of x y z radius [m]."});
  const ScratchFolder folder;
  const auto          path = folder.file("packing.txt", refusal.text);
  CAPTURE(refusal.text);
  REQUIRE_THROWS_AS(read_packing(path), base::InputError);
  REQUIRE_THROWS_WITH(read_packing(path), path.string() + refusal.message);
}

TEST_CASE("a packing that is missing, a folder or not HDF5 is refused", "[postprocess]")
{
  const ScratchFolder folder;
  REQUIRE_THROWS_WITH(read_packing(folder / "none.txt"), Contains("none.txt: no such file"));
  REQUIRE_THROWS_WITH(read_packing(folder / "none.h5"), Contains("none.h5: no such file"));
  REQUIRE_THROWS_WITH(read_packing(folder.path), Contains("is a folder"));
  REQUIRE_THROWS_WITH(read_packing(folder.file("text.h5", "0 0 0 1\n")), EndsWith("text.h5: is not an HDF5 file."));
}

TEST_CASE("two particles at one place are refused, from text and from HDF5", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          path = folder.file("twins.txt", "0 0 0 1\n5 5 5 1\n5 5 5 2\n");
  REQUIRE_THROWS_AS(read_packing(path), base::InputError);
  REQUIRE_THROWS_WITH(read_packing(path), Contains("twins.txt"));

  dem::Packing twins = two_particles();
  twins.centre[1]    = twins.centre[0];
  write_packing(twins, folder / "twins.h5");
  REQUIRE_THROWS_AS(read_packing(folder / "twins.h5"), base::InputError);
}

namespace
{
  void is_refused(const std::filesystem::path &path, const std::string &expected)
  {
    REQUIRE_THROWS_AS(read_packing(path), base::InputError);
    REQUIRE_THROWS_WITH(read_packing(path), EndsWith(expected));
  }
} // namespace

TEST_CASE("an HDF5 packing whose columns are missing or of another shape is refused naming the dataset",
          "[postprocess]")
{
  const ScratchFolder folder;
  const double        zeros[9] = {};
  const double        radii[3] = {1, 1, 1};
  std::string         expected;
  {
    hdf5::OutputFile file(folder / "p.h5");
    SECTION("no radius")
    {
      file.write("centre", zeros, {3, 3});
      expected = "p.h5: \"radius\" is missing.";
    }
    SECTION("centres in two columns")
    {
      file.write("centre", zeros, {3, 2});
      file.write("radius", radii, {3});
      expected = "\"centre\" has the shape 3 x 2, expected N x 3.";
    }
    SECTION("fewer radii than centres")
    {
      file.write("centre", zeros, {3, 3});
      file.write("radius", radii, {2});
      expected = "\"radius\" has the shape 2, expected 3, as many as centres.";
    }
    SECTION("radii that are whole numbers")
    {
      const std::int32_t whole[3] = {1, 1, 1};
      file.write("centre", zeros, {3, 3});
      file.write("radius", whole, {3});
      expected = "\"radius\" is of another type: real numbers expected.";
    }
    SECTION("a cell with two edges")
    {
      file.write("centre", zeros, {3, 3});
      file.write("radius", radii, {3});
      file.write("periodic_cell", radii, {2});
      expected = "\"periodic_cell\" has the shape 2, expected 3 edge lengths.";
    }
    file.commit();
  }
  is_refused(folder / "p.h5", expected);
}

TEST_CASE("an HDF5 packing whose materials do not fit its particles is refused naming particle or dataset",
          "[postprocess]")
{
  const ScratchFolder folder;
  const double        zeros[9] = {};
  const double        radii[3] = {1, 1, 1};
  std::string         expected;
  {
    hdf5::OutputFile file(folder / "p.h5");
    SECTION("fewer materials than particles")
    {
      const std::int32_t numbers[2] = {0, 1};
      file.write("centre", zeros, {3, 3});
      file.write("radius", radii, {3});
      file.write("material", numbers, {2});
      expected = "\"material\" has the shape 2, expected 3, as many as centres.";
    }
    SECTION("a material that is negative, or has no name, or is no whole number")
    {
      const double       places[9]   = {0, 0, 0, 5, 0, 0, 9, 0, 0};
      const std::int32_t negative[3] = {0, -1, 1}, beyond[3] = {0, 1, 2};
      file.write("centre", places, {3, 3});
      file.write("radius", radii, {3});
      const int which = GENERATE(0, 1, 2);
      if (which == 0)
        {
          file.write("material", negative, {3});
          expected = "particle 2: material = -1: must be a number from 0.";
        }
      else if (which == 1)
        {
          file.write("material", beyond, {3});
          file.write_text("material_names", "mortar sand");
          expected = "particle 3: material = 2: there are names for 0 to 1 only.";
        }
      else
        {
          file.write("material", radii, {3});
          expected = "\"material\" is of another type: whole numbers expected.";
        }
    }
    file.commit();
  }
  is_refused(folder / "p.h5", expected);
}

TEST_CASE("an HDF5 packing of nothing, or in a format of the future, is refused", "[postprocess]")
{
  const ScratchFolder folder;
  const double        zeros[9] = {};
  const double        radii[3] = {1, 1, 1};
  std::string         expected;
  {
    hdf5::OutputFile file(folder / "p.h5");
    SECTION("no particle")
    {
      file.write("centre", zeros, {0, 3});
      file.write("radius", radii, {0});
      expected = "no particle. A packing needs at least one.";
    }
    SECTION("a format of the future")
    {
      const std::int64_t version = 2;
      file.write("format_version", &version, {});
      expected = "packing format 2, this program reads format 1.";
    }
    file.commit();
  }
  is_refused(folder / "p.h5", expected);
}

TEST_CASE("an HDF5 packing that was cut short is refused", "[postprocess]")
{
  const ScratchFolder folder;
  write_packing(two_particles(), folder / "p.h5");
  std::filesystem::resize_file(folder / "p.h5", std::filesystem::file_size(folder / "p.h5") - 10);
  REQUIRE_THROWS_AS(read_packing(folder / "p.h5"), base::InputError);
  REQUIRE_THROWS_WITH(read_packing(folder / "p.h5"),
                      Contains("p.h5: cannot be opened, it is damaged or was cut short"));
}

TEST_CASE("a packing cannot be written into a folder that does not exist", "[postprocess]")
{
  const ScratchFolder folder;
  const auto         *name = GENERATE("no/such/p.h5", "no/such/p.txt");
  REQUIRE_THROWS_AS(write_packing(two_particles(), folder / name), OutputError);
  REQUIRE_THROWS_WITH(write_packing(two_particles(), folder / name), Contains("no/such does not exist"));
}
