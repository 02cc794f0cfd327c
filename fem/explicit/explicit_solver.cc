#include "fem/explicit/explicit_solver.h"

#include "fem/solid/element_kernel.h"

#include <Eigen/Eigenvalues>
#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>

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
        throw std::invalid_argument("Density of material " + entry.first + ": must be given and positive [kg/m^3].");
    if (!(options.safety > 0 && options.safety <= 1))
      throw std::invalid_argument("Safety = " + std::to_string(options.safety) +
                                  ": must lie in (0, 1], the step over the critical one.");
    if (!(options.damping >= 0))
      throw std::invalid_argument("Damping = " + std::to_string(options.damping) + " 1/s: must not be negative.");
    lump_mass();
    find_step();
    held.resize(u.locally_owned_size());
    for (unsigned int i = 0; i < held.size(); ++i)
      held[i] = solid.constraints().is_constrained(u.get_partitioner()->local_to_global(i));
  }

  namespace
  {
    /// Diagonal of the consistent mass scaled to the element's mass, component by component.
    template <int dim>
    void element_mass(const FEValues<dim> &values, const double density, std::vector<double> &mass)
    {
      const auto &fe    = values.get_fe();
      double      whole = 0, diagonal = 0;
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        whole += density * values.JxW(q);
      for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
        {
          mass[i] = 0;
          for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
            mass[i] += density * values.shape_value(i, q) * values.shape_value(i, q) * values.JxW(q);
          if (fe.system_to_component_index(i).first == 0)
            diagonal += mass[i];
        }
      for (double &m : mass)
        m *= whole / diagonal;
    }

    template <int dim>
    std::map<types::material_id, double> density_by_id(const Solid<dim> &solid, const ExplicitOptions &options)
    {
      std::map<types::material_id, double> by_id;
      for (const auto &[name, id] : solid.mesh().materials)
        by_id[id] = options.density.at(name);
      return by_id;
    }
  }

  template <int dim>
  void ExplicitSolver<dim>::lump_mass()
  {
    const auto         &fe = solid.dofs().get_fe();
    FEValues<dim>       values(solid.mapping(), fe, solid.quadrature(), update_values | update_JxW_values);
    std::vector<double> mass(fe.n_dofs_per_cell());
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    const auto                           density   = density_by_id(solid, options);
    const double                         thickness = dim == 2 ? solid.options().thickness : 1.0;
    for (const auto &cell : solid.dofs().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          element_mass(values, thickness * density.at(cell->material_id()), mass);
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < mass.size(); ++i)
            lumped[indices[i]] += mass[i];
        }
    lumped.compress(VectorOperation::add);
    lumped.update_ghost_values();
  }

  template <int dim>
  void ExplicitSolver<dim>::find_step()
  {
    const auto        &fe = solid.dofs().get_fe();
    const unsigned int n  = fe.n_dofs_per_cell();
    FEValues<dim> values(solid.mapping(), fe, solid.quadrature(), update_values | update_gradients | update_JxW_values);
    ElementKernel<dim>  kernel(fe, solid.quadrature().size(), false, solid.options().mean_dilatation);
    std::vector<double> mass(n);
    const auto          density = density_by_id(solid, options);
    // Elements of one shape and material share an eigenvalue: a regular mesh costs one eigenvalue problem.
    std::map<std::vector<long long>, double> known;
    double                                   largest = 0;
    std::size_t                              next    = 0;
    for (const auto &cell : solid.dofs().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto            &points = solid.element_points()[next++];
          std::vector<long long> shape{static_cast<long long>(cell->material_id())};
          const double           unit = 1e-9 * cell->diameter();
          shape.push_back(std::llround(std::log(cell->diameter()) * 1e9));
          for (unsigned int w = 1; w < cell->n_vertices(); ++w)
            for (unsigned int d = 0; d < dim; ++d)
              shape.push_back(std::llround((cell->vertex(w)[d] - cell->vertex(0)[d]) / unit));
          const auto found = known.find(shape);
          if (found != known.end())
            continue;
          values.reinit(cell);
          element_mass(values, density.at(cell->material_id()), mass);
          kernel.reinit(values, Eigen::VectorXd::Zero(n));
          Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
          for (unsigned int q = 0; q < solid.quadrature().size(); ++q)
            {
              kernel.strain(q);
              kernel.add_stiffness(Voigt::Zero(), points.material->elastic_stiffness(), k);
            }
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              k(i, j) /= std::sqrt(mass[i] * mass[j]);
          const double top =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues()[n - 1];
          known[shape] = top;
          largest      = std::max(largest, top);
        }
    step_limit = 2 / std::sqrt(Utilities::MPI::max(largest, solid.communicator()));
  }

  template <int dim>
  void ExplicitSolver<dim>::set_velocity(const VectorOf<dim> &velocity)
  {
    if (started)
      throw std::invalid_argument("initial velocity: the motion has begun already.");
    const auto                          &fe = solid.dofs().get_fe();
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : solid.dofs().active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            if (v.in_local_range(indices[i]))
              v[indices[i]] = velocity(solid.mapping().transform_unit_to_real_cell(cell, fe.unit_support_point(i)),
                                       0.0)[fe.system_to_component_index(i).first];
        }
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
  void ExplicitSolver<dim>::advance(const double length)
  {
    if (!started)
      {
        internal_force_at(u, f_int);
        solid.external_force(current_time, f_ext);
        mean = v;
      }
    solid.prescribed(current_time + length, target);
    double pushed = 0; // kinetic energy that the supports give to their own nodes
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      {
        const double old = v.local_element(i);
        // The first step starts from the velocity at time zero: half a kick.
        const double now       = held[i] ? (target.local_element(i) - u.local_element(i)) / length :
                                              kicked(i, old, started ? length : 0.5 * length);
        v.local_element(i)     = now;
        moved.local_element(i) = length * now;
        u.local_element(i) += moved.local_element(i);
        if (held[i])
          pushed += 0.5 * lumped.local_element(i) * (now * now - (started ? old * old : 0.0));
      }
    started = true;
    u.update_ghost_values();

    f_before.swap(f_int);
    e_before.swap(f_ext);
    internal_force_at(u, f_int);
    if (!solid.linear())
      solid.commit();
    current_time += length;
    solid.external_force(current_time, f_ext);
    keep_account(length, pushed);
  }

  template <int dim>
  void ExplicitSolver<dim>::keep_account(const double length, const double pushed)
  {
    // Kinetic energy at whole steps is v(n-1/2) m v(n+1/2) / 2: with trapezoidal work its sum is exact for central differences.
    double inner = 0, outer = pushed, kinetic = 0, damped = 0;
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
    account.internal += Utilities::MPI::sum(inner, comm);
    account.external += Utilities::MPI::sum(outer, comm);
    account.damped += Utilities::MPI::sum(damped, comm);
    account.kinetic = Utilities::MPI::sum(kinetic, comm);
    if (!std::isfinite(account.kinetic) || !std::isfinite(account.internal))
      throw MaterialFailure("explicit step at time " + std::to_string(current_time) +
                            " s: the motion is no longer a number. Lower the step.");
  }

  template <int dim>
  ExplicitState ExplicitSolver<dim>::state() const
  {
    return {current_time, started, account, u, v, f_int, mean};
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
    u.update_ghost_values();
    solid.external_force(current_time, f_ext);
  }

  template class ExplicitSolver<2>;
  template class ExplicitSolver<3>;
}
