#include "coupling/sequential/transfer_report.h"

#include <algorithm>

namespace coupling
{
  namespace
  {
    double mean_error(const Eigen::Matrix3d &a, const double volume_a, const Eigen::Matrix3d &b, const double volume_b)
    {
      if (!(volume_a > 0 && volume_b > 0))
        return 0;
      const Eigen::Matrix3d mean_a = a / volume_a, mean_b = b / volume_b;
      const double          size = std::max(mean_a.norm(), mean_b.norm());
      return size > 0 ? (mean_a - mean_b).norm() / size : 0;
    }
  } // namespace

  double TransferIntegrals::stress_error() const
  {
    return mean_error(stress_particles, volume_particles, stress_points, volume_points);
  }

  double TransferIntegrals::damage_error() const
  {
    return mean_error(damage_particles, volume_particles, damage_points, volume_points);
  }
} // namespace coupling
