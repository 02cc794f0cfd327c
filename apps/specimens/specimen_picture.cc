#include "apps/specimens/specimen_picture.h"

#include "postprocess/pictures/picture_axes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

namespace apps
{
  double magnification(const dem::ParticleOutput &particles)
  {
    Eigen::AlignedBox3d box;
    std::vector<double> moved;
    for (std::size_t i = 0; i < particles.position.size(); ++i)
      {
        box.extend(particles.position[i] - particles.displacement[i]);
        moved.push_back(particles.displacement[i].norm());
      }
    const auto median = moved.begin() + static_cast<std::ptrdiff_t>(moved.size() / 2);
    std::nth_element(moved.begin(), median, moved.end());
    return postprocess::round_magnification(*median > 0 ? 0.05 * box.sizes().maxCoeff() / *median : 1);
  }
} // namespace apps
