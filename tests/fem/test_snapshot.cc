// What a viewer is shown of a solid.
#include "fem/output/snapshot.h"
#include "tests/fem/solid_fixture.h"

#include <deal.II/dofs/dof_tools.h>

#include <cmath>

namespace
{
  const fem::SolidSnapshot::Field &field(const std::vector<fem::SolidSnapshot::Field> &fields, const std::string &name)
  {
    for (const auto &f : fields)
      if (f.name == name)
        return f;
    throw std::invalid_argument(name);
  }

  /// u = G x at every node.
  template <int dim>
  fem::Vector linear(const fem::Solid<dim> &solid, const dealii::Tensor<2, dim> &gradient)
  {
    std::map<dealii::types::global_dof_index, dealii::Point<dim>> place;
    dealii::DoFTools::map_dofs_to_support_points(solid.mapping(), solid.dofs(), place);
    fem::Vector                                  u = solid.make_vector();
    std::vector<dealii::types::global_dof_index> indices(solid.dofs().get_fe().n_dofs_per_cell());
    for (const auto &cell : solid.dofs().active_cell_iterators())
      {
        cell->get_dof_indices(indices);
        for (unsigned int i = 0; i < indices.size(); ++i)
          u[indices[i]] = (gradient * place[indices[i]])[solid.dofs().get_fe().system_to_component_index(i).first];
      }
    u.update_ghost_values();
    return u;
  }

  template <int dim>
  void check_linear(const fem::ElementFamily family, const unsigned int degree)
  {
    fem::SolidOptions options;
    options.degree = degree;
    const std::vector<unsigned int> divisions(dim, 2);
    dealii::Point<dim>              size;
    for (int d = 0; d < dim; ++d)
      size[d] = 1 + d;
    Model<dim>             model(box<dim>(size, divisions), family, options, elastic(1e9, 0.2),
                                 hold_all<dim>([](const auto &, double) { return dealii::Tensor<1, dim>(); }));
    dealii::Tensor<2, dim> gradient;
    gradient[0][0]         = 1e-3;
    gradient[0][1]         = 4e-4; // engineering shear 4e-4: tensor shear 2e-4
    gradient[1][1]         = -5e-4;
    const fem::Vector u    = linear<dim>(model.solid, gradient);
    fem::Vector       none = model.solid.make_vector();
    none.update_ghost_values();
    const fem::SolidSnapshot shown = fem::take_snapshot(model.solid, u, none);

    CHECK(shown.size() == model.solid.mesh().triangulation->n_active_cells());
    CHECK(shown.nodes() == model.solid.dofs().n_dofs() / dim); // shared between elements
    for (const std::int64_t node : shown.elements)
      CHECK((node >= 0 && node < static_cast<std::int64_t>(shown.nodes())));
    const auto &displacement = field(shown.at_nodes, "displacement"), &strain = field(shown.at_nodes, "strain"),
               &stress = field(shown.at_nodes, "stress");
    for (std::size_t n = 0; n < shown.nodes(); ++n)
      {
        const float *x = &shown.place[3 * n];
        CHECK(displacement.values[3 * n] == Approx(1e-3 * x[0] + 4e-4 * x[1]).margin(1e-9));
        CHECK(displacement.values[3 * n + 1] == Approx(-5e-4 * x[1]).margin(1e-9));
        // Hooke with E = 1e9, nu = 0.2: lambda = 2.778e8, mu = 4.167e8; single precision. Order xx yy zz xy yz xz.
        CHECK(strain.values[6 * n] == Approx(1e-3).epsilon(1e-5));
        CHECK(strain.values[6 * n + 3] == Approx(2e-4).epsilon(1e-5));
        CHECK(stress.values[6 * n] == Approx(1e9 / 3.6 * 5e-4 + 1e9 / 1.2 * 1e-3).epsilon(1e-5));
        CHECK(stress.values[6 * n + 2] == Approx(1e9 / 3.6 * 5e-4).epsilon(1e-5));
        CHECK(stress.values[6 * n + 3] == Approx(1e9 / 2.4 * 4e-4).epsilon(1e-5));
      }
    CHECK(shown.of_elements.empty()); // elastic: no history
  }
}

TEST_CASE("snapshot: a linear displacement is shown with its strain and stress at shared nodes of any element", "[fem]")
{
  const auto cube = fem::ElementFamily::hypercube, simplex = fem::ElementFamily::simplex;
  check_linear<2>(cube, 1);
  check_linear<2>(cube, 2);
  check_linear<2>(simplex, 1);
  check_linear<2>(simplex, 2);
  check_linear<3>(cube, 1);
  check_linear<3>(cube, 2);
  check_linear<3>(simplex, 1);
  check_linear<3>(simplex, 2);
}
