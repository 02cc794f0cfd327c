#pragma once

#include "dem/linear/iterations.h"
#include "dem/linear/solver_method.h"
#include "dem/linear/sparse_factor.h"
#include "dem/network/mechanisms.h"

#include <string>
#include <vector>

namespace dem
{
  /**
   * Automatic: iterate, and factorise if that is predicted to cost less than going on. Iterative: conjugate gradients, preconditioned by the
   * particles' own blocks, and for many particles by rigid motions of groups too (RigidGroups). Direct: a sparse Cholesky factor, refined by iteration.
   */
  struct SolverParameters
  {
    SolverMethod method         = SolverMethod::automatic;
    double       tolerance      = 1e-10; ///< unbalanced force over link forces, both as root of the sum of squares
    int          max_iterations = 20000; ///< of the iterative method
    double       memory_limit = 4.0 * (1ull << 30); ///< of the factor [bytes]; a larger one is not tried automatically
    Ranks       *ranks = nullptr; ///< that share the iteration, all of them solving the same; none: this process alone
  };

  /** How a linear static problem was solved. */
  struct SolverReport
  {
    SolverMethod           method     = SolverMethod::iterative; ///< that gave the answer
    bool                   converged  = false;
    int                    iterations = 0; ///< of all methods tried
    double                 residual   = 0; ///< largest of all load cases
    double                 operations = 0; ///< predicted, multiplications and additions
    FactorCost             factor;         ///< zero where none was analysed
    std::vector<Mechanism> mechanisms;

    /** One sentence: method, iterations, residual. */
    std::string text() const;
  };

  /**
   * Solve K x = -(forces of the macroscopic strains) + b in the load lanes, and find mechanisms in the probe lanes.
   *
   * The choice between the methods depends on operation counts only, never on the clock: the same input gives the same bits.
   *
   * @param b          [N] in lanes below first_probe, may be empty: no other load
   * @param x          in: prescribed values in held motions, a start elsewhere; out: the solution [m]; probe lanes: scratch
   * @param strain     of the load lanes
   * @param translates see find_mechanisms()
   * @return with `converged`: whether the tolerance was reached
   */
  SolverReport solve_linear(const StiffnessOperator &stiffness,
                            const Fields            &b,
                            Fields                  &x,
                            const LaneStrains       &strain,
                            bool                     translates,
                            const SolverParameters  &parameters);
} // namespace dem
