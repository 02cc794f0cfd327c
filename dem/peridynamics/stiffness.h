#pragma once

#include "dem/peridynamics/bond_forces.h"
#include "dem/peridynamics/supports.h"

#include <memory>
#include <string>

namespace dem::peridynamics
{
  enum class Solver
  {
    direct,   ///< sparse Cholesky factor, refined by conjugate gradients
    iterative ///< conjugate gradients, preconditioned by the diagonal; without a matrix in linear kinematics
  };

  /** Tangent stiffness of all bonds, and the solution of its equations. */
  class Stiffness
  {
  public:
    explicit Stiffness(Solver solver);
    ~Stiffness();

    /**
     * Of the body as deformed.
     * @param bonds must outlive the solutions
     * @param held components that stay where they are
     * @return whether there is a factor, where one is requested: none of a body far from stable
     */
    bool assemble(const Bonds &bonds, Kinematics kinematics, const Held &held, const Field &u);

    /**
     * Solve K du = r in the components that are free; zero in the others.
     * @param tolerance of the residual over r
     * @return false where there is none: a mechanism of nearly broken nodes is loaded. True also where it only comes nearer than a
     * thousandth, as beside mechanisms that are not: see the residual
     */
    bool solve(const Field &r, double tolerance, Field &du) const;

    std::size_t unknowns() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> self;
    Solver                          solver;
  };
} // namespace dem::peridynamics
