#include "fem/mesh/check.h"

#include "base/errors.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace fem
{
  using namespace dealii;

  namespace
  {
    /// Smallest Jacobian determinant at the corners, over the cube of the diameter: the shape's worst corner.
    template <int dim>
    double worst_corner(const typename Triangulation<dim>::cell_iterator &cell)
    {
      if (cell->reference_cell().is_simplex())
        {
          Tensor<2, dim> edges;
          for (unsigned int d = 0; d < dim; ++d)
            edges[d] = cell->vertex(d + 1) - cell->vertex(0);
          return determinant(edges);
        }
      double worst = 1e300;
      for (unsigned int v = 0; v < GeometryInfo<dim>::vertices_per_cell; ++v)
        {
          Tensor<2, dim> edges;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const unsigned int bit = 1u << d;
              edges[d]               = (v & bit ? -1.0 : 1.0) * (cell->vertex(v ^ bit) - cell->vertex(v));
            }
          worst = std::min(worst, determinant(edges));
        }
      return worst;
    }

    template <int dim>
    void refuse_inverted(const Triangulation<dim> &mesh)
    {
      for (const auto &cell : mesh.active_cell_iterators())
        if (!(worst_corner<dim>(cell) > 0))
          {
            std::ostringstream text;
            text << "mesh: element " << cell->id() << " at " << cell->center()
                 << " is inverted or flat (its Jacobian is not positive at every corner). Repair the mesh there.";
            throw base::InputError(text.str());
          }
    }

    /// Union-find over coarse cells that share a vertex.
    template <int dim>
    void refuse_unconnected(const Triangulation<dim> &mesh)
    {
      std::vector<unsigned int> parent(mesh.n_vertices());
      std::iota(parent.begin(), parent.end(), 0u);
      const auto root = [&](unsigned int v) {
        while (parent[v] != v)
          v = parent[v] = parent[parent[v]];
        return v;
      };
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        for (unsigned int v = 1; v < cell->n_vertices(); ++v)
          parent[root(cell->vertex_index(v))] = root(cell->vertex_index(0));

      std::map<unsigned int, unsigned int> cells_of;
      std::map<unsigned int, Point<dim>>   place_of;
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        {
          const unsigned int part = root(cell->vertex_index(0));
          ++cells_of[part];
          place_of[part] = cell->center();
        }
      if (cells_of.size() <= 1)
        return;
      auto smallest = cells_of.begin();
      for (auto part = cells_of.begin(); part != cells_of.end(); ++part)
        if (part->second < smallest->second)
          smallest = part;
      std::ostringstream text;
      text << "mesh: it falls into " << cells_of.size() << " unconnected parts; the smallest has " << smallest->second
           << " elements, one of them at " << place_of[smallest->first]
           << ". Join the parts (merge coincident nodes) or remove one; bodies that lie apart on purpose want "
              "Mesh/Several bodies = true.";
      throw base::InputError(text.str());
    }
  }

  template <int dim>
  void refuse_bad_mesh(const Triangulation<dim> &mesh, const Bodies bodies)
  {
    refuse_inverted(mesh);
    if (bodies == Bodies::one)
      refuse_unconnected(mesh);
  }

  template void refuse_bad_mesh(const Triangulation<2> &, Bodies);
  template void refuse_bad_mesh(const Triangulation<3> &, Bodies);
}
