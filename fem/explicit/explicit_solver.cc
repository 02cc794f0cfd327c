#include "fem/explicit/explicit_solver.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "fem/explicit/element_mass.h"

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace fem
{
  using namespace dealii;

  double ExplicitEnergy::balance() const
  {
    const double largest = std::max({std::fabs(kinetic), std::fabs(internal), std::fabs(external), damped, start});
    return largest > 0 ? (external + start - kinetic - internal - damped) / largest : 0.0;
  }

  template <int dim>
  ExplicitSolver<dim>::ExplicitSolver(Solid<dim> &solid_, const ExplicitOptions &options_)
    : solid(solid_)
    , options(options_)
    , u(solid_.make_vector())
    , v(solid_.make_vector())
    , f_int(solid_.make_vector())
    , f_ext(solid_.make_vector())
    , lumped(solid_.make_vector())
    , mean(solid_.make_vector())
    , moved(solid_.make_vector())
    , target(solid_.make_vector())
    , f_before(solid_.make_vector())
    , e_before(solid_.make_vector())
  {
    for (const auto &entry : solid.mesh().materials)
      if (options.density.count(entry.first) == 0 || !(options.density.at(entry.first) > 0))
        throw base::InputError("Density of material " + entry.first + ": must be given and positive [kg/m^3].");
    if (!(options.safety > 0 && options.safety <= 1))
      throw base::InputError("Safety = " + base::number_text(options.safety) +
                             ": must lie in (0, 1], the step over the critical one.");
    if (!(options.damping >= 0))
      throw base::InputError("Damping = " + base::number_text(options.damping) + " 1/s: must not be negative.");
    lump_mass();
    find_weight();
    find_step();
    held.resize(u.locally_owned_size());
    for (unsigned int i = 0; i < held.size(); ++i)
      held[i] = solid.constraints().is_constrained(u.get_partitioner()->local_to_global(i));
  }

  template <int dim>
  void ExplicitSolver<dim>::lump_mass()
  {
    const auto                          &fe = solid.dofs().get_fe();
    FEValues<dim>                        values(solid.mapping(), fe, solid.quadrature(),
                                                update_values | update_JxW_values | update_quadrature_points);
    std::vector<double>                  mass(fe.n_dofs_per_cell());
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    const auto                           density   = density_by_id(solid, options);
    const double                         thickness = dim == 2 ? solid.options().thickness : 1.0;
    for (const auto &cell : solid.dofs().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          element_mass(values, thickness * density.at(cell->material_id()), shares_of(solid.options(), values),
                       options.shared, mass);
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < mass.size(); ++i)
            lumped[indices[i]] += mass[i];
        }
    lumped.compress(VectorOperation::add);
    lumped.update_ghost_values();
  }

  template <int dim>
  double ExplicitSolver<dim>::density(const types::material_id id) const
  {
    return density_by_id(solid, options).at(id);
  }

  namespace
  {
    /// Calls visit(cell, i, dof) for every degree of freedom of this rank, the i-th of a cell; of several cells more than once.
    template <int dim, typename Visit>
    void visit_own_dofs(const fem::Solid<dim> &solid, const Vector &of, const Visit &visit)
    {
      std::vector<types::global_dof_index> indices(solid.dofs().get_fe().n_dofs_per_cell());
      for (const auto &cell : solid.dofs().active_cell_iterators())
        if (!cell->is_artificial())
          {
            cell->get_dof_indices(indices);
            for (unsigned int i = 0; i < indices.size(); ++i)
              if (of.in_local_range(indices[i]))
                visit(cell, i, indices[i]);
          }
    }
  } // namespace

  template <int dim>
  void ExplicitSolver<dim>::find_weight()
  {
    if (options.gravity == std::array<double, 3>{0, 0, 0})
      return;
    weight         = solid.make_vector();
    const auto &fe = solid.dofs().get_fe();
    visit_own_dofs(solid, weight, [&](const auto &, const unsigned int i, const types::global_dof_index dof) {
      weight[dof] = lumped[dof] * options.gravity[fe.system_to_component_index(i).first];
    });
  }

  template <int dim>
  void ExplicitSolver<dim>::set_velocity(const VectorOf<dim> &velocity)
  {
    if (started)
      throw base::InputError("initial velocity: the motion has begun already.");
    const auto &fe = solid.dofs().get_fe();
    visit_own_dofs(solid, v, [&](const auto &cell, const unsigned int i, const types::global_dof_index dof) {
      v[dof] = velocity(solid.mapping().transform_unit_to_real_cell(cell, fe.unit_support_point(i)),
                        0.0)[fe.system_to_component_index(i).first];
    });
    solid.constraints().set_zero(v);
    account.start = 0;
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      account.start += 0.5 * lumped.local_element(i) * v.local_element(i) * v.local_element(i);
    account.start   = Utilities::MPI::sum(account.start, solid.communicator());
    account.kinetic = account.start;
  }

  template <int dim>
  void ExplicitSolver<dim>::internal_force_at(const Vector &displacement, Vector &force)
  {
    solid.internal_force(displacement, force);
  }

  template <int dim>
  double ExplicitSolver<dim>::kicked(const unsigned int i, const double old, const double kick) const
  {
    const double drag = 0.5 * options.damping * kick;
    return ((1 - drag) * old + kick * (f_ext.local_element(i) - f_int.local_element(i)) / lumped.local_element(i)) /
           (1 + drag);
  }

  template <int dim>
  void ExplicitSolver<dim>::find_external_force()
  {
    solid.external_force(current_time, f_ext);
    if (weight.size() > 0)
      f_ext += weight;
    if (outside.force.size() > 0)
      f_ext += outside.force;
  }

  template <int dim>
  unsigned int ExplicitSolver<dim>::local(const types::global_dof_index dof) const
  {
    if (!v.in_local_range(dof))
      throw base::InputError("displacement " + std::to_string(dof) + ": belongs to another rank.");
    return v.get_partitioner()->global_to_local(dof);
  }

  template <int dim>
  void ExplicitSolver<dim>::add_mass(const types::global_dof_index dof, const double mass)
  {
    const unsigned int i = local(dof);
    if (weight.size() > 0)
      weight.local_element(i) *= 1 + mass / lumped.local_element(i);
    lumped.local_element(i) += mass;
    lumped.update_ghost_values();
    if (!started) // it moves as the displacement does, from the start
      outside.start += 0.5 * mass * v.local_element(i) * v.local_element(i);
  }

  template <int dim>
  void ExplicitSolver<dim>::add_force(const types::global_dof_index dof, const double force)
  {
    const unsigned int i = local(dof);
    if (outside.force.size() == 0)
      outside.force = solid.make_vector();
    outside.force.local_element(i) += force;
    f_ext.local_element(i) += force; // found anew at the first step
    if (!started || held[i])
      return;
    // What this force adds to the half step before, which is in the account already.
    const double m = lumped.local_element(i), behind = last_length * v.local_element(i);
    const double faster = 0.5 * last_length * force / m / (1 + 0.5 * options.damping * last_length);
    outside.work += 0.5 * force * behind;
    outside.damped += options.damping * m * 0.5 * faster * behind;
    mean.local_element(i) += faster;
  }

  template <int dim>
  void ExplicitSolver<dim>::clear_forces()
  {
    if (outside.force.size() == 0)
      return;
    for (unsigned int i = 0; i < outside.force.locally_owned_size(); ++i)
      if (outside.force.local_element(i) != 0)
        add_force(v.get_partitioner()->local_to_global(i), -outside.force.local_element(i));
    outside.force.reinit(0);
  }

  template <int dim>
  void ExplicitSolver<dim>::carry(const types::global_dof_index dof, const double by)
  {
    outside.carried[local(dof)] = by;
  }

  template <int dim>
  void ExplicitSolver<dim>::apply_impulse(const types::global_dof_index dof, const double change)
  {
    const unsigned int i = local(dof);
    if (held[i])
      return;
    const double m = lumped.local_element(i), old = v.local_element(i), now = old + change;
    v.local_element(i) = now;
    if (!started)
      {
        outside.start += 0.5 * m * (now * now - old * old);
        return;
      }
    const double ahead = kicked(i, now, last_length);
    outside.work += 0.5 * m * (now * ahead - old * kicked(i, old, last_length));
    mean.local_element(i) = 0.5 * (now + ahead);
  }

  template <int dim>
  void ExplicitSolver<dim>::prescribe(const types::global_dof_index dof, const double velocity)
  {
    const unsigned int i = local(dof);
    if (solid.constraints().is_constrained(dof))
      throw base::InputError("displacement " + std::to_string(dof) +
                             ": is prescribed by the loads of the solid, and cannot be from outside as well.");
    if (started && !held[i]) // kinetic energy of what is held is that of its velocity alone
      {
        const double now = v.local_element(i);
        outside.work += 0.5 * lumped.local_element(i) * now * (now - kicked(i, now, last_length));
      }
    held[i]           = true;
    outside.driven[i] = velocity;
  }

  template <int dim>
  double ExplicitSolver<dim>::reaction(const types::global_dof_index dof) const
  {
    const unsigned int i = local(dof);
    return f_int.local_element(i) - f_ext.local_element(i);
  }

  template <int dim>
  void ExplicitSolver<dim>::find_forces_of_start()
  {
    internal_force_at(u, f_int);
    find_external_force();
    mean = v;
  }

  template <int dim>
  double ExplicitSolver<dim>::kick_of(const double length) const
  {
    return started ? 0.5 * (last_length + length) : 0.5 * length; // the first starts from the velocity at time zero
  }

  template <int dim>
  double ExplicitSolver<dim>::next_velocity(const unsigned int i, const double length, const double kick) const
  {
    if (!held[i])
      return kicked(i, v.local_element(i), kick);
    const auto own = outside.driven.find(i);
    return own != outside.driven.end() ? own->second : (target.local_element(i) - u.local_element(i)) / length;
  }

  template <int dim>
  void ExplicitSolver<dim>::predict(const double length, Vector &velocity)
  {
    if (!started)
      find_forces_of_start();
    const double kick = kick_of(length);
    solid.prescribed(current_time + length, target);
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      velocity.local_element(i) = next_velocity(i, length, kick);
  }

  template <int dim>
  double ExplicitSolver<dim>::force_for_velocity(const types::global_dof_index dof, const double length) const
  {
    const unsigned int i    = local(dof);
    const double       kick = kick_of(length);
    return held[i] ? 0.0 : lumped.local_element(i) * (1 + 0.5 * options.damping * kick) / kick;
  }

  template <int dim>
  void ExplicitSolver<dim>::advance(const double length)
  {
    if (!started)
      find_forces_of_start();
    const double kick = kick_of(length);
    solid.prescribed(current_time + length, target);
    double pushed = 0; // kinetic energy that the supports give to their own nodes
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      {
        const double old = v.local_element(i), now = next_velocity(i, length, kick);
        // Whether the account has the old velocity: of what is driven as energy of the start, where it had one.
        const bool in_account  = started || outside.driven.count(i) > 0;
        v.local_element(i)     = now;
        moved.local_element(i) = length * now;
        if (!outside.carried.empty() && !held[i])
          if (const auto by = outside.carried.find(i); by != outside.carried.end())
            moved.local_element(i) = by->second;
        u.local_element(i) += moved.local_element(i);
        if (held[i])
          pushed += 0.5 * lumped.local_element(i) * (now * now - (in_account ? old * old : 0.0));
      }
    outside.carried.clear();
    started     = true;
    last_length = length;
    u.update_ghost_values();

    f_before.swap(f_int);
    e_before.swap(f_ext);
    solid.begin_motion(length);
    internal_force_at(u, f_int);
    if (!solid.linear())
      solid.commit();
    current_time += length;
    find_external_force();
    keep_account(length, pushed);
    if (solid.options().large_displacement)
      follow_deformation();
  }

  template <int dim>
  void ExplicitSolver<dim>::keep_account(const double length, const double pushed)
  {
    // Kinetic energy at whole steps is v(n-1/2) m v(n+1/2) / 2: with trapezoidal work its sum is exact for central differences.
    double       inner = 0, outer = pushed + outside.work, kinetic = 0, damped = outside.damped;
    const double start = outside.start;
    outside.work = outside.damped = outside.start = 0;
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      {
        const double m = lumped.local_element(i), now = v.local_element(i), d = moved.local_element(i);
        const double force = 0.5 * (f_before.local_element(i) + f_int.local_element(i));
        const double load  = 0.5 * (e_before.local_element(i) + f_ext.local_element(i));
        inner += force * d;
        if (held[i])
          {
            kinetic += 0.5 * m * now * now;
            outer += force * d; // reaction and load together
            continue;
          }
        outer += load * d;
        const double next  = kicked(i, now, length);
        const double speed = 0.5 * (now + next);
        kinetic += 0.5 * m * now * next;
        damped += options.damping * m * 0.5 * (mean.local_element(i) + speed) * d;
        mean.local_element(i) = speed;
      }
    const auto comm = solid.communicator();
    account.start += Utilities::MPI::sum(start, comm);
    account.internal += Utilities::MPI::sum(inner, comm);
    account.external += Utilities::MPI::sum(outer, comm);
    account.damped += Utilities::MPI::sum(damped, comm);
    account.kinetic = Utilities::MPI::sum(kinetic, comm);
    if (!std::isfinite(account.kinetic) || !std::isfinite(account.internal))
      throw MaterialFailure("explicit step at time " + base::number_text(current_time) +
                            " s: the motion is no longer a number. Lower the step.");
  }

  template <int dim>
  ExplicitState ExplicitSolver<dim>::state() const
  {
    return {current_time, started, last_length, account, u,        v,         f_int,
            mean,         moved,   outside,     f_ext,   elements, since_look};
  }

  template <int dim>
  void ExplicitSolver<dim>::restore(const ExplicitState &saved)
  {
    current_time = saved.time;
    started      = saved.started;
    account      = saved.energy;
    u            = saved.displacement;
    v            = saved.velocity;
    f_int        = saved.internal_force;
    mean         = saved.mean_velocity;
    moved        = saved.last_motion;
    last_length  = saved.last_length;
    for (const auto &now : outside.driven)
      held[now.first] = false;
    outside = saved.outside;
    for (const auto &then : outside.driven)
      held[then.first] = true;
    f_ext      = saved.external_force;
    elements   = saved.elements;
    since_look = saved.since_look;
    u.update_ghost_values();
    if (elements.empty())
      return;
    double largest = 0;
    for (const ElementStep &element : elements)
      largest = std::max(largest, element.eigenvalue);
    limit_step(largest);
  }

  template class ExplicitSolver<2>;
  template class ExplicitSolver<3>;
}
