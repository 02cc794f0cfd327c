#pragma once

#include "dem/measures/link_measures.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"

#include <Eigen/Dense>

#include <cmath>

/** Stiffness and mass of a bonded body as dense matrices, six unknowns per particle (translation, rotation). */
namespace dense
{
  /** One link between particles J and K: a branch, the distance from J to the contact point, and D = n n k_N + (1 - n n) k_T. */
  struct Spring
  {
    std::size_t     J, K;
    Eigen::Vector3d branch;
    double          first_arm, k_N, k_T;
  };

  /** Add a link's energy 1/2 s.D s of the slip s = u_K - u_J + n x (d_J theta_J + d_K theta_K). */
  inline void add(Eigen::MatrixXd &stiffness, const Spring &c)
  {
    using Eigen::Matrix3d;
    const double          L = c.branch.norm();
    const Eigen::Vector3d n = c.branch / L;
    Matrix3d              across;
    across << 0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0;
    Eigen::MatrixXd slip             = Eigen::MatrixXd::Zero(3, stiffness.rows());
    slip.block<3, 3>(0, 6 * c.J)     = -Matrix3d::Identity();
    slip.block<3, 3>(0, 6 * c.K)     = Matrix3d::Identity();
    slip.block<3, 3>(0, 6 * c.J + 3) = c.first_arm * across;
    slip.block<3, 3>(0, 6 * c.K + 3) = (L - c.first_arm) * across;
    const Matrix3d D                 = c.k_T * Matrix3d::Identity() + (c.k_N - c.k_T) * n * n.transpose();
    stiffness += slip.transpose() * D * slip;
  }

  /** Critical step 2/sqrt(largest eigenvalue) of the links of a set, from the dense generalised eigenvalue problem. */
  inline double critical_step(const dem::Particles &particles,
                              const dem::LinkSet   &links,
                              const dem::LinkLaw   &law,
                              const bool            rotations)
  {
    const auto      n         = static_cast<Eigen::Index>(particles.count);
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(6 * n, 6 * n);
    dem::LinkReader reader(particles, links, law);
    for (std::size_t l = 0; l < links.count; ++l)
      {
        reader.read(l, dem::Geometry::present);
        const dem::LinkStiffnesses moduli = reader.stiffness();
        Spring                     c;
        c.J            = static_cast<std::size_t>(links.first[l]);
        c.K            = static_cast<std::size_t>(links.second[l]);
        c.branch       = particles.position_of(c.K) - particles.position_of(c.J);
        const double L = c.branch.norm();
        c.first_arm    = particles.radius_of(c.J) + 0.5 * (L - particles.radius_of(c.J) - particles.radius_of(c.K));
        c.k_N          = moduli.normal * links.area[l] / links.reference_length[l];
        c.k_T          = moduli.shear * links.area[l] / links.reference_length[l];
        add(stiffness, c);
      }
    Eigen::VectorXd scale(6 * n);
    for (Eigen::Index i = 0; i < n; ++i)
      {
        const auto p = static_cast<std::size_t>(i);
        scale.segment<3>(6 * i).setConstant(1 / std::sqrt(particles.mass[p]));
        scale.segment<3>(6 * i + 3).setConstant(rotations ? 1 / std::sqrt(particles.inertia[p]) : 0.0);
      }
    const Eigen::MatrixXd                                scaled = scale.asDiagonal() * stiffness * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
    return 2 / std::sqrt(solver.eigenvalues().maxCoeff());
  }
} // namespace dense
