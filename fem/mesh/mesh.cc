#include "fem/mesh/mesh.h"

#include "base/errors.h"
#include "fem/mesh/check.h"

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/shared_tria.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <stdexcept>

namespace fem
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    void name_by_number(Mesh<dim> &mesh, const Triangulation<dim> &whole)
    {
      for (const types::boundary_id id : whole.get_boundary_ids())
        mesh.boundaries[std::to_string(id)] = id;
      for (const auto &cell : whole.active_cell_iterators())
        mesh.materials[std::to_string(cell->material_id())] = cell->material_id();
    }

    /// An empty mesh that will keep its coarser levels: geometric multigrid works on them.
    template <int dim>
    std::unique_ptr<parallel::distributed::Triangulation<dim>> make_hypercubes(const MPI_Comm communicator)
    {
      return std::make_unique<parallel::distributed::Triangulation<dim>>(
        communicator, Triangulation<dim>::limit_level_difference_at_vertices,
        parallel::distributed::Triangulation<dim>::construct_multigrid_hierarchy);
    }

    /// Every rank holds the whole mesh (deal.II's fully distributed one answers wrongly for simplices), but works on its own part.
    template <int dim>
    std::unique_ptr<parallel::TriangulationBase<dim>> spread_simplices(Triangulation<dim> &serial,
                                                                       const MPI_Comm      communicator)
    {
      auto mesh = std::make_unique<parallel::shared::Triangulation<dim>>(
        communicator, Triangulation<dim>::none, true, parallel::shared::Triangulation<dim>::partition_metis);
      mesh->copy_triangulation(serial);
      return mesh;
    }
  }

  template <int dim>
  types::boundary_id Mesh<dim>::boundary(const std::string &name) const
  {
    const auto found = boundaries.find(name);
    if (found != boundaries.end())
      return found->second;
    std::string known;
    for (const auto &entry : boundaries)
      known += (known.empty() ? "" : ", ") + entry.first;
    throw base::InputError("boundary = " + name + ": the mesh has no such boundary. It has: " + known + ".");
  }

  template <int dim>
  Mesh<dim>
  make_mesh(const BuildMesh<dim> &build, const ElementFamily family, const MPI_Comm communicator, const Bodies bodies)
  {
    if (family == ElementFamily::simplex)
      {
        Triangulation<dim> bricks, simplices;
        build(bricks);
        Triangulation<dim> flat;
        GridGenerator::flatten_triangulation(bricks, flat);
        GridGenerator::convert_hypercube_to_simplex_mesh(flat, simplices);
        return distribute_mesh(simplices, communicator, bodies);
      }
    Mesh<dim> mesh;
    mesh.family = family;
    auto spread = make_hypercubes<dim>(communicator);
    build(*spread);
    refuse_bad_mesh(*spread, bodies);
    name_by_number(mesh, *spread);
    mesh.triangulation = std::move(spread);
    return mesh;
  }

  template <int dim>
  Mesh<dim> distribute_mesh(Triangulation<dim> &serial, const MPI_Comm communicator, const Bodies bodies)
  {
    refuse_bad_mesh(serial, bodies);
    Mesh<dim> mesh;
    name_by_number(mesh, serial);
    if (serial.all_reference_cells_are_hyper_cube())
      {
        auto spread = make_hypercubes<dim>(communicator);
        spread->copy_triangulation(serial);
        mesh.triangulation = std::move(spread);
        return mesh;
      }
    if (!serial.all_reference_cells_are_simplex())
      throw base::InputError(
        "mesh: it mixes element shapes. Use triangles and tetrahedra only, or quadrilaterals and hexahedra only.");
    mesh.family        = ElementFamily::simplex;
    mesh.triangulation = spread_simplices(serial, communicator);
    return mesh;
  }

  template struct Mesh<2>;
  template struct Mesh<3>;
  template Mesh<2> make_mesh(const BuildMesh<2> &, ElementFamily, MPI_Comm, Bodies);
  template Mesh<3> make_mesh(const BuildMesh<3> &, ElementFamily, MPI_Comm, Bodies);
  template Mesh<2> distribute_mesh(Triangulation<2> &, MPI_Comm, Bodies);
  template Mesh<3> distribute_mesh(Triangulation<3> &, MPI_Comm, Bodies);
}
