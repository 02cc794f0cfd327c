#include "fem/mesh/removal.h"

#include "base/errors.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>

namespace fem
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using BoundaryFaces = std::conditional_t<dim == 2, std::vector<CellData<1>>, std::vector<CellData<2>>>;

    template <int dim>
    BoundaryFaces<dim> &faces_of(SubCellData &data)
    {
      if constexpr (dim == 2)
        return data.boundary_lines;
      else
        return data.boundary_quads;
    }

    template <int dim, typename Cell>
    CellData<dim> data_of(const Cell &cell)
    {
      CellData<dim> data(cell->n_vertices());
      for (const unsigned int v : cell->vertex_indices())
        data.vertices[v] = cell->vertex_index(v);
      data.material_id = cell->material_id();
      return data;
    }

    /// Faces of an element that bound what is left. @param fresh of those to elements that go
    template <int dim, typename Cell>
    void
    add_boundary(const Cell &cell, const std::vector<bool> &goes, const types::boundary_id fresh, SubCellData &data)
    {
      for (const unsigned int f : cell->face_indices())
        {
          const auto face = cell->face(f);
          if (!face->at_boundary() && !goes[cell->neighbor(f)->active_cell_index()])
            continue;
          CellData<dim - 1> one(face->n_vertices());
          for (const unsigned int v : face->vertex_indices())
            one.vertices[v] = face->vertex_index(v);
          one.boundary_id = face->at_boundary() ? face->boundary_id() : fresh;
          one.manifold_id = numbers::flat_manifold_id;
          faces_of<dim>(data).push_back(one);
        }
    }
  } // namespace

  template <int dim>
  Mesh<dim> without_elements(const Mesh<dim> &mesh, const std::function<bool(const Point<dim> &)> &is_taken)
  {
    const auto       &whole = *mesh.triangulation;
    std::vector<bool> goes(whole.n_active_cells(), true);
    for (const auto &cell : whole.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        if (!is_taken(cell->vertex(v)))
          goes[cell->active_cell_index()] = false;
    if (std::find(goes.begin(), goes.end(), false) == goes.end())
      throw base::InputError("mesh: no element is left outside of the particles' region. Make it smaller.");
    if (std::find(goes.begin(), goes.end(), true) == goes.end())
      throw base::InputError(
        "mesh: no element lies in the particles' region. Make it larger, or the elements smaller.");

    types::boundary_id fresh = 0;
    for (const auto &known : mesh.boundaries)
      fresh = std::max(fresh, static_cast<types::boundary_id>(known.second + 1));
    std::vector<CellData<dim>> cells;
    SubCellData                data;
    for (const auto &cell : whole.active_cell_iterators())
      if (!goes[cell->active_cell_index()])
        {
          cells.push_back(data_of<dim>(cell));
          add_boundary<dim>(cell, goes, fresh, data);
        }
    std::vector<Point<dim>> vertices = whole.get_vertices();
    GridTools::delete_unused_vertices(vertices, cells, data);
    Triangulation<dim> rest;
    rest.create_triangulation(vertices, cells, data);

    Mesh<dim> made               = distribute_mesh(rest, whole.get_communicator(), Bodies::several);
    made.boundaries              = mesh.boundaries;
    made.materials               = mesh.materials;
    made.boundaries["handshake"] = fresh;
    return made;
  }

  template Mesh<2> without_elements(const Mesh<2> &, const std::function<bool(const Point<2> &)> &);
  template Mesh<3> without_elements(const Mesh<3> &, const std::function<bool(const Point<3> &)> &);
} // namespace fem
