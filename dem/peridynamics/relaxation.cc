#include "dem/peridynamics/relaxation.h"

#include "dem/peridynamics/fictitious_density.h"
#include "dem/peridynamics/ordered_sum.h"

#include <algorithm>
#include <cmath>

namespace dem::peridynamics
{
  namespace
  {
    constexpr std::size_t watched = 20; ///< steps
  }

  Relaxation::Relaxation(const Bonds &bonds, const Kinematics how, const FictitiousDensity kind)
    : kinematics(how)
    , bond_forces(bonds, how)
    , u(bonds.grid().field())
    , velocity(u)
    , force(u)
    , last_force(u)
    , external(u)
    , recent(watched, 1.0)
  {
    const bool gershgorin = kind == FictitiousDensity::gershgorin;
    density = gershgorin ? bound_of_stiffness(bonds) : base::Column(bonds.grid().places(), constant_bound(bonds));
    // A quarter of the largest sum of a row; directions of bonds turn in nonlinear kinematics.
    const double factor = 0.25 * (gershgorin && how == Kinematics::nonlinear ? 1.1 : 1.0);
    for (double &value : density)
      value *= factor;
  }

  void Relaxation::add_loads(const Loads &loads)
  {
    for (base::Column &column : external.c)
      std::fill(column.begin(), column.end(), 0.0);
    loads.forces(at, kinematics == Kinematics::nonlinear ? &u : nullptr, external);
  }

  void Relaxation::load(const Loads &loads, const double now)
  {
    at = now;
    add_loads(loads);
    loads.displacements(at, u);
    forget_damping();
    std::fill(recent.begin(), recent.end(), 1.0);
  }

  void Relaxation::step(const Bonds &bonds, const Loads &loads)
  {
    bond_forces.add_up(bonds, u, force);
    move(bonds.grid(), loads);
  }

  std::int64_t Relaxation::step_and_break(Bonds &bonds, const Loads &loads)
  {
    const std::int64_t broken = bond_forces.add_up_and_break(bonds, u, nullptr, force).broken;
    if (broken > 0)
      forget_damping();
    move(bonds.grid(), loads);
    return broken;
  }

  namespace
  {
    /** Sum over the components of a node. */
    template <typename Function>
    double over_components(const Grid &grid, Function &&f)
    {
      double sum = 0;
      for (std::size_t c = 0; c < static_cast<std::size_t>(grid.dimension()); ++c)
        sum += f(c);
      return sum;
    }

    double largest_length(const Grid &grid, const Field &f)
    {
      return std::sqrt(largest_of(grid, [&](const std::size_t i) {
        return over_components(grid, [&](const std::size_t c) { return f.c[c][i] * f.c[c][i]; });
      }));
    }
  } // namespace

  void Relaxation::find_force_density(const Grid &grid, const Loads &loads)
  {
    const base::Column &volume = grid.volume();
    const auto          free  = [&](const std::size_t i, const std::size_t c) { return (loads.held[i] >> c & 1) == 0; };
    const double        scale = ordered_sum(grid, [&](const std::size_t i) {
      if (volume[i] == 0)
        return 0.0;
      return over_components(grid, [&](const std::size_t c) {
        const double f = external.c[c][i] + (free(i, c) ? 0.0 : force.c[c][i]); // a load, or a reaction
        return f * f / volume[i];
      });
    });
    const double        unbalanced = ordered_sum(grid, [&](const std::size_t i) {
      return over_components(grid, [&](const std::size_t c) {
        double &f = force.c[c][i];
        f         = free(i, c) && volume[i] > 0 ? (f + external.c[c][i]) / volume[i] : 0.0;
        return volume[i] * f * f;
      });
    });
    left                           = scale > 0 ? std::sqrt(unbalanced / scale) : 0;
  }

  double Relaxation::damping(const Grid &grid, const Loads &loads) const
  {
    if (fresh != 0)
      return 0;
    const double numerator   = ordered_sum(grid, [&](const std::size_t i) {
      return over_components(grid, [&](const std::size_t c) {
        const double v = velocity.c[c][i];
        return v == 0 ? 0.0 : u.c[c][i] * u.c[c][i] * (last_force.c[c][i] - force.c[c][i]) / (density[i] * v);
      });
    });
    const double denominator = ordered_sum(grid, [&](const std::size_t i) {
      return over_components(grid,
                             [&](const std::size_t c) { return loads.held[i] >> c & 1 ? 0.0 : u.c[c][i] * u.c[c][i]; });
    });
    if (!(numerator > 0 && denominator > 0))
      return 0;
    const double critical = 2 * std::sqrt(numerator / denominator);
    return critical < 2 ? critical : 1.9;
  }

  void Relaxation::move(const Grid &grid, const Loads &loads)
  {
    if (kinematics == Kinematics::nonlinear)
      add_loads(loads);
    find_force_density(grid, loads);
    const double c_n   = damping(grid, loads);
    const bool   first = taken == 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(grid.dimension()); ++c)
#pragma omp parallel for schedule(static)
      for (std::ptrdiff_t n = 0; n < static_cast<std::ptrdiff_t>(u.c[c].size()); ++n)
        {
          const auto   i            = static_cast<std::size_t>(n);
          const double acceleration = force.c[c][i] / density[i];
          double      &v            = velocity.c[c][i];
          v                         = first ? 0.5 * acceleration : ((2 - c_n) * v + 2 * acceleration) / (2 + c_n);
          u.c[c][i] += v;
        }
    last_force.c.swap(force.c);
    const double largest                              = largest_length(grid, u);
    recent[static_cast<std::size_t>(taken) % watched] = largest > 0 ? largest_length(grid, velocity) / largest : 0;
    ++taken;
    fresh = 0;
  }

  bool Relaxation::at_rest(const double tolerance) const
  {
    return left <= tolerance && *std::max_element(recent.begin(), recent.end()) <= std::min(1e-9, 1e-3 * tolerance);
  }

  void Relaxation::visit_state(base::StateVisitor &visitor)
  {
    for (std::size_t c = 0; c < 3; ++c)
      {
        const std::string axis(1, "xyz"[c]);
        visitor.column("displacement_" + axis, u.c[c]);
        visitor.column("velocity_" + axis, velocity.c[c]);
        visitor.column("last_force_" + axis, last_force.c[c]);
        visitor.column("external_" + axis, external.c[c]);
      }
    visitor.column("recent", recent);
    visitor.scalar("at", at);
    visitor.scalar("residual", left);
    visitor.scalar("steps", taken);
    visitor.scalar("fresh", fresh);
  }
} // namespace dem::peridynamics
