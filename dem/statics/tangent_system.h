#pragma once

#include "dem/statics/loaded_network.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace dem
{
  /**
   * The linearised equilibrium of a loaded network with links of any stiffness (unsymmetric, indefinite): sparse LU (UMFPACK) of
   * the particles' own motions, solved for what is unbalanced and for each load parameter.
   *
   * To the diagonal 1e-9 of the undamaged one is added, so that particles that nothing holds do not stop it. This changes the
   * way to equilibrium, never the equilibrium: residuals are those of the links themselves.
   */
  class TangentSystem
  {
  public:
    explicit TangentSystem(const LoadedNetwork &loaded);
    ~TangentSystem();

    /** Length that turns rotations into displacements and moments into forces [m]. */
    double length_scale() const;

    /** How the network answers to first order; every particle motion is affine in the step of the led parameter. */
    struct Answer
    {
      LoadedMotion constant; ///< balances what is unbalanced, the led parameter staying where it is
      LoadedMotion per_step; ///< change per unit of the led parameter; its own entry is 1
    };

    /**
     * Free parameters move so that their forces vanish.
     * @param stiffness of each link, force and moment per slip and relative rotation [N/m], [N m]
     * @return false if the linearisation is singular
     */
    bool solve(const std::vector<Matrix6> &stiffness, const Unbalanced &unbalanced, Answer &answer);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> self;
  };
} // namespace dem
