#include "dem/peridynamics/equilibrium.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>

namespace dem::peridynamics
{
  LargestStretch largest_stretch(const Bonds &bonds, const BondForces &forces, const Field &u)
  {
    LargestStretch found;
    bonds.each([&](const std::size_t bond, const std::size_t o, const std::size_t i, const std::size_t j) {
      if (bonds.stiffness()[bond] == 0)
        return;
      const double s = forces.stretch(bonds, o, i, j, u);
      found.value    = std::max(found.value, s);
      found.of_limit = std::max(found.of_limit, s / bonds.limit_of(bond));
    });
    return found;
  }

  std::int64_t break_stretched(Bonds &bonds, const BondForces &forces, const Field &u, const double part)
  {
    const double             enough = std::max(1.0, part * largest_stretch(bonds, forces, u).of_limit);
    std::int64_t             n      = 0;
    std::vector<std::size_t> gone;
    bonds.each([&](const std::size_t bond, const std::size_t o, const std::size_t i, const std::size_t j) {
      if (bonds.stiffness()[bond] != 0 && forces.stretch(bonds, o, i, j, u) / bonds.limit_of(bond) >= enough)
        gone.push_back(bond);
    });
    for (const std::size_t bond : gone)
      {
        bonds.break_bond(bond);
        ++n;
      }
    return n;
  }

  Equilibrium::Equilibrium(const Bonds &bonds, const Kinematics how, const Solver solver)
    : kinematics(how)
    , bond_forces(bonds, how)
    , stiffness(solver)
  {
  }

  namespace
  {
    /** Root of the sum of squares over the components that are, or are not, in the list. */
    double norm(const Grid &grid, const Field &f, const Held &held, const bool of_held)
    {
      double sum = 0;
      for (const std::size_t i : grid.nodes())
        for (std::size_t c = 0; c < static_cast<std::size_t>(grid.dimension()); ++c)
          if ((held[i] >> c & 1) == (of_held ? 1 : 0))
            sum += f.c[c][i] * f.c[c][i];
      return std::sqrt(sum);
    }
    /** No equilibrium was found though every piece is held. @throws base::NumericalError of a body whose bonds are whole */
    void refuse_mechanism(const Bonds &bonds, const double at, Equilibrium::State &state)
    {
      if (bonds.broken() == 0)
        throw base::NumericalError("peridynamics: no equilibrium at the load factor " + base::number_text(at) +
                                   ", the residual stays at " + base::number_text(state.residual) +
                                   ": the body is a mechanism, or not stable. Enlarge the horizon, hold more of it, or "
                                   "load it in smaller increments.");
      state.loose = state.mechanism = true;
    }
  } // namespace

  Equilibrium::State
  Equilibrium::find(const Bonds &bonds, const Loads &loads, const double at, const double tolerance, Field &u)
  {
    constexpr int most     = 50;
    const Grid   &grid     = bonds.grid();
    const bool    turns    = kinematics == Kinematics::nonlinear;
    Field         external = grid.field(), internal = grid.field(), step = grid.field();
    loads.forces(at, turns ? &u : nullptr, external);
    const RigidMotions rigid = hold_rigid_motions(bonds, loads.held, external);
    State              state;
    state.imbalance = rigid.imbalance;
    // Tractions keep their directions while the body turns: a small moment out of balance comes with nonlinear kinematics.
    if (rigid.imbalance > (turns ? 0.05 : std::max(1e-10, tolerance)))
      {
        state.loose = true;
        return state;
      }
    loads.displacements(at, u);
    bool found = true;
    for (;; ++state.solutions)
      {
        if (turns)
          {
            external = grid.field();
            loads.forces(at, &u, external);
          }
        bond_forces.add_up(bonds, u, internal);
        Field rest = external;
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t i = 0; i < rest.c[c].size(); ++i)
            rest.c[c][i] += internal.c[c][i];
        const double scale = std::max(norm(grid, external, rigid.held, false), norm(grid, rest, loads.held, true));
        const double left  = norm(grid, rest, rigid.held, false);
        state.residual     = scale > 0 ? left / scale : 0;
        if (left <= tolerance * scale)
          return state;
        const bool lost = state.solutions == most || !std::isfinite(left);
        if (!lost && (turns || state.solutions == 0))
          found = stiffness.assemble(bonds, kinematics, rigid.held, u);
        if (lost || !found || !stiffness.solve(rest, std::max(0.1 * tolerance, 1e-13), step))
          {
            refuse_mechanism(bonds, at, state);
            return state;
          }
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t i = 0; i < step.c[c].size(); ++i)
            u.c[c][i] += step.c[c][i];
      }
  }
} // namespace dem::peridynamics
