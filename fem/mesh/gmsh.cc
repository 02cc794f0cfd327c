#include "fem/mesh/gmsh.h"

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace fem
{
  using namespace dealii;

  namespace
  {
    using GroupNames = std::map<unsigned int, std::string>; // tag -> name

    /// Names in the section $PhysicalNames, by dimension.
    std::map<int, GroupNames> physical_names(const std::string &file)
    {
      std::ifstream in(file);
      if (!in)
        throw std::invalid_argument(file + ": cannot be read. Give the path of a Gmsh file (.msh).");
      std::map<int, GroupNames> names;
      std::string               line;
      if (!std::getline(in, line) || line.compare(0, 11, "$MeshFormat") != 0)
        throw std::invalid_argument(file + ": is not a Gmsh file (it does not start with $MeshFormat).");
      while (std::getline(in, line))
        if (line.compare(0, 14, "$PhysicalNames") == 0)
          {
            std::getline(in, line);
            const int count = std::stoi(line);
            for (int i = 0; i < count && std::getline(in, line); ++i)
              {
                std::istringstream words(line);
                int                dimension;
                unsigned int       tag;
                words >> dimension >> tag;
                const auto open = line.find('"'), close = line.rfind('"');
                if (!words || open == std::string::npos || close == open)
                  throw std::invalid_argument(file + ": cannot read the physical name in the line \"" + line + "\".");
                names[dimension][tag] = line.substr(open + 1, close - open - 1);
              }
            break;
          }
      return names;
    }

    template <typename Id>
    void give_names(std::map<std::string, Id> &groups,
                    const GroupNames          &names,
                    const Id                   without,
                    const std::string         &what,
                    const std::string         &file)
    {
      std::map<std::string, Id> named;
      for (const auto &[number, id] : groups)
        {
          const auto name = names.find(id);
          if (name != names.end())
            named[name->second] = id;
          else if (id == without)
            continue;
          else
            throw std::invalid_argument(file + ": physical group " + number + " of its " + what +
                                        " has no name. Name it in Gmsh: Physical ...(\"name\", " + number + ").");
        }
      groups = named;
    }
  }

  template <int dim>
  Mesh<dim> read_gmsh(const std::string &file, const MPI_Comm communicator)
  {
    auto               names = physical_names(file);
    Triangulation<dim> serial;
    try
      {
        GridIn<dim> reader(serial);
        reader.read_msh(file);
      }
    catch (const ExceptionBase &problem)
      {
        std::ostringstream text;
        problem.print_info(text);
        throw std::invalid_argument(file + ": is not a mesh of dimension " + std::to_string(dim) +
                                    " that can be read (Gmsh 2.2 or 4.1, text, first order): " + text.str());
      }
    Mesh<dim> mesh;
    try
      {
        mesh = distribute_mesh(serial, communicator);
      }
    catch (const std::invalid_argument &problem)
      {
        throw std::invalid_argument(file + ": " + problem.what());
      }
    for (const auto &entry : mesh.materials)
      if (names[dim].count(entry.second) == 0)
        throw std::invalid_argument(
          file +
          ": some elements have no named group. Give every element a named physical group: it selects the material.");
    // Faces without a group have number 0, which Gmsh gives to no group: they are free boundaries without a name.
    give_names<types::boundary_id>(mesh.boundaries, names[dim - 1], 0, "boundary", file);
    give_names<types::material_id>(mesh.materials, names[dim], numbers::invalid_material_id, "elements", file);
    return mesh;
  }

  template Mesh<2> read_gmsh(const std::string &, MPI_Comm);
  template Mesh<3> read_gmsh(const std::string &, MPI_Comm);
}
