// Loads of a solid: surface, body and point forces.
#include "fem/solid/solid.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>

#include <sstream>

namespace fem
{
  using namespace dealii;

  namespace
  {
    /// How far a unit point lies outside the reference element, 0 inside.
    template <int dim>
    double distance_outside(const Point<dim> &p, const ElementFamily family)
    {
      double outside = 0, sum = 0;
      for (int d = 0; d < dim; ++d)
        {
          sum += p[d];
          outside = std::max(outside, -p[d]);
          if (family == ElementFamily::hypercube)
            outside = std::max(outside, p[d] - 1);
        }
      return family == ElementFamily::simplex ? std::max(outside, sum - 1) : outside;
    }
  }

  template <int dim>
  std::vector<std::pair<types::global_dof_index, double>> Solid<dim>::interpolation(const Point<dim>  &where,
                                                                                    const unsigned int component) const
  {
    std::vector<std::pair<types::global_dof_index, double>> weights;
    // Every element is tried: robust for all element shapes and ranks, and done once per point.
    const MPI_Comm     comm = communicator();
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    double             best = 1e-8; // how far outside, in the unit element, still counts as inside
    Point<dim>         unit;
    typename DoFHandler<dim>::active_cell_iterator home = dof_handler.end();
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->bounding_box().point_inside(where, 1e-8))
        {
          try
            {
              const Point<dim> p       = geometry->transform_real_to_unit_cell(cell, where);
              const double     outside = distance_outside(p, grid.family);
              if (outside < best)
                {
                  best = outside;
                  unit = p;
                  home = cell;
                }
            }
          catch (const typename Mapping<dim>::ExcTransformationFailed &)
            {
            }
        }
    const unsigned int found_by =
      Utilities::MPI::min(home != dof_handler.end() ? rank : Utilities::MPI::n_mpi_processes(comm), comm);
    if (found_by == Utilities::MPI::n_mpi_processes(comm))
      {
        std::ostringstream text;
        text << "point " << where << ": lies outside the solid. Move it onto or into the mesh.";
        throw std::invalid_argument(text.str());
      }
    if (found_by != rank)
      return weights;
    std::vector<types::global_dof_index> indices(element->n_dofs_per_cell());
    home->get_dof_indices(indices);
    for (unsigned int i = 0; i < indices.size(); ++i)
      if (element->system_to_component_index(i).first == component)
        weights.emplace_back(indices[i], element->shape_value(i, unit));
    return weights;
  }

  template <int dim>
  void Solid<dim>::place_forces()
  {
    nodal_forces.clear();
    for (const auto &force : loads.point_forces)
      {
        NodalForce nodal;
        nodal.value = force.value;
        for (unsigned int c = 0; c < dim; ++c)
          nodal.weights[c] = interpolation(force.where, c);
        nodal_forces.push_back(nodal);
      }
    for (const auto &t : loads.tractions)
      grid.boundary(t.boundary); // an unknown name is refused now, not in the first step
    for (const auto &p : loads.pressures)
      grid.boundary(p.boundary);
  }

  template <int dim>
  void Solid<dim>::external_force(const double time, Vector &force) const
  {
    force = 0;
    for (const auto &nodal : nodal_forces)
      {
        const Tensor<1, dim> value = nodal.value(time);
        for (unsigned int c = 0; c < dim; ++c)
          for (const auto &[dof, weight] : nodal.weights[c])
            force[dof] += weight * value[c];
      }
    if (!loads.tractions.empty() || !loads.pressures.empty())
      add_surface_loads(time, force);
    if (loads.body_force)
      add_body_force(time, force);
    force.compress(VectorOperation::add);
    force.update_ghost_values();
  }

  template <int dim>
  void Solid<dim>::add_surface_loads(const double time, Vector &force) const
  {
    FEFaceValues<dim>                    values(*geometry, *element, face_points,
                                                update_values | update_quadrature_points | update_normal_vectors | update_JxW_values);
    std::vector<types::global_dof_index> indices(element->n_dofs_per_cell());
    const double                         thickness = dim == 2 ? settings.thickness : 1.0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const unsigned int face : cell->face_indices())
          if (cell->face(face)->at_boundary())
            {
              const types::boundary_id id     = cell->face(face)->boundary_id();
              bool                     loaded = false;
              for (const auto &t : loads.tractions)
                loaded = loaded || grid.boundary(t.boundary) == id;
              for (const auto &p : loads.pressures)
                loaded = loaded || grid.boundary(p.boundary) == id;
              if (!loaded)
                continue;
              values.reinit(cell, face);
              cell->get_dof_indices(indices);
              for (const unsigned int q : values.quadrature_point_indices())
                {
                  Tensor<1, dim> traction;
                  for (const auto &t : loads.tractions)
                    if (grid.boundary(t.boundary) == id)
                      traction += t.value(values.quadrature_point(q), time);
                  for (const auto &p : loads.pressures)
                    if (grid.boundary(p.boundary) == id)
                      traction -= p.value(values.quadrature_point(q), time) * values.normal_vector(q);
                  for (unsigned int i = 0; i < indices.size(); ++i)
                    force[indices[i]] += thickness * values.shape_value(i, q) *
                                         traction[element->system_to_component_index(i).first] * values.JxW(q);
                }
            }
  }

  template <int dim>
  void Solid<dim>::add_body_force(const double time, Vector &force) const
  {
    FEValues<dim>                        values(*geometry, *element, load_points,
                                                update_values | update_quadrature_points | update_JxW_values);
    std::vector<types::global_dof_index> indices(element->n_dofs_per_cell());
    const double                         thickness = dim == 2 ? settings.thickness : 1.0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          cell->get_dof_indices(indices);
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const Tensor<1, dim> body = loads.body_force(values.quadrature_point(q), time);
              for (unsigned int i = 0; i < indices.size(); ++i)
                force[indices[i]] += thickness * values.shape_value(i, q) *
                                     body[element->system_to_component_index(i).first] * values.JxW(q);
            }
        }
  }

  template void                                                    Solid<2>::external_force(double, Vector &) const;
  template void                                                    Solid<3>::external_force(double, Vector &) const;
  template void                                                    Solid<2>::place_forces();
  template void                                                    Solid<3>::place_forces();
  template std::vector<std::pair<types::global_dof_index, double>> Solid<2>::interpolation(const Point<2> &,
                                                                                           unsigned int) const;
  template std::vector<std::pair<types::global_dof_index, double>> Solid<3>::interpolation(const Point<3> &,
                                                                                           unsigned int) const;
}
