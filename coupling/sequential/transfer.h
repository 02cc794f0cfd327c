#pragma once

#include "coupling/sequential/transfer_report.h"
#include "fem/solvers/static_solver.h"

namespace coupling
{
  /**
   * Give every integration point with a history the state that the particles around it had (doc/theory/sequential-transfer.md): stress and
   * damage tensor by averaging, omega and kappa_P by the mapping law, kappa_D by inverting the damage law with the point's element
   * size, and the plastic strain that keeps the stress at zero strain.
   *
   * Call it before a solver is made for the solid. @throws base::InputError past a limit; base::InputError for mismatched
   * dimensions
   */
  template <int dim>
  TransferReport transfer(const ParticleField &field, const TransferOptions &options, fem::Solid<dim> &solid);

  /** Of the free displacements, at the solver's present state. */
  template <int dim>
  Imbalance imbalance(fem::Solid<dim> &solid, const fem::StaticSolver<dim> &solver);

  /**
   * Bring the transferred state into equilibrium under the supports and loads of time zero.
   * @throws base::InputError past the limit of imbalance; base::NumericalError if there is no equilibrium near
   */
  template <int dim>
  Equilibration equilibrate(fem::Solid<dim> &solid, fem::StaticSolver<dim> &solver, const TransferLimits &limits);
} // namespace coupling
