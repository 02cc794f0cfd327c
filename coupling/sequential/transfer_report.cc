#include "coupling/sequential/transfer_report.h"

#include <algorithm>

namespace coupling
{
  namespace
  {
    Eigen::Matrix3d mean(const Eigen::Matrix3d &integral, const double volume)
    {
      return volume > 0 ? Eigen::Matrix3d(integral / volume) : Eigen::Matrix3d::Zero();
    }

    double relative(const Eigen::Matrix3d &a, const Eigen::Matrix3d &b, const double least)
    {
      const double size = std::max({a.norm(), b.norm(), least});
      return size > 0 ? (a - b).norm() / size : 0;
    }
  } // namespace

  Eigen::Matrix3d TransferIntegrals::mean_stress_of_particles() const
  {
    return mean(stress_particles, volume_particles);
  }

  Eigen::Matrix3d TransferIntegrals::mean_stress_of_points() const { return mean(stress_points, volume_points); }

  double TransferIntegrals::stress_error(const double strength) const
  {
    return relative(mean_stress_of_particles(), mean_stress_of_points(), strength);
  }

  double TransferIntegrals::damage_error() const
  {
    return relative(mean(damage_particles, volume_particles), mean(damage_points, volume_points), 0);
  }
} // namespace coupling
