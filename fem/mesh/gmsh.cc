#include "fem/mesh/gmsh.h"

#include "base/errors.h"
#include "fem/mesh/gmsh_body.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <stdexcept>

namespace fem
{
  using namespace dealii;

  namespace
  {
    using GroupNames = std::map<int, std::string>; // number -> name

    /// Consecutive numbers for the names, from 1 on: those of Gmsh may be anything, and two groups may have one name.
    std::map<std::string, unsigned int> numbered(const GroupNames &names)
    {
      std::map<std::string, unsigned int> ids;
      for (const auto &entry : names)
        ids.emplace(entry.second, static_cast<unsigned int>(ids.size() + 1));
      return ids;
    }

    /// Nodes of an element in the order of deal.II: bit d of the place says on which side along axis d.
    std::vector<unsigned int> vertices_of(const GmshElement &cell)
    {
      std::vector<unsigned int> v(cell.nodes.begin(), cell.nodes.begin() + n_nodes_of(cell.shape));
      if (cell.shape == GmshShape::quadrilateral || cell.shape == GmshShape::hexahedron)
        std::swap(v[2], v[3]);
      if (cell.shape == GmshShape::hexahedron)
        std::swap(v[6], v[7]);
      return v;
    }

    template <int dim>
    void build(Triangulation<dim>                        &serial,
               const GmshBody                            &body,
               const GroupNames                          &names,
               const std::map<std::string, unsigned int> &ids)
    {
      std::vector<Point<dim>> points(body.points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          points[i][d] = body.points[i][d];
      std::vector<CellData<dim>> cells;
      for (const GmshElement &cell : body.cells)
        {
          CellData<dim> data;
          data.vertices    = vertices_of(cell);
          data.material_id = ids.at(names.at(cell.group));
          cells.push_back(data);
        }
      const GmshShape shape = body.cells.front().shape;
      if (shape == GmshShape::quadrilateral || shape == GmshShape::hexahedron)
        GridTools::consistently_order_cells(cells);
      serial.create_triangulation(points, cells, SubCellData());
    }

    template <int dim>
    void name_surface(Triangulation<dim>                        &serial,
                      const GmshBody                            &body,
                      const GroupNames                          &names,
                      const std::map<std::string, unsigned int> &ids)
    {
      for (const auto &cell : serial.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          {
            const auto face = cell->face(f);
            if (!face->at_boundary())
              continue;
            std::array<unsigned int, 4> nodes{};
            for (unsigned int v = 0; v < face->n_vertices(); ++v)
              nodes[v] = face->vertex_index(v);
            const auto group = body.groups.find(side_key(nodes, face->n_vertices()));
            face->set_boundary_id(group == body.groups.end() ? 0 : ids.at(names.at(group->second)));
          }
    }

    /// Names in place of the numbers by which a mesh knows its parts; 0 is what has no name.
    template <typename Id>
    void give_names(std::map<std::string, Id> &parts, const std::map<std::string, unsigned int> &ids)
    {
      std::map<std::string, Id> named;
      for (const auto &[name, id] : ids)
        if (parts.count(std::to_string(id)) > 0)
          named[name] = id;
      parts = named;
    }
  }

  template <int dim>
  Mesh<dim> read_gmsh(const std::string &file, const MPI_Comm communicator, const GmshReading &how)
  {
    GmshFile content = read_gmsh_file(file, dim);
    for (auto &point : content.points)
      for (double &coordinate : point)
        coordinate = how.unit.metres(coordinate);
    const auto inside = content.groups[dim], surface = content.groups[dim - 1];
    const auto materials = numbered(inside), boundaries = numbered(surface);
    try
      {
        const GmshBody     body = body_of(std::move(content), dim, how.doubled);
        Triangulation<dim> serial;
        build(serial, body, inside, materials);
        name_surface(serial, body, surface, boundaries);
        Mesh<dim> mesh = distribute_mesh(serial, communicator, how.bodies);
        give_names(mesh.boundaries, boundaries);
        give_names(mesh.materials, materials);
        return mesh;
      }
    catch (const base::InputError &problem)
      {
        throw base::InputError(file + ": " + problem.what());
      }
  }

  template Mesh<2> read_gmsh(const std::string &, MPI_Comm, const GmshReading &);
  template Mesh<3> read_gmsh(const std::string &, MPI_Comm, const GmshReading &);
}
