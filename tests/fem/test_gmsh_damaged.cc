// Meshes that somebody or something has damaged: each is refused in one clear message, or is a sound body still.
#include "fem/mesh/gmsh.h"
#include "tests/fem/gmsh_samples.h"

#include <catch2/catch.hpp>
#include <deal.II/grid/tria.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace
{
  using gmsh_samples::Elements;

  struct Sample
  {
    Elements elements;
    bool     format_4;

    int dimension() const { return elements == Elements::tetrahedra || elements == Elements::hexahedra ? 3 : 2; }
    std::string text() const { return gmsh_samples::box(elements, format_4); }
  };

  std::vector<Sample> samples()
  {
    std::vector<Sample> all;
    for (const Elements e : {Elements::triangles, Elements::quadrilaterals, Elements::tetrahedra, Elements::hexahedra})
      for (const bool format_4 : {false, true})
        all.push_back({e, format_4});
    return all;
  }

  // Not that of GridTools, which is of hypercubes only.
  template <int dim>
  double volume_of(const fem::Mesh<dim> &mesh)
  {
    double sum = 0;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      sum += cell->measure();
    return sum;
  }

  /// What comes of a file: a message, or nothing where it is a body of finite, positive volume.
  template <int dim>
  std::string message_of(const std::string &file)
  {
    try
      {
        const auto   mesh   = fem::read_gmsh<dim>(file, MPI_COMM_SELF);
        const double volume = volume_of(mesh);
        CHECK(std::isfinite(volume));
        CHECK(volume > 0);
        CHECK_FALSE(mesh.materials.empty());
        return "";
      }
    catch (const std::invalid_argument &problem)
      {
        return problem.what();
      }
  }

  std::string message_of(const std::string &text, const int dimension)
  {
    const auto file = std::filesystem::temp_directory_path() / ("breccia_damaged_" + std::to_string(getpid()) + ".msh");
    std::ofstream(file, std::ios::binary) << text;
    const std::string message = dimension == 3 ? message_of<3>(file.string()) : message_of<2>(file.string());
    std::filesystem::remove(file);
    return message;
  }

  std::string replaced(std::string text, const std::string &from, const std::string &to)
  {
    const auto place = text.find(from);
    REQUIRE(place != std::string::npos);
    return text.replace(place, from.size(), to);
  }

  std::vector<std::string> lines_of(const std::string &text)
  {
    std::vector<std::string> lines;
    std::istringstream       stream(text);
    for (std::string line; std::getline(stream, line);)
      lines.push_back(line);
    return lines;
  }

  std::string joined(const std::vector<std::string> &parts, const char *between)
  {
    std::string text;
    for (const std::string &part : parts)
      text += part + between;
    return text;
  }

  std::vector<std::string> words_of(const std::string &line)
  {
    std::vector<std::string> words;
    std::istringstream       stream(line);
    for (std::string word; stream >> word;)
      words.push_back(word);
    return words;
  }

  /// One accident: a line or a word lost, repeated, exchanged or overwritten, a byte flipped, the end cut off.
  std::string damaged(const std::string &text, std::mt19937 &random)
  {
    const auto any = [&](const std::size_t below) { return static_cast<std::size_t>(random()) % below; };
    static const std::vector<std::string> intruders = {
      "0",    "-1",         "1",     "3", "1e30", "nan", "-inf", "99999999",
      "1e-9", "2147483648", "$Ende", "x", "0.5",  "17",  "",     "18446744073709551616"};
    std::vector<std::string> lines = lines_of(text);
    std::string             &line  = lines[any(lines.size())];
    std::vector<std::string> words = words_of(line);
    std::string              bytes = text;
    switch (any(8))
      {
      case 0:
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(any(lines.size())));
        break;
      case 1:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(any(lines.size())), lines[any(lines.size())]);
        break;
      case 2:
        std::swap(line, lines[any(lines.size())]);
        break;
      case 3:
        if (!words.empty())
          words.erase(words.begin() + static_cast<std::ptrdiff_t>(any(words.size())));
        line = joined(words, " ");
        break;
      case 4:
      case 5:
        if (!words.empty())
          words[any(words.size())] = intruders[any(intruders.size())];
        line = joined(words, " ");
        break;
      case 6:
        bytes[any(bytes.size())] = static_cast<char>(any(256));
        return bytes;
      default:
        return bytes.substr(0, any(bytes.size()));
      }
    return joined(lines, "\n");
  }
}

TEST_CASE("Gmsh: both formats and all shapes of elements give the same body with the same names", "[fem][S14]")
{
  for (const Sample &sample : samples())
    {
      INFO(sample.text());
      CHECK(message_of(sample.text(), sample.dimension()) == "");
      CHECK(message_of("\xEF\xBB\xBF" + sample.text(), sample.dimension()) == ""); // a byte order mark
    }
  const auto file = std::filesystem::temp_directory_path() / ("breccia_box_" + std::to_string(getpid()) + ".msh");
  for (const Elements elements : {Elements::tetrahedra, Elements::hexahedra})
    for (const bool format_4 : {false, true})
      {
        std::ofstream(file) << gmsh_samples::box(elements, format_4);
        const auto mesh = fem::read_gmsh<3>(file.string(), MPI_COMM_SELF);
        CHECK(volume_of(mesh) == Approx(1));
        double left = 0, right = 0;
        for (const auto &cell : mesh.triangulation->active_cell_iterators())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary())
              {
                const auto id = cell->face(f)->boundary_id();
                left += id == mesh.boundary("left") ? cell->face(f)->measure() : 0;
                right += id == mesh.boundary("right") ? cell->face(f)->measure() : 0;
              }
        CHECK(left == Approx(1));
        CHECK(right == Approx(1));
      }
  std::filesystem::remove(file);
}

TEST_CASE("Gmsh: a fault of a mesh is reported by line, element and node", "[fem][S14]")
{
  const std::string quads  = gmsh_samples::box(Elements::quadrilaterals, false);
  const std::string bricks = gmsh_samples::box(Elements::hexahedra, true);
  const auto        says   = [](const std::string &text, const int dimension, const std::string &message) {
    const std::string said = message_of(text, dimension);
    CHECK_THAT(said, Catch::Contains("breccia_damaged_") && Catch::Contains(message));
    CHECK(said.find('\n') == std::string::npos);
  };
  says(replaced(quads, "5 0.5 0.5 0\n", ""), 2, ", line 20: expected the number of a node, a whole number");
  says(replaced(quads, "\n5 0.5 0.5 0\n", "\n50 0.5 0.5 0\n"), 2,
       "the element 5 has the node 5, which the section $Nodes does not give.");
  says(replaced(quads, "\n5 0.5 0.5 0\n", "\n4 0.5 0.5 0\n"), 2, ", line 16: the node 4 is given a second time.");
  says(replaced(quads, "\n5 0.5 0.5 0\n", "\n5 0.5 nan 0\n"), 2, "expected a coordinate, a number, found \"nan\"");
  says(replaced(quads, "\n5 0.5 0.5 0\n", "\n5 0.5 0.5 0.1\n"), 2,
       "a plane model lies in a plane of equal z, but node 5");
  says(replaced(quads, "\n5 0.5 0.5 0\n", "\n5 2.5 0.5 0\n"), 2, "mesh: element 6 at 1.25 0.25 is inverted or flat");
  says(replaced(quads, "5 3 2 7 1 1 2 5 4", "5 16 2 7 1 1 2 5 4 1 2 3 4"), 2,
       "of second or higher order; first order is read. In Gmsh: Mesh.ElementOrder = 1");
  says(replaced(quads, "5 3 2 7 1 1 2 5 4", "5 3 2 7 1 1 2 5 5"), 2, "element 5 has the node 5 twice.");
  says(replaced(quads, "6 3 2 7 1 2 3 6 5", "6 3 2 7 1 1 2 5 4"), 2,
       "mesh: elements 5 and 6 at 0.25 0.25 lie over each other");
  says(replaced(quads, "1 1 2 1 1 1 4", "1 1 2 1 1 2 5"), 2,
       "mesh: element 1 of the physical group \"left\" at 0.5 0.25 is not on the surface of the body");
  says(replaced(quads, "2 1 2 1 1 4 7", "2 1 2 2 1 1 4"), 2, "belongs to another group too, \"left\"");
  says(replaced(quads, "1 1 \"left\"\n", "1 3 \"left\"\n"), 2, "physical group 1 of its boundary has no name");
  says(quads, 3, "has no element of dimension 3, which is the model's");
  says(bricks, 2, "an element of dimension 3 in a model of dimension 2");
  says(replaced(bricks, "4.1 0 8", "4.1 1 8"), 3, "the file is binary; text is read. In Gmsh: Mesh.Binary = 0.");
  says(replaced(bricks, "4.1 0 8", "4 0 8"), 3, "formats 2.2 and 4.1 are read");
  says(replaced(bricks, "1 0 0 0 0 1 1 1 1 0", "1 0 0 0 0 1 1 2 1 2 0"), 3, "belong to 2 physical groups");
  says(replaced(bricks, "$EndElements\n", ""), 3, "where $EndElements is expected: it is cut off.");
  says(replaced(bricks, "\n0.5 0.5 0.5\n", "\n0.5 0.5 0\n"), 3, "inverted or flat");
}

TEST_CASE("Gmsh: nodes at one place are refused, for the body would be cracked there unnoticed", "[fem][S14]")
{
  // The right half hangs on nodes of its own along x = 0.5, but for the one in the middle.
  std::string text = gmsh_samples::box(Elements::quadrilaterals, false);
  text             = replaced(text, "$Nodes\n9\n", "$Nodes\n10\n10 0.5 0 0\n");
  text             = replaced(text, "6 3 2 7 1 2 3 6 5", "6 3 2 7 1 10 3 6 5");
  CHECK_THAT(message_of(text, 2), Catch::Contains("mesh: the nodes 10 (0.5 0) and 2 (0.5 0) are at one place") &&
                                    Catch::Contains("for a notch without width set Mesh/Doubled nodes = notch"));

  // Asked for, they are a notch up to the middle: two faces more of half a unit each, and nothing lost.
  const auto file = std::filesystem::temp_directory_path() / ("breccia_notch_" + std::to_string(getpid()) + ".msh");
  std::ofstream(file, std::ios::binary) << text;
  fem::GmshReading how;
  how.doubled             = fem::DoubledNodes::notch;
  const fem::Mesh<2> mesh = fem::read_gmsh<2>(file.string(), MPI_COMM_SELF, how);
  std::filesystem::remove(file);
  CHECK(volume_of(mesh) == Approx(1).epsilon(1e-14));
  double length = 0;
  for (const auto &face : mesh.triangulation->active_face_iterators())
    length += face->at_boundary() ? face->measure() : 0;
  CHECK(length == Approx(4 + 2 * 0.5).epsilon(1e-14));
}

TEST_CASE("Gmsh: rounding of z in a plane mesh is no step out of its plane", "[fem]")
{
  const std::string text = gmsh_samples::box(Elements::quadrilaterals, false);
  CHECK(message_of(replaced(text, "\n2 0.5 0 0\n", "\n2 0.5 0 1e-17\n"), 2).empty());
  CHECK_THAT(message_of(replaced(text, "\n2 0.5 0 0\n", "\n2 0.5 0 1e-6\n"), 2),
             Catch::Contains("a plane model lies in a plane of equal z, but node 2 has z = 1e-06"));
}

TEST_CASE("Gmsh: names of groups of another dimension are reported as such", "[fem][S14]")
{
  const std::string text = gmsh_samples::box(Elements::quadrilaterals, false);
  CHECK_THAT(message_of(replaced(text, "2 7 \"body\"", "1 7 \"body\""), 2),
             Catch::Contains("some elements have no named group") &&
               Catch::Contains("The named groups are of other dimensions: ") &&
               Catch::Contains("\"body\" of dimension 1"));
}

TEST_CASE("Gmsh: lengths of a file are in the given unit", "[fem]")
{
  const auto file = std::filesystem::temp_directory_path() / ("breccia_unit_" + std::to_string(getpid()) + ".msh");
  std::ofstream(file, std::ios::binary) << gmsh_samples::box(Elements::hexahedra, true);
  fem::GmshReading how;
  how.unit        = *base::length_unit("mm");
  const auto mesh = fem::read_gmsh<3>(file.string(), MPI_COMM_SELF, how);
  std::filesystem::remove(file);
  CHECK(volume_of(mesh) == Approx(1e-9).epsilon(1e-14));
}

TEST_CASE("Gmsh: 800 damaged meshes of all formats and shapes are refused in one line each, or are sound", "[fem][S14]")
{
  std::mt19937 random(2006);
  int          refused = 0, sound = 0;
  for (const Sample &sample : samples())
    {
      const std::string whole = sample.text();
      for (int i = 0; i < 100; ++i)
        {
          const std::string text    = damaged(whole, random);
          const std::string message = message_of(text, sample.dimension());
          ++(message.empty() ? sound : refused);
          INFO(text);
          INFO(message);
          CHECK((message.empty() || message.find("breccia_damaged_") != std::string::npos));
          CHECK(message.find('\n') == std::string::npos);
          CHECK(message.size() < 500);
        }
    }
  CHECK(refused > 300);
  CHECK(sound > 20);
}
