// What stands where in a picture, by its pixels; what its labels say, by what gnuplot is told.
#include "postprocess/pictures/break_pictures.h"
#include "postprocess/pictures/packing_picture.h"
#include "scratch_folder.h"
#include "specimen_samples.h"
#include "tests/gnuplot_scripts.h"

#include <catch2/catch.hpp>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <filesystem>
#include <vector>

using Catch::Matchers::Contains;
using postprocess_tests::ScratchFolder;

namespace
{
  /** From the bottom upwards: whether a row of pixels has something dark, as letters are. */
  std::vector<bool> dark_rows(const std::filesystem::path &png)
  {
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(png.c_str());
    reader->Update();
    vtkImageData *image = reader->GetOutput();
    int           size[3];
    image->GetDimensions(size);
    REQUIRE(size[0] * size[1] > 0);
    const auto dark = [&](const int x, const int y) {
      const auto *pixel = static_cast<const unsigned char *>(image->GetScalarPointer(x, y, 0));
      return std::max({pixel[0], pixel[1], pixel[2]}) < 100;
    };
    std::vector<bool> rows;
    for (int y = 0; y < size[1]; ++y)
      {
        int x = 0;
        while (x < size[0] && !dark(x, y))
          ++x;
        rows.push_back(x < size[0]);
      }
    return rows;
  }

  /** Rows between the lowest line of text and the next one above it. */
  std::ptrdiff_t room_above_last_line(const std::vector<bool> &rows)
  {
    const auto line = std::find(rows.begin(), rows.end(), true), above = std::find(line, rows.end(), false);
    return std::find(above, rows.end(), true) - above;
  }
} // namespace

TEST_CASE("a legend stands clear of the axis label above it", "[postprocess]")
{
  const ScratchFolder folder;
  auto                particles = postprocess_tests::numbered_particles(2);
  particles.position[1]         = GENERATE(Eigen::Vector3d(0.2, 0.25, 4), Eigen::Vector3d(2, 0.25, 2));
  dem::Break broken;
  broken.ends  = {0, 1};
  broken.mode  = dem::BreakMode::tension;
  broken.place = {0.1, 0.25, 0.6};
  broken.area  = 0.3;
  REQUIRE(postprocess::picture_of_breaks(folder / "b.png", particles, {broken}, 0.5, "title") == "");
  CHECK(room_above_last_line(dark_rows(folder / "b.png")) >= 5);
}

TEST_CASE("a picture of a packing says where it is cut, and what its colours and axes are", "[postprocess]")
{
  const ScratchFolder  folder;
  const GnuplotScripts told(folder.path);
  dem::Packing         packing;
  packing.centre = {{0, 0, 0}, {0.01, 0, 0.004}};
  packing.radius = {0.003, 0.004};
  REQUIRE(postprocess::picture_of_packing(folder / "genesis.png", packing, "Grown packing").empty());
  CHECK_THAT(told.text(), Contains("set title 'Grown packing: cut at z = 2 mm'") &&
                            Contains("set cblabel 'Diameter [mm]'") && Contains("x [mm]") && Contains("y [mm]"));
}

TEST_CASE("a rose of cracks says what lies in which direction, and how they broke", "[postprocess]")
{
  const ScratchFolder     folder;
  const GnuplotScripts    told(folder.path);
  std::vector<dem::Break> breaks(2);
  breaks[0].mode = dem::BreakMode::tension;
  breaks[0].area = breaks[1].area = 1e-6;
  breaks[1].normal                = {0, 1, 0};
  REQUIRE(postprocess::picture_of_directions(folder / "directions.png", breaks, 2, "Directions of cracks").empty());
  CHECK_THAT(told.text(), Contains("set title 'Directions of cracks'") && Contains("title 'tension'") &&
                            Contains("title 'shear, or damaged until broken'") && Contains(" %' at ") &&
                            Contains("set label 'x' at ") && Contains("set label 'y' at "));
}
