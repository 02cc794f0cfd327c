#include "coupling/volume/rigid_couple.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

namespace coupling
{
  using Eigen::Index;
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  CarrierRows impulses_of_couple(const Vector3d    &couple,
                                 const CarrierRows &places,
                                 const CarrierRows &mass,
                                 const CarrierRows &inverse,
                                 const int          dimension)
  {
    const Index     rows   = places.rows();
    Eigen::VectorXd free   = Eigen::VectorXd::Zero(rows);
    Vector3d        centre = Vector3d::Zero();
    for (Index k = 0; k < rows; ++k)
      if ((inverse.row(k).head(dimension).array() > 0).all())
        {
          free[k] = mass(k, 0);
          centre += free[k] * places.row(k).transpose();
        }
    CarrierRows impulses = CarrierRows::Zero(rows, 3);
    if (!(free.sum() > 0))
      return impulses;
    centre /= free.sum();
    Matrix3d inertia = Matrix3d::Zero();
    for (Index k = 0; k < rows; ++k)
      {
        const Vector3d arm = places.row(k).transpose() - centre;
        inertia += free[k] * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
      }
    const Vector3d spin = inertia.completeOrthogonalDecomposition().solve(couple);
    for (Index k = 0; k < rows; ++k)
      impulses.row(k) = free[k] * spin.cross(places.row(k).transpose() - centre);
    return impulses;
  }
} // namespace coupling
