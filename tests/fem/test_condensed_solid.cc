// A solid seen from some of its displacements, against the whole.
#include "base/errors.h"
#include "fem/solid/weight.h"
#include "fem/solvers/condensed_solid.h"
#include "solid_fixture.h"

#include <deal.II/dofs/dof_tools.h>

using namespace dealii;

namespace
{
  constexpr double young = 30e9, poisson = 0.2;

  /// A block held at x = 0, pressed, pulled, and moved at a corner, in proportion to time.
  template <int dim>
  fem::Loads<dim> loads(const double offset = 0)
  {
    fem::Loads<dim> all;
    for (unsigned int c = 0; c < dim; ++c)
      all.displacements.push_back({"0", c, [](const Point<dim> &, double) { return 0.0; }});
    all.tractions.push_back({"1", [](const Point<dim> &, const double t) {
                               Tensor<1, dim> traction;
                               traction[0] = 2e6 * t;
                               traction[1] = -1e6 * t;
                               return traction;
                             }});
    Point<dim> corner;
    corner[0] = 2;
    corner[1] = 1;
    all.nodes.push_back({corner, 1, [offset](const Point<dim> &, const double t) { return 1e-4 * t + offset; }});
    return all;
  }

  template <int dim>
  Model<dim> block(const fem::Loads<dim> &acting, const bool large = false)
  {
    Point<dim> corner;
    corner[0] = 2;
    for (unsigned int d = 1; d < dim; ++d)
      corner[d] = 1;
    std::vector<unsigned int> elements(dim, 2);
    elements[0] = 4;
    fem::SolidOptions options;
    options.large_displacement = large;
    return Model<dim>(box<dim>(corner, elements, 0.2), fem::ElementFamily::hypercube, options, elastic(young, poisson),
                      acting);
  }
}

TEMPLATE_TEST_CASE_SIG("condensed solid: what is kept sees the solid as it is, and the rest follows",
                       "[fem][statics]",
                       ((int dim), dim),
                       2,
                       3)
{
  Model<dim> model = block(loads<dim>());
  REQUIRE(model.solver->advance_to(0.7).converged);
  const fem::Vector &whole = model.solver->displacement();

  fem::Vector moved = model.solid.make_vector();
  model.solid.prescribed(1, moved);
  std::vector<types::global_dof_index> kept;
  for (types::global_dof_index i = 0; i < model.solid.dofs().n_dofs(); i += 3) // of whatever nodes, held ones too
    if (moved[i] == 0)
      kept.push_back(i);
  const fem::CondensedSolid<dim> condensed(model.solid, kept);
  Eigen::VectorXd                x(static_cast<Eigen::Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k)
    x[static_cast<Eigen::Index>(k)] = condensed.is_prescribed(kept[k]) ? 0.0 : whole[kept[k]];

  // In equilibrium nothing is left on them.
  const Eigen::VectorXd left = condensed.stiffness() * x + 0.7 * condensed.by_factor();
  CHECK(left.norm() < 1e-7 * (0.7 * condensed.by_factor()).norm());
  fem::Vector difference = condensed.displacement(x, 0.7);
  difference -= whole;
  CHECK(difference.linfty_norm() < 1e-8 * whole.linfty_norm());

  // Energy: what is stored, and what applied forces have done.
  const double done   = 0.7 * (condensed.load_work().dot(x) + 0.7 * condensed.own_load_work());
  const double stored = 0.5 * x.dot(condensed.stiffness() * x) + 0.7 * x.dot(condensed.by_factor()) +
                        0.5 * 0.49 * condensed.of_factor() + done;
  CHECK(stored == Approx(0.5 * (whole * model.solver->internal_force())).epsilon(1e-7));
  CHECK(done == Approx(whole * model.solver->external_force()).epsilon(1e-7));
}

TEMPLATE_TEST_CASE_SIG("condensed solid: dead forces move it and store energy in it as in the whole",
                       "[fem][statics]",
                       ((int dim), dim),
                       2,
                       3)
{
  constexpr double density = 2400, part = 0.4, p = 0.7;
  Tensor<1, dim>   gravity;
  gravity[1]                = -3e4; // so that it counts beside the loads
  gravity[0]                = 1e4;
  fem::Loads<dim> both      = loads<dim>();
  both.body_force           = [&](const Point<dim> &, double) { return part * density * gravity; };
  both.body_force_is_steady = true;
  Model<dim> model = block(loads<dim>()), heavy = block(both);
  REQUIRE(heavy.solver->advance_to(p).converged);
  const fem::Vector &whole = heavy.solver->displacement();

  std::map<types::material_id, double> densities;
  for (const auto &[name, id] : model.solid.mesh().materials)
    densities[id] = density;
  const fem::Vector weight = fem::weight_of(model.solid, densities, gravity);
  double            total  = 0;
  ComponentMask     upright(dim, false);
  upright.set(1, true);
  for (const auto dof : DoFTools::extract_dofs(model.solid.dofs(), upright))
    total += weight[dof];
  CHECK(total == Approx(2 * density * gravity[1]).epsilon(1e-12)); // 2 m by 1 m by 1 m

  fem::Vector moved = model.solid.make_vector();
  model.solid.prescribed(1, moved);
  std::vector<types::global_dof_index> kept;
  for (types::global_dof_index i = 0; i < model.solid.dofs().n_dofs(); i += 3)
    if (moved[i] == 0)
      kept.push_back(i);
  const fem::CondensedSolid<dim> condensed(model.solid, kept, &weight);
  const auto                    &dead = condensed.dead();
  Eigen::VectorXd                x(static_cast<Eigen::Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k)
    x[static_cast<Eigen::Index>(k)] = condensed.is_prescribed(kept[k]) ? 0.0 : whole[kept[k]];

  const Eigen::VectorXd left = condensed.stiffness() * x + p * condensed.by_factor() - part * dead.on_kept;
  CHECK(left.norm() < 1e-7 * (p * condensed.by_factor()).norm());
  fem::Vector difference = condensed.displacement(x, p, part);
  difference -= whole;
  CHECK(difference.linfty_norm() < 1e-8 * whole.linfty_norm());

  const double by_dead = part * (dead.on_kept.dot(x) + p * dead.by_factor + part * dead.by_itself);
  const double done =
    p * (condensed.load_work().dot(x) + p * condensed.own_load_work() + part * dead.on_loads) + by_dead;
  const double potential = 0.5 * x.dot(condensed.stiffness() * x) + p * x.dot(condensed.by_factor()) +
                           0.5 * p * p * condensed.of_factor() - part * (dead.on_kept.dot(x) + p * dead.by_factor) -
                           0.5 * part * part * dead.by_itself;
  CHECK(by_dead == Approx(part * (whole * weight)).epsilon(1e-7));
  CHECK(done == Approx(whole * heavy.solver->external_force()).epsilon(1e-7));
  CHECK(potential + done == Approx(0.5 * (whole * heavy.solver->internal_force())).epsilon(1e-7));
}

TEST_CASE("condensed solid: what has no such answer is refused", "[fem][statics]")
{
  Model<2> offset = block(loads<2>(1e-5));
  CHECK_THROWS_WITH(fem::CondensedSolid<2>(offset.solid, {}), Catch::Contains("in proportion to t"));
  Model<2> large = block(loads<2>(), true);
  CHECK_THROWS_WITH(fem::CondensedSolid<2>(large.solid, {}), Catch::Contains("linear elastic"));
  fem::Loads<2> none;
  none.may_move_freely = true;
  Model<2> free        = block(none);
  CHECK_THROWS_WITH(fem::CondensedSolid<2>(free.solid, {0, 1}), Catch::Contains("held neither"));
}
