#include "dem/emission/moment_tensor.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace dem
{
  double scalar_moment(const Eigen::Matrix3d &moment) { return moment.norm() / std::sqrt(2.0); }

  double moment_magnitude(const double scalar_moment) { return (std::log10(scalar_moment) - 9.1) / 1.5; }

  std::vector<double> magnitudes_of(const std::vector<EmissionEvent> &events)
  {
    std::vector<double> found;
    for (const EmissionEvent &event : events)
      if (!event.moment.isZero(0))
        found.push_back(moment_magnitude(scalar_moment(event.moment)));
    return found;
  }

  double isotropic_share(const Eigen::Matrix3d &moment)
  {
    const double          trace    = moment.trace();
    const Eigen::Matrix3d deviator = moment - trace / 3 * Eigen::Matrix3d::Identity();
    const double          all =
      std::abs(trace) +
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(deviator, Eigen::EigenvaluesOnly).eigenvalues().lpNorm<1>();
    return all > 0 ? trace / all : 0.0;
  }
} // namespace dem
