#include "coupling/sequential/transfer.h"

#include "base/errors.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace coupling
{
  namespace
  {
    /** An average whose weights' centre lies further off (in widths) is one-sided; a flat surface gives 0.8. */
    constexpr double one_sided = 0.4;

    /** Share of the given stress that a point may lose at zero strain by rounding, and one that is a loss. */
    constexpr double lost_by_rounding = 1e-9, loss = 0.1;

    template <int dim>
    Eigen::Vector3d place_of(const dealii::Point<dim> &x)
    {
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      for (int d = 0; d < dim; ++d)
        place[d] = x[d];
      return place;
    }

    /** What particles are smoothed over by themselves: the element, or the length over which the material averages its damage. */
    double own_size(const fem::MaterialPoints &material, const fem::ElementExtent &extent)
    {
      return std::max(extent.mean_size, material.averaging_length());
    }

    template <int dim>
    fem::Vector at_rest(const fem::Solid<dim> &solid)
    {
      fem::Vector zero = solid.make_vector();
      zero.update_ghost_values();
      return zero;
    }

    MappedPoint map_point(const Averaging           &averaging,
                          const MappingLaw          &law,
                          const Eigen::Vector3d     &place,
                          const fem::MaterialPoints &material,
                          const fem::ElementExtent  &extent)
    {
      MappedPoint point{};
      point.place   = place;
      point.size    = extent.mean_size;
      point.average = averaging.at(place, own_size(material, extent));
      point.mapped  = map_damage(point.average.damage, law);
      return point;
    }

    fem::InitialPointState initial_state(const MappedPoint &point)
    {
      fem::InitialPointState given;
      if (point.average.particles == 0)
        return given; // virgin
      given.stress    = base::stress_voigt(point.average.stress);
      given.damage    = point.mapped.damage;
      given.hardening = point.mapped.hardening;
      return given;
    }

    void count_point(const MappedPoint &point, const TransferOptions &options, TransferCount &count)
    {
      ++count.points;
      if (point.average.particles == 0)
        {
          ++count.empty;
          return;
        }
      const bool local = options.averaging.kernel != Kernel::nearest && options.averaging.kernel != Kernel::specimen;
      count.sparse += local && point.average.particles < options.averaging.fewest;
      count.boundary += local && point.average.offset > one_sided && !point.average.linear;
      count.averaged += options.averaging.kernel == Kernel::moving_least_squares && !point.average.linear;
      count.damaged += point.mapped.damage > 0;
      count.fully_damaged += point.mapped.raw >= 1;
      const double to_switch = point.mapped.raw / options.law.switch_damage;
      count.at_switch += to_switch > 0.5 && to_switch < 2.0;
    }

    void sum_over_ranks(TransferReport &report, const MPI_Comm communicator)
    {
      const auto     add = [&](auto &value) { value = dealii::Utilities::MPI::sum(value, communicator); };
      TransferCount &c   = report.count;
      for (std::size_t *n : {&c.points, &c.elastic, &c.empty, &c.sparse, &c.boundary, &c.averaged, &c.damaged,
                             &c.fully_damaged, &c.at_switch, &c.returned, &c.outside})
        add(*n);
      add(report.integrals.volume_points);
      for (int i = 0; i < 9; ++i)
        {
          add(report.integrals.stress_points.data()[i]);
          add(report.integrals.damage_points.data()[i]);
        }
      report.largest_return = dealii::Utilities::MPI::max(report.largest_return, communicator);
    }

    void refuse_past(const char *what, const std::size_t found, const std::size_t of, const double limit)
    {
      if (static_cast<double>(found) <= limit * static_cast<double>(of))
        return;
      std::ostringstream message;
      message << "transfer: " << found << " of " << of << " integration points " << what
              << "; the scene allows a share of " << limit << '.';
      throw base::InputError(message.str());
    }

    void refuse_difference(const char *what, const double found, const double strength, const double limit)
    {
      if (found <= limit)
        return;
      std::ostringstream message;
      message << "transfer: " << what << " of points and particles differ by " << found
              << " of the larger of the stress there is and the tensile strength (" << strength
              << " Pa); the scene allows " << limit << '.';
      throw base::InputError(message.str());
    }

    void refuse_past_limits(const TransferReport &report, const TransferLimits &limits)
    {
      const TransferCount &count = report.count;
      if (count.points == 0)
        throw base::InputError(
          "transfer: no part of the solid has a history (all of it is elastic); nothing to transfer to.");
      refuse_past("have no particle within reach", count.empty, count.points, limits.empty);
      refuse_past("average fewer particles than required", count.sparse, count.points, limits.sparse);
      refuse_past("are fully damaged (omega at or past 1)", count.fully_damaged, count.points, limits.fully_damaged);
      std::ostringstream outside;
      outside << "have stresses so far outside the yield surface that more than a tenth of them is lost (up to "
              << report.largest_return << " Pa)";
      refuse_past(outside.str().c_str(), count.outside, count.points, limits.outside);
      refuse_difference("the mean stresses", report.integrals.stress_error(report.strength), report.strength,
                        limits.mean_stress);
      refuse_difference("the forces over a cut", report.cuts.force_error(report.strength), report.strength,
                        limits.cut_force);
    }

    void integrate_particles(const ParticleField &field, TransferIntegrals &integrals)
    {
      for (std::size_t i = 0; i < field.size(); ++i)
        {
          integrals.volume_particles += field.volume[i];
          integrals.stress_particles += field.volume[i] * field.stress[i];
          integrals.damage_particles += field.volume[i] * field.damage[i];
        }
    }

    /** What a transfer shows of a history. */
    void read_history(fem::MaterialPoints &material, const std::size_t index, MappedPoint &point)
    {
      using Role = fem::PointQuantity::Role;
      material.visit(index, [&point](const fem::PointQuantity &of, const double *value) {
        if (of.role == Role::damage_driving)
          point.damage_driving = *value;
        if (of.role == Role::hardening)
          point.hardening = *value;
      });
    }

  } // namespace

  template <int dim>
  TransferReport transfer(const ParticleField &field, const TransferOptions &options, fem::Solid<dim> &solid)
  {
    if (field.dimension != dim)
      throw base::InputError("transfer: particles in " + std::to_string(field.dimension) +
                             " dimensions to a solid in " + std::to_string(dim) + ".");
    options.law.validate();
    const Averaging averaging(field, options.averaging);
    TransferReport  report;
    report.strength = options.strength;
    integrate_particles(field, report.integrals);

    // Points are met element by element, as element_points() lists them.
    const fem::Vector rest    = at_rest(solid);
    const std::size_t per     = solid.quadrature().size();
    const auto       &owners  = solid.element_points();
    std::size_t       visited = 0;
    solid.visit_points(rest, [&](const fem::PointView<dim> &view) {
      const auto &owner = owners.at(visited++ / per);
      if (!view.material->takes_initial_state())
        {
          ++report.count.elastic;
          return;
        }
      MappedPoint point = map_point(averaging, options.law, place_of(view.place), *view.material, owner.extent);
      point.volume      = view.volume;
      view.material->set_initial(view.index, initial_state(point), owner.extent);
      read_history(*view.material, view.index, point);
      count_point(point, options, report.count);
      report.integrals.volume_points += point.volume;
      report.integrals.stress_points += point.volume * point.average.stress;
      report.integrals.damage_points += point.volume * point.average.damage;
      report.points.push_back(point);
    });

    std::size_t next = 0;
    solid.visit_points(rest, [&](const fem::PointView<dim> &view) {
      if (!view.material->takes_initial_state())
        return;
      MappedPoint          &point = report.points.at(next++);
      const Eigen::Matrix3d given = point.average.stress;
      point.returned              = (base::stress_tensor(view.stress) - given).norm();
      report.count.returned += point.returned > lost_by_rounding * given.norm();
      report.count.outside += point.returned > loss * std::max(given.norm(), options.strength);
      report.largest_return = std::max(report.largest_return, point.returned);
    });
    sum_over_ranks(report, solid.communicator());
    if (dealii::Utilities::MPI::n_mpi_processes(solid.communicator()) == 1)
      report.cuts = compare_cuts(field, report.points);
    refuse_past_limits(report, options.limits);
    return report;
  }

  template <int dim>
  Imbalance imbalance(fem::Solid<dim> &solid, const fem::StaticSolver<dim> &solver)
  {
    fem::Vector free = solver.external_force();
    free -= solver.internal_force();
    solid.constraints().set_zero(free);
    double squares = 0;
    solid.visit_points(solver.displacement(), [&squares](const fem::PointView<dim> &view) {
      const double force = base::stress_tensor(view.stress).norm() * std::pow(view.volume, 2.0 / 3.0);
      squares += force * force;
    });
    squares = dealii::Utilities::MPI::sum(squares, solid.communicator());
    Imbalance found;
    found.largest = free.linfty_norm();
    found.free    = free.l2_norm();
    found.at_hand = std::sqrt(squares);
    return found;
  }

  template <int dim>
  Equilibration equilibrate(fem::Solid<dim> &solid, fem::StaticSolver<dim> &solver, const TransferLimits &limits)
  {
    Equilibration done;
    done.before = imbalance(solid, solver);
    if (!(done.before.relative() <= limits.imbalance))
      {
        std::ostringstream message;
        message << "transfer: the mapped state is out of balance by " << done.before.relative()
                << " of the forces at hand (largest " << done.before.largest << " N); the scene allows "
                << limits.imbalance << '.';
        throw base::InputError(message.str());
      }
    const fem::StepReport report = solver.relax_to(solver.time());
    if (!report.converged)
      throw base::NumericalError("transfer: no equilibrium near the mapped state: " + report.reason);
    done.iterations        = report.iterations;
    done.relaxed           = report.relaxed;
    fem::StaticState state = solver.state();
    done.released          = -state.energy.internal;
    done.damped            = state.energy.damped;
    state.energy           = {}; // what the analysis accounts for begins here
    solver.restore(state);
    done.after                = imbalance(solid, solver);
    done.after.at_hand        = done.before.at_hand; // a body that relaxes has next to none left
    done.largest_displacement = solver.displacement().linfty_norm();
    return done;
  }

  template TransferReport transfer<2>(const ParticleField &, const TransferOptions &, fem::Solid<2> &);
  template TransferReport transfer<3>(const ParticleField &, const TransferOptions &, fem::Solid<3> &);
  template Imbalance      imbalance<2>(fem::Solid<2> &, const fem::StaticSolver<2> &);
  template Imbalance      imbalance<3>(fem::Solid<3> &, const fem::StaticSolver<3> &);
  template Equilibration  equilibrate<2>(fem::Solid<2> &, fem::StaticSolver<2> &, const TransferLimits &);
  template Equilibration  equilibrate<3>(fem::Solid<3> &, fem::StaticSolver<3> &, const TransferLimits &);
} // namespace coupling
