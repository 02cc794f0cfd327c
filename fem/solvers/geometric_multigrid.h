#pragma once

#include "fem/solvers/linear_solver.h"

namespace fem
{
  /**
   * Conjugate gradients without a matrix, preconditioned by geometric multigrid in single precision.
   *
   * Levels are the refinement levels of the mesh; each smooths by a Chebyshev polynomial of the Jacobi-scaled operator (Adams,
   * Brezina, Hu and Tuminaro 2003), the coarsest is answered by one cycle of algebraic multigrid.
   *
   * @param why said in the description. @param obstacle receives the reason where the method does not fit the solid.
   * @return nothing where there is an obstacle.
   */
  template <int dim>
  std::unique_ptr<LinearSolver> make_geometric_multigrid(const Solid<dim>          &solid,
                                                         const LinearSolverOptions &options,
                                                         const std::string         &why,
                                                         std::string               &obstacle);
}
