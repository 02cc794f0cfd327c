#include "dem/measures/link_directions.h"

#include "dem/measures/fabric.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dem
{
  DirectionStatistics direction_statistics(const std::vector<Eigen::Vector3d> &directions)
  {
    DirectionStatistics s;
    s.links      = directions.size();
    s.density    = 15.0 / 2.0 * (fabric(directions).second - Eigen::Matrix3d::Identity() / 3.0);
    s.anisotropy = std::sqrt(3.0 / 2.0) * s.density.norm();
    // Of one direction |n n - 1/3|^2 = 2/3; of the mean of N independent ones 2/(3 N).
    s.by_chance = 15.0 / 2.0 * std::sqrt(3.0 / 2.0 * 2.0 / 3.0 / static_cast<double>(s.links));
    return s;
  }

  AzimuthHistogram azimuth_histogram(const std::vector<Eigen::Vector3d> &directions,
                                     const int                           axis,
                                     const int                           bins,
                                     const double                        steepest)
  {
    if (axis < 0 || axis > 2 || bins < 2)
      throw std::invalid_argument("azimuth histogram: the axis is 0, 1 or 2, and there are at least 2 bins.");
    AzimuthHistogram h;
    h.count.assign(bins, 0);
    for (const Eigen::Vector3d &n : directions)
      {
        if (std::abs(n[axis]) > steepest)
          continue;
        const double angle = std::atan2(n[(axis + 2) % 3], n[(axis + 1) % 3]); // of n or -n: modulo pi
        const double part  = angle / M_PI - std::floor(angle / M_PI);
        ++h.count[std::min(bins - 1, static_cast<int>(part * bins))];
      }
    double sum = 0, squares = 0;
    for (const std::int64_t c : h.count)
      sum += static_cast<double>(c);
    h.mean = sum / bins;
    for (const std::int64_t c : h.count)
      squares += (static_cast<double>(c) - h.mean) * (static_cast<double>(c) - h.mean);
    h.deviation                    = std::sqrt(squares / (bins - 1));
    const auto [smallest, largest] = std::minmax_element(h.count.begin(), h.count.end());
    h.least                        = *smallest;
    h.most                         = *largest;
    return h;
  }
} // namespace dem
