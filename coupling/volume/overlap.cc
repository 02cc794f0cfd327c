#include "coupling/volume/overlap.h"

#include <algorithm>
#include <limits>

namespace coupling
{
  using Eigen::Vector3d;

  bool Overlap::contains(const Vector3d &place) const
  {
    const double d = distance(place), rounding = 1e-9 * (width + place.cwiseAbs().maxCoeff());
    return d >= -rounding && d <= width + rounding;
  }

  double Overlap::of_solid(const Vector3d &place) const
  {
    const double d = distance(place);
    return d >= width ? 1.0 : std::clamp(d / width, least, 1 - least);
  }

  double Overlap::of_particles(const Vector3d &place) const
  {
    const double d = distance(place);
    return d <= 0 ? 1.0 : std::max(1 - d / width, least);
  }

  std::function<double(const Vector3d &)> distance_from_box(const Vector3d &low, const Vector3d &high)
  {
    return [=](const Vector3d &place) {
      double furthest = -std::numeric_limits<double>::infinity();
      for (int c = 0; c < 3; ++c)
        furthest = std::max({furthest, low[c] - place[c], place[c] - high[c]});
      return furthest;
    };
  }

  std::function<double(const Vector3d &)> distance_from_ball(const Vector3d &centre, const double radius)
  {
    return [=](const Vector3d &place) { return (place - centre).norm() - radius; };
  }
} // namespace coupling
