#include "apps/runs/particles/wall_files.h"

#include "apps/results/warning.h"
#include "base/errors.h"
#include "dem/facets/slivers.h"
#include "fem/mesh/gmsh_file.h"
#include "postprocess/files/numeric_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace apps
{
  namespace
  {
    void add_triangle(dem::FacetMesh &mesh, const std::array<Eigen::Vector3d, 3> &corner)
    {
      const auto n = static_cast<std::int32_t>(mesh.vertex.size());
      mesh.vertex.insert(mesh.vertex.end(), corner.begin(), corner.end());
      mesh.facet.push_back({n, n + 1, n + 2});
    }

    /** A header of 80 bytes, the number of triangles, and for each normal, corners (floats) and two bytes. */
    constexpr std::size_t header = 80, record = 50;

    std::uint32_t number_at(const std::string &bytes, const std::size_t at)
    {
      std::uint32_t value = 0;
      for (std::size_t b = 4; b-- > 0;)
        value = value << 8 | static_cast<unsigned char>(bytes[at + b]);
      return value;
    }

    bool is_binary(const std::string &bytes)
    {
      return bytes.size() >= header + 4 && bytes.size() == header + 4 + record * std::size_t(number_at(bytes, header));
    }

    dem::FacetMesh binary_triangles(const std::string &bytes)
    {
      dem::FacetMesh mesh;
      for (std::size_t at = header + 4; at < bytes.size(); at += record)
        {
          std::array<Eigen::Vector3d, 3> corner;
          for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t d = 0; d < 3; ++d)
              {
                const std::uint32_t bits = number_at(bytes, at + 12 + 12 * c + 4 * d);
                float               value;
                std::memcpy(&value, &bits, sizeof value);
                corner[c][static_cast<Eigen::Index>(d)] = static_cast<double>(value);
              }
          add_triangle(mesh, corner);
        }
      return mesh;
    }

    dem::FacetMesh text_triangles(const std::string &file, const std::string &text)
    {
      using namespace postprocess::numeric_text;
      dem::FacetMesh                 mesh;
      std::array<Eigen::Vector3d, 3> corner;
      std::size_t                    corners = 0;
      bool                           begun   = false;
      for (Lines lines(text); lines.next();)
        {
          const std::string  line(lines.text());
          const std::size_t  number = lines.number();
          std::istringstream words(line);
          std::string        word;
          if (!(words >> word))
            continue;
          std::transform(word.begin(), word.end(), word.begin(), [](const unsigned char c) { return std::tolower(c); });
          if (!begun && word != "solid")
            throw base::InputError(file + ": is no STL file: it neither begins with \"solid\" nor has the length of a "
                                          "binary one.");
          begun = true;
          if (word == "vertex")
            {
              double x, y, z;
              if (!(words >> x >> y >> z) || corners == 3)
                throw base::InputError(
                  fmt::format("{}:{}: \"{}\": expected \"vertex X Y Z\", three for each facet.", file, number, line));
              corner[corners++] = {x, y, z};
            }
          else if (word == "endloop")
            {
              if (corners != 3)
                throw base::InputError(
                  fmt::format("{}:{}: a facet of {} corners; STL has three.", file, number, corners));
              add_triangle(mesh, corner);
              corners = 0;
            }
        }
      if (corners != 0)
        throw base::InputError(file + ": ends within a facet.");
      return mesh;
    }

    dem::FacetMesh stl_triangles(const std::string &file)
    {
      std::ifstream     stream(file, std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
      return is_binary(bytes) ? binary_triangles(bytes) : text_triangles(file, bytes);
    }

    dem::FacetMesh gmsh_triangles(const std::string &file)
    {
      dem::FacetMesh      mesh;
      const fem::GmshFile read = fem::read_gmsh_file(file, 3);
      for (const auto &point : read.points)
        mesh.vertex.push_back({point[0], point[1], point[2]});
      for (const fem::GmshElement &element : read.elements)
        {
          const auto node = [&](const std::size_t n) { return static_cast<std::int32_t>(element.nodes[n]); };
          if (element.shape == fem::GmshShape::triangle || element.shape == fem::GmshShape::quadrilateral)
            mesh.facet.push_back({node(0), node(1), node(2)});
          if (element.shape == fem::GmshShape::quadrilateral)
            mesh.facet.push_back({node(0), node(2), node(3)});
        }
      return mesh;
    }

    constexpr double largest_in_metres = 30; // as of lengths in scenes (usual_sizes.cc)

    double extent_of(const dem::FacetMesh &mesh)
    {
      Eigen::Vector3d low = mesh.vertex.front(), high = low;
      for (const Eigen::Vector3d &x : mesh.vertex)
        {
          low  = low.cwiseMin(x);
          high = high.cwiseMax(x);
        }
      return (high - low).maxCoeff();
    }
  } // namespace

  dem::FacetMesh read_wall(const std::string &file, const double scale)
  {
    dem::FacetMesh mesh =
      std::filesystem::path(file).extension() == ".msh" ? gmsh_triangles(file) : stl_triangles(file);
    if (mesh.facet.empty())
      throw base::InputError(file + ": there is no triangle in it.");
    if (const std::size_t dropped = dem::drop_slivers(mesh); dropped > 0)
      give_note(
        fmt::format("{}: {} of {} facets have no area and are left out.", file, dropped, dropped + mesh.facet.size()));
    if (mesh.facet.empty())
      throw base::InputError(file + ": none of its triangles has an area.");
    if (scale > 0)
      for (Eigen::Vector3d &x : mesh.vertex)
        x *= scale;
    else if (const double size = extent_of(mesh); size > largest_in_metres)
      throw base::InputError(
        fmt::format("{}: reaches over {:g} m. In mm? Set Scale = 1e-3 beside File. If it is meant, "
                    "set Scale = 1.",
                    file, size));
    return mesh;
  }
} // namespace apps
