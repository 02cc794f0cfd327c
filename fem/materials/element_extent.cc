#include "fem/materials/element_extent.h"

#include <algorithm>

namespace fem
{
  double ElementExtent::along(const Eigen::Vector3d &direction) const noexcept
  {
    if (n_vertices == 0)
      return mean_size;
    double low = direction.dot(vertices[0]), high = low;
    for (unsigned int v = 1; v < n_vertices; ++v)
      {
        const double x = direction.dot(vertices[v]);
        low            = std::min(low, x);
        high           = std::max(high, x);
      }
    return high - low;
  }

  ElementExtent ElementExtent::uniform(const double size) noexcept
  {
    ElementExtent extent;
    extent.mean_size = size;
    return extent;
  }
}
