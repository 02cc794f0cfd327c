#pragma once

#include "base/state.h"
#include "dem/linear/solver_method.h"
#include "dem/network/loaded_network.h"
#include "dem/ranks/ranks.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace dem
{
  /** How the linear systems of a path are solved. */
  struct TangentSolver
  {
    /** Automatic: iterative where ranks share the work, or in space from 30 000 unknowns on. */
    SolverMethod method = SolverMethod::direct;
    Ranks       *ranks  = nullptr; ///< that share an iteration, all of them solving the same; none: this process alone
    double       negligible = 0;   ///< Unbalanced::residual that an iteration may leave
  };

  /**
   * The linearised equilibrium of a loaded network with links of any stiffness (unsymmetric, indefinite): sparse LU (UMFPACK) of
   * the particles' own motions, or an iteration (SharedTangent), for what is unbalanced and for each load parameter.
   *
   * To the diagonal 1e-9 of the undamaged one is added, so that particles that nothing holds do not stop it. This changes the
   * way to equilibrium, never the equilibrium: residuals are those of the links themselves.
   */
  class TangentSystem
  {
  public:
    /** @param loaded must outlive this object */
    explicit TangentSystem(const LoadedNetwork &loaded, const TangentSolver &solver = {});
    ~TangentSystem();

    bool iterates() const { return by_iteration; }

    /** Length that turns rotations into displacements and moments into forces [m]. */
    double length_scale() const;

    /** How the network answers to first order; every particle motion is affine in the step of the driven parameter. */
    struct Answer
    {
      LoadedMotion constant; ///< balances what is unbalanced, the driven parameter staying where it is
      LoadedMotion per_step; ///< change per unit of the driven parameter; its own entry is 1
    };

    /**
     * Free parameters move so that their forces vanish.
     * @param stiffness of each link, force and moment per slip and relative rotation [N/m], [N m]
     * @return false if the linearisation is singular, or an iteration does not come to an end
     */
    bool solve(const std::vector<base::Matrix6> &stiffness, const Unbalanced &unbalanced, Answer &answer);

    /**
     * The same, all parameters given and by a factor: what balances the particles while the parameters change.
     * @param change of each parameter; also in `correction`
     */
    bool solve_driven(const std::vector<base::Matrix6> &stiffness,
                      const Unbalanced                 &unbalanced,
                      const base::Vector6              &change,
                      LoadedMotion                     &correction);

    /**
     * Stiffness of the whole network to its parameters, particles in equilibrium: change of each parameter's force per unit of each
     * [J], by a factor, without the addition to the diagonal. In the plane, and of parameters that move nothing, rows and columns are zero.
     */
    bool condense(const std::vector<base::Matrix6> &stiffness, base::Matrix6 &forces);

    /**
     * Whether every motion of the undamaged network costs energy, so that its equilibrium is stable. By a Cholesky factor, also where systems
     * are iterated. @pre ties are led: without multipliers
     */
    bool is_positive();

    /** Where an iteration starts next; nothing for a factor. */
    void visit_state(base::StateVisitor &visitor);

  private:
    struct Implementation;
    Implementation &made(); ///< laid out and ordered when first needed, by one thread after the other

    const LoadedNetwork            &loaded;
    TangentSolver                   solver;
    bool                            by_iteration;
    std::unique_ptr<Implementation> self;
  };
} // namespace dem
