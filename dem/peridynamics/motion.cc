#include "dem/peridynamics/motion.h"

#include "dem/peridynamics/fictitious_density.h"
#include "dem/peridynamics/ordered_sum.h"

#include <algorithm>
#include <cmath>

namespace dem::peridynamics
{
  double Energies::largest() const
  {
    return std::max({std::abs(kinetic), std::abs(strain), std::abs(repulsion), std::abs(released), std::abs(external),
                     std::abs(initial)});
  }

  double Motion::stable_step(const Bonds &bonds, const double repulsion)
  {
    const Grid        &grid  = bonds.grid();
    const base::Column bound = bound_of_stiffness(bonds), mass = bonds.masses();
    const double       contacts = repulsion > 0 ? Repulsion::bound_of_stiffness(bonds, repulsion) : 0;
    return 2 / std::sqrt(largest_of(
                 grid, [&](const std::size_t i) { return (bound[i] * grid.volume()[i] + contacts) / mass[i]; }));
  }

  namespace
  {
    template <typename Function>
    void each_component(const Field &field, Function &&f)
    {
      for (std::size_t c = 0; c < 3; ++c)
#pragma omp parallel for schedule(static)
        for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(field.c[c].size()); ++i)
          f(c, static_cast<std::size_t>(i));
    }
  } // namespace

  Motion::Motion(Bonds &bonds, const Loads &loads, const Kinematics how, const Field &velocity, const double step)
    : kinematics(how)
    , bond_forces(bonds, how)
    , length(step)
    , last_length(step)
    , mass(bonds.masses())
    , u(bonds.grid().field())
    , v(velocity)
    , force(u)
    , external(u)
    , last_step(u)
    , pushed(3, 0.0)
  {
    loads.displacements(0.0, u);
    find_forces(bonds, loads, true);
    // Half a step back, that the velocity at the start is the given one.
    each_component(v, [&](const std::size_t c, const std::size_t i) {
      if ((loads.held[i] >> c & 1) == 0 && mass[i] > 0)
        v.c[c][i] -= 0.5 * length * (force.c[c][i] + external.c[c][i]) / mass[i];
    });
    find_external(loads);
    const Eigen::Vector3d p = momentum(bonds);
    std::copy(p.data(), p.data() + 3, pushed.begin());
    const Energies e = energies(bonds);
    start            = e.kinetic + e.strain - e.external;
  }

  void Motion::find_forces(Bonds &bonds, const Loads &loads, const bool first)
  {
    if (bonds.breaks())
      {
        const BondAccount account = bond_forces.add_up_and_break(bonds, u, first ? nullptr : &last_step, force);
        gone += account.broken;
        released += first ? 0.0 : account.released;
      }
    else
      bond_forces.add_up(bonds, u, force);
    if (repulsion)
      repulsion->add_up(bonds, u, force);
    find_external(loads);
  }

  void Motion::find_external(const Loads &loads)
  {
    each_component(external, [&](const std::size_t c, const std::size_t i) { external.c[c][i] = 0; });
    loads.forces(time(), kinematics == Kinematics::nonlinear ? &u : nullptr, external);
    if (std::none_of(loads.held.begin(), loads.held.end(), [](const std::uint8_t h) { return h != 0; }))
      return;
    Field ahead = u;
    loads.displacements(time() + length, ahead);
    each_component(external, [&](const std::size_t c, const std::size_t i) {
      if (loads.held[i] >> c & 1)
        external.c[c][i] = mass[i] * ((ahead.c[c][i] - u.c[c][i]) / length - v.c[c][i]) / kick() - force.c[c][i];
    });
  }

  double Motion::power(const Bonds &bonds) const
  {
    return ordered_sum(bonds.grid(), [&](const std::size_t i) {
      double sum = 0;
      for (std::size_t c = 0; c < static_cast<std::size_t>(bonds.grid().dimension()); ++c)
        sum += external.c[c][i] * v.c[c][i];
      return sum;
    });
  }

  void Motion::step(Bonds &bonds, const Loads &loads)
  {
    const double acting = kick();
    for (std::size_t c = 0; c < static_cast<std::size_t>(bonds.grid().dimension()); ++c)
      pushed[c] += acting * ordered_sum(bonds.grid(), [&](const std::size_t i) { return external.c[c][i]; });
    work += 0.5 * acting * power(bonds);
    each_component(v, [&](const std::size_t c, const std::size_t i) {
      if (mass[i] > 0)
        v.c[c][i] += acting * (force.c[c][i] + external.c[c][i]) / mass[i];
      last_step.c[c][i] = length * v.c[c][i];
      u.c[c][i] += last_step.c[c][i];
    });
    work += 0.5 * acting * power(bonds);
    ++taken;
    now += length;
    last_length = length;
    loads.displacements(time(), u); // to the last bit
    find_forces(bonds, loads, false);
  }

  Eigen::Vector3d Motion::velocity_ahead(const std::size_t place) const
  {
    return mass[place] > 0 ?
             Eigen::Vector3d(v.at(place) + kick() / mass[place] * (force.at(place) + external.at(place))) :
             v.at(place);
  }

  void Motion::change_velocity(const std::size_t place, const Eigen::Vector3d &by, const Loads &loads)
  {
    for (std::size_t c = 0; c < 3 && !v.c[c].empty(); ++c)
      {
        const double change = by[static_cast<Eigen::Index>(c)];
        if (loads.held[place] >> c & 1 || mass[place] == 0)
          continue;
        // So much more is the kinetic energy with the velocities half a step before and after, less the loads' own work.
        work += change * (mass[place] * (v.c[c][place] + 0.5 * change) + 0.5 * kick() * force.c[c][place]);
        v.c[c][place] += change;
        pushed[c] += mass[place] * change;
      }
  }

  Energies Motion::energies(const Bonds &bonds)
  {
    Energies e;
    e.kinetic   = ordered_sum(bonds.grid(), [&](const std::size_t i) {
      double sum = 0;
      for (std::size_t c = 0; c < static_cast<std::size_t>(bonds.grid().dimension()); ++c)
        sum += 0.5 * v.c[c][i] * (mass[i] * v.c[c][i] + kick() * (force.c[c][i] + external.c[c][i]));
      return sum;
    });
    e.strain    = bond_forces.energy(bonds, u);
    e.repulsion = repulsion ? repulsion->energy() : 0;
    e.released  = released;
    e.external  = work + 0.5 * kick() * power(bonds);
    e.initial   = start;
    return e;
  }

  Eigen::Vector3d Motion::momentum(const Bonds &bonds) const
  {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (std::size_t c = 0; c < static_cast<std::size_t>(bonds.grid().dimension()); ++c)
      p[static_cast<Eigen::Index>(c)] =
        ordered_sum(bonds.grid(), [&](const std::size_t i) { return mass[i] * v.c[c][i]; });
    return p;
  }

  void Motion::visit_state(base::StateVisitor &visitor)
  {
    for (std::size_t c = 0; c < 3; ++c)
      {
        const std::string axis(1, "xyz"[c]);
        visitor.column("displacement_" + axis, u.c[c]);
        visitor.column("velocity_" + axis, v.c[c]);
        visitor.column("force_" + axis, force.c[c]);
        visitor.column("external_" + axis, external.c[c]);
      }
    visitor.column("impulse", pushed);
    visitor.scalar("released", released);
    visitor.scalar("work", work);
    visitor.scalar("start_energy", start);
    visitor.scalar("broken", gone);
    visitor.scalar("steps", taken);
    visitor.scalar("time", now);
    visitor.scalar("step_length", length);
    visitor.scalar("last_step_length", last_length);
    if (repulsion)
      repulsion->visit_state(visitor);
  }
} // namespace dem::peridynamics
