#pragma once

#include "dem/peridynamics/bond_forces.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace dem::peridynamics
{
  /**
   * Stiffness of all bonds in linear kinematics, as what it does to displacements: no matrix is stored, a product is one pass over the
   * bonds. Vectors have one number per free component, by place and then by axis.
   */
  class BondOperator
  {
  public:
    /** @param bonds must outlive it @param free by place and axis: whether the component is an unknown */
    BondOperator(const Bonds &bonds, const std::vector<bool> &free);

    Eigen::Index cols() const { return diagonal.size(); } ///< unknowns

    /** K x. */
    Eigen::VectorXd operator*(const Eigen::VectorXd &x) const;

    /**
     * Conjugate gradients, preconditioned by the diagonal.
     * @param tolerance of the residual over b
     * @return residual over b that is left
     */
    double solve(const Eigen::VectorXd &b, double tolerance, int most_iterations, Eigen::VectorXd &x) const;

  private:
    struct Unknown
    {
      std::size_t place, axis;
    };

    void find_diagonal();

    const Bonds         *bonds;
    mutable BondForces   forces; // work space of a product
    mutable Field        u, f;
    std::vector<Unknown> at;
    Eigen::VectorXd      diagonal, spring; ///< spring: of what no bond holds
  };
} // namespace dem::peridynamics
