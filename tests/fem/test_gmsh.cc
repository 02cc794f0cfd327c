#include "fem/mesh/gmsh.h"

#include <catch2/catch.hpp>
#include <deal.II/grid/tria.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace
{
  /// A file in the temporary folder that goes with the object.
  class TemporaryFile
  {
  public:
    explicit TemporaryFile(const std::string &text)
      // Tests run side by side, each in a process of its own.
      : path(std::filesystem::temp_directory_path() / ("breccia_test_gmsh_" + std::to_string(getpid()) + ".msh"))
    {
      std::ofstream(path) << text;
    }
    ~TemporaryFile() { std::filesystem::remove(path); }

    std::filesystem::path path;
  };

  /// Two squares side by side, of materials "stone" and "mortar", held at "left", loaded at "right".
  std::string two_squares(const std::string &names, const std::string &last_square = "4 3 2 12 2 2 3 6 5")
  {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names +
           "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n$EndNodes\n"
           "$Elements\n4\n1 1 2 1 1 1 4\n2 1 2 2 2 3 6\n3 3 2 11 1 1 2 5 4\n" +
           last_square + "\n$EndElements\n";
  }

  const std::string names =
    "$PhysicalNames\n4\n1 1 \"left\"\n1 2 \"right\"\n2 11 \"stone\"\n2 12 \"mortar\"\n$EndPhysicalNames\n";

  std::string refusal(const std::string &text)
  {
    const TemporaryFile file(text);
    try
      {
        fem::read_gmsh<2>(file.path.string(), MPI_COMM_SELF);
      }
    catch (const std::invalid_argument &problem)
      {
        return problem.what();
      }
    return "accepted";
  }
}

TEST_CASE("Gmsh: physical groups become names of boundaries and materials", "[fem]")
{
  const TemporaryFile file(two_squares(names));
  const auto          mesh = fem::read_gmsh<2>(file.path.string(), MPI_COMM_SELF);
  CHECK(mesh.triangulation->n_global_active_cells() == 2);
  CHECK(mesh.family == fem::ElementFamily::hypercube);
  REQUIRE(mesh.materials.size() == 2);
  REQUIRE(mesh.boundaries.size() == 2);
  for (const auto &cell : mesh.triangulation->active_cell_iterators())
    CHECK(cell->material_id() == mesh.materials.at(cell->center()[0] < 1 ? "stone" : "mortar"));
  for (const auto &face : mesh.triangulation->active_face_iterators())
    if (face->at_boundary())
      {
        CHECK((face->boundary_id() == mesh.boundary("left")) == (face->center()[0] == 0));
        CHECK((face->boundary_id() == mesh.boundary("right")) == (face->center()[0] == 2));
      }
  CHECK_THROWS_WITH(mesh.boundary("top"), Catch::Contains("boundary = top") && Catch::Contains("left, right"));
}

TEST_CASE("Gmsh: triangles are read as simplices", "[fem]")
{
  const TemporaryFile file("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 7 \"all\"\n$EndPhysicalNames\n"
                           "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
                           "$Elements\n2\n1 2 2 7 1 1 2 3\n2 2 2 7 1 1 3 4\n$EndElements\n");
  const auto          mesh = fem::read_gmsh<2>(file.path.string(), MPI_COMM_SELF);
  CHECK(mesh.family == fem::ElementFamily::simplex);
  CHECK(mesh.triangulation->n_global_active_cells() == 2);
  CHECK(mesh.materials.count("all") == 1);
}

TEST_CASE("Gmsh: bad files are refused with the file and the reason", "[fem]")
{
  CHECK_THAT(refusal("nonsense"), Catch::Contains("breccia_test_gmsh_") && Catch::Contains("is not a Gmsh file"));
  CHECK_THAT(refusal(two_squares("")), Catch::Contains("no named group"));
  CHECK_THROWS_WITH(fem::read_gmsh<2>("no_such_file.msh", MPI_COMM_SELF),
                    Catch::Contains("no_such_file.msh: cannot be read"));
  CHECK_THAT(refusal(two_squares(names)), Catch::Contains("accepted"));
}
