#include "coupling/sequential/damage_observation.h"

#include <algorithm>
#include <cmath>

namespace coupling
{
  namespace
  {
    /** Thickness of a slab of equal weights with the same content as the kernel along one direction. */
    double thickness_of(const ParticleField &field, const AveragingOptions &averaging, const double element_size)
    {
      const double width = width_of(averaging, field, element_size);
      switch (averaging.kernel)
        {
        case Kernel::nearest:
          return 2 * field.mean_radius;
        case Kernel::ball:
          return 4.0 / 3.0 * width; // volume of a ball over its largest section
        default:
          return std::sqrt(2 * M_PI) * width;
        }
    }

    /** Volume mean of the damage tensors between two places along an axis; zero where there is nothing. */
    Eigen::Matrix3d mean_between(const ParticleField &field, const int axis, const double low, const double high)
    {
      Eigen::Matrix3d sum    = Eigen::Matrix3d::Zero();
      double          volume = 0;
      for (std::size_t i = 0; i < field.size(); ++i)
        if (field.place[i][axis] >= low && field.place[i][axis] <= high)
          {
            sum += field.volume[i] * field.damage[i];
            volume += field.volume[i];
          }
      return volume > 0 ? Eigen::Matrix3d(sum / volume) : sum;
    }
  } // namespace

  Eigen::Matrix3d observed_damage(const ParticleField    &field,
                                  const AveragingOptions &averaging,
                                  const int               axis,
                                  const double            element_size)
  {
    const auto along         = [axis](const Eigen::Vector3d &a, const Eigen::Vector3d &b) { return a[axis] < b[axis]; };
    const auto [first, last] = std::minmax_element(field.place.begin(), field.place.end(), along);
    const double low = (*first)[axis], high = (*last)[axis];
    const double thickness = thickness_of(field, averaging, element_size);
    if (averaging.kernel == Kernel::specimen || !(thickness < high - low))
      return mean_between(field, axis, low, high);

    constexpr double shift = 0.25; // of the thickness, from one slab to the next
    Eigen::Matrix3d  most  = mean_between(field, axis, low, low + thickness);
    const int        slabs = static_cast<int>(std::ceil((high - low - thickness) / (shift * thickness)));
    for (int s = 1; s <= slabs; ++s)
      {
        const double          from = std::min(low + s * shift * thickness, high - thickness);
        const Eigen::Matrix3d here = mean_between(field, axis, from, from + thickness);
        if (here.trace() > most.trace())
          most = here;
      }
    return most;
  }
} // namespace coupling
