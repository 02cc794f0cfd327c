#pragma once

#include "fem/solid/solid.h"

#include <deal.II/fe/fe_values.h>

#include <map>
#include <vector>

namespace fem
{
  /**
   * Forces on all displacements by which the solid is drawn down, of what counts of it where it shares its place (SolidOptions::share) [N].
   * @param density of the elements of each material, on every rank alike [kg/m^3] @param gravity acceleration of what falls [m/s^2]
   */
  template <int dim>
  Vector weight_of(const Solid<dim>                                   &solid,
                   const std::map<dealii::types::material_id, double> &density,
                   const dealii::Tensor<1, dim>                       &gravity)
  {
    const auto           &element   = solid.dofs().get_fe();
    const double          thickness = dim == 2 ? solid.options().thickness : 1.0;
    const auto            wanted = dealii::update_values | dealii::update_quadrature_points | dealii::update_JxW_values;
    dealii::FEValues<dim> values(solid.mapping(), element, solid.quadrature(), wanted);
    std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
    Vector                                       force = solid.make_vector();
    for (const auto &cell : solid.dofs().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          cell->get_dof_indices(indices);
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const double mass = density.at(cell->material_id()) * thickness * values.JxW(q) *
                                  share_at(solid.options(), values.quadrature_point(q));
              for (unsigned int i = 0; i < indices.size(); ++i)
                force[indices[i]] +=
                  mass * values.shape_value(i, q) * gravity[element.system_to_component_index(i).first];
            }
        }
    force.compress(dealii::VectorOperation::add);
    force.update_ghost_values();
    return force;
  }
}
