#include "dem/laws/flat_joint_layout.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;
  }

  double FlatJointLayout::second_moment() const
  {
    double sum = 0;
    for (const Element &e : elements)
      sum += e.share * (e.x1 * e.x1 + e.own);
    return sum;
  }

  double FlatJointLayout::polar_moment() const
  {
    double sum = 0;
    for (const Element &e : elements)
      sum += e.share * (e.x1 * e.x1 + e.x2 * e.x2);
    return sum;
  }

  FlatJointLayout segment_layout(const int elements)
  {
    FlatJointLayout layout;
    layout.half_width = 1.0 / elements;
    for (int e = 0; e < elements; ++e)
      layout.elements.push_back(
        {-1 + (2.0 * e + 1) / elements, 0.0, 1.0 / elements, layout.half_width * layout.half_width / 3});
    layout.reach = 1 - layout.half_width;
    return layout;
  }

  // The first sector lies on axis 2: so the pattern is the same seen from either particle, whatever the number of sectors.
  FlatJointLayout disk_layout(const int rings, const int sectors, const bool own_moments)
  {
    FlatJointLayout layout;
    const double    half_angle = pi / sectors;
    for (int ring = 0; ring < rings; ++ring)
      {
        const double inner = double(ring) / rings, outer = double(ring + 1) / rings;
        const double area = outer * outer - inner * inner; // of the ring, over pi R^2
        const double centroid =
          2.0 / 3 * (outer * outer * outer - inner * inner * inner) / area * std::sin(half_angle) / half_angle;
        const double polar = 0.5 * (outer * outer + inner * inner) - centroid * centroid;
        for (int sector = 0; sector < sectors; ++sector)
          {
            const double angle = 0.5 * pi + 2 * half_angle * sector;
            layout.elements.push_back({centroid * std::cos(angle), centroid * std::sin(angle), area / sectors,
                                       own_moments ? 0.5 * polar : 0.0});
          }
        layout.reach = std::max(layout.reach, centroid);
      }
    return layout;
  }
} // namespace dem
