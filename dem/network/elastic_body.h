#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace dem
{
  /**
   * An elastic body that a network is joined to, seen from the places where it is: what remains of a solid when all its other motions are
   * in equilibrium. Displacements x of its joints and the driven load parameter p cost
   *
   *   Pi = 1/2 x^T S x + p x^T b + 1/2 c p^2
   *
   * which is the energy stored less what dead loads p (w^T x + p w_0) have done (doc/theory/static-handshake.md, 1).
   */
  struct ElasticBody
  {
    Eigen::SparseMatrix<double> stiffness; ///< S, three displacements of each joint, symmetric [N/m]
    int                         load = 0;  ///< load parameter p
    Eigen::VectorXd by_load;      ///< b: force that holds the joints where they are, per unit of the parameter [N]
    double          of_load = 0;  ///< c [J]
    Eigen::VectorXd load_work;    ///< w [N]
    double          own_work = 0; ///< w_0 [J]

    Eigen::Index joints() const { return stiffness.rows() / 3; }

    /** Work that dead loads have done in all [J]. */
    double work_of_loads(const Eigen::VectorXd &x, const double p) const
    {
      return p * (load_work.dot(x) + p * own_work);
    }
    /** Energy stored [J]. */
    double stored(const Eigen::VectorXd &x, const double p) const
    {
      return x.dot(0.5 * (stiffness * x) + p * by_load) + 0.5 * of_load * p * p + work_of_loads(x, p);
    }
  };
} // namespace dem
