#include "dem/measures/stress.h"

#include "base/number_text.h"

#include <stdexcept>
#include <string>

namespace dem
{
  Eigen::Matrix3d stress_moment(const std::vector<LinkLoad> &links)
  {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const LinkLoad &link : links)
      sum += link.branch * link.force.transpose();
    return sum;
  }

  Eigen::Matrix3d stress_moment(const std::vector<ExternalLoad> &loads)
  {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const ExternalLoad &load : loads)
      sum += load.place * load.force.transpose();
    return sum;
  }

  Eigen::Matrix3d stress_of(const Eigen::Matrix3d &moment, const double volume)
  {
    if (!(volume > 0))
      throw std::invalid_argument("mean stress: volume = " + base::number_text(volume) + " m^3: must be above zero.");
    return moment / volume;
  }

  Eigen::Vector3d axial(const Eigen::Matrix3d &t) { return {t(1, 2) - t(2, 1), t(2, 0) - t(0, 2), t(0, 1) - t(1, 0)}; }
} // namespace dem
