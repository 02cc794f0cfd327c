// Loads of a solid: surface, body and point forces.
#include "base/errors.h"
#include "fem/solid/point_search.h"
#include "fem/solid/solid.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>

#include <sstream>

namespace fem
{
  using namespace dealii;

  template <int dim>
  const PointSearch<dim> &Solid<dim>::point_search() const
  {
    if (!search)
      search = std::make_shared<const PointSearch<dim>>(*this);
    return *search;
  }

  template <int dim>
  std::vector<std::pair<types::global_dof_index, double>> Solid<dim>::interpolation(const Point<dim>  &where,
                                                                                    const unsigned int component) const
  {
    const MPI_Comm     comm = communicator();
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm), none = Utilities::MPI::n_mpi_processes(comm);
    const auto         place    = point_search().find(where);
    const unsigned int found_by = Utilities::MPI::min(place ? rank : none, comm);
    if (found_by == none)
      {
        std::ostringstream text;
        text << "point " << where << ": lies outside the solid. Move it onto or into the mesh.";
        throw base::InputError(text.str());
      }
    std::vector<std::pair<types::global_dof_index, double>> weights;
    if (found_by == rank)
      for (std::size_t node = 0; node < place->nodes.size(); ++node)
        weights.emplace_back(place->nodes[node][component], place->weights[node]);
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
      grid.boundary(t.boundary); // an unknown name is refused now, on every rank
    for (const auto &p : loads.pressures)
      grid.boundary(p.boundary);
    place_surface_loads();
    if (loads.body_force && loads.body_force_is_steady)
      {
        steady_body_force = make_vector();
        add_body_force(0, steady_body_force);
        steady_body_force.compress(VectorOperation::add);
      }
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
    add_surface_loads(time, force);
    if (loads.body_force && !loads.body_force_is_steady)
      add_body_force(time, force);
    force.compress(VectorOperation::add);
    if (loads.body_force && loads.body_force_is_steady)
      force += steady_body_force;
    force.update_ghost_values();
  }

  template <int dim>
  void Solid<dim>::place_surface_loads()
  {
    surface_points.clear();
    FEFaceValues<dim>                    values(*geometry, *element, face_points,
                                                update_values | update_quadrature_points | update_normal_vectors | update_JxW_values);
    std::vector<types::global_dof_index> indices(element->n_dofs_per_cell());
    const double                         thickness = dim == 2 ? settings.thickness : 1.0;
    const auto                           loaded    = [this](const auto &kind, const types::boundary_id id) {
      std::vector<std::size_t> found;
      for (std::size_t i = 0; i < kind.size(); ++i)
        if (grid.boundary(kind[i].boundary) == id)
          found.push_back(i);
      return found;
    };
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const unsigned int face : cell->face_indices())
          if (cell->face(face)->at_boundary())
            {
              const types::boundary_id id        = cell->face(face)->boundary_id();
              const auto               tractions = loaded(loads.tractions, id), pressures = loaded(loads.pressures, id);
              if (tractions.empty() && pressures.empty())
                continue;
              values.reinit(cell, face);
              cell->get_dof_indices(indices);
              for (const unsigned int q : values.quadrature_point_indices())
                {
                  SurfacePoint point{values.quadrature_point(q), values.normal_vector(q), tractions, pressures, {}};
                  for (unsigned int i = 0; i < indices.size(); ++i)
                    if (values.shape_value(i, q) != 0)
                      point.weights.push_back({layout->global_to_local(indices[i]),
                                               {element->system_to_component_index(i).first,
                                                thickness * values.shape_value(i, q) * values.JxW(q)}});
                  surface_points.push_back(point);
                }
            }
  }

  template <int dim>
  void Solid<dim>::add_surface_loads(const double time, Vector &force) const
  {
    for (const SurfacePoint &point : surface_points)
      {
        Tensor<1, dim> traction;
        for (const std::size_t i : point.tractions)
          traction += loads.tractions[i].value(point.place, time);
        for (const std::size_t i : point.pressures)
          traction -= loads.pressures[i].value(point.place, time) * point.normal;
        for (const auto &[position, share] : point.weights)
          force.local_element(position) += share.second * traction[share.first];
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
              const Tensor<1, dim> body =
                share_at(settings, values.quadrature_point(q)) * loads.body_force(values.quadrature_point(q), time);
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
  template const PointSearch<2>                                   &Solid<2>::point_search() const;
  template const PointSearch<3>                                   &Solid<3>::point_search() const;
  template std::vector<std::pair<types::global_dof_index, double>> Solid<2>::interpolation(const Point<2> &,
                                                                                           unsigned int) const;
  template std::vector<std::pair<types::global_dof_index, double>> Solid<3>::interpolation(const Point<3> &,
                                                                                           unsigned int) const;
}
