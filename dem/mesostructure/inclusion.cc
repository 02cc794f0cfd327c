#include "dem/mesostructure/inclusion.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  using Eigen::Vector3d;

  double Inclusion::volume() const { return 4.0 / 3.0 * M_PI * radius * radius * radius; }

  Vector3d Inclusion::furthest(const Vector3d &direction) const
  {
    return centre + axes * (radius * shape->furthest(axes.transpose() * direction));
  }

  double Inclusion::depth(const Vector3d &place) const
  {
    return radius * shape->depth(axes.transpose() * (place - centre) / radius);
  }

  bool are_apart(const Inclusion &one, const Inclusion &other, const double gap, const Vector3d &shift)
  {
    const Vector3d between = one.centre - other.centre - shift;
    const double   centres = between.norm();
    if (centres >= one.reach() + other.reach() + gap)
      return true;
    if (one.shape->is_sphere() && other.shape->is_sphere())
      return false;
    if (centres < one.radius * one.shape->inner_reach() + other.radius * other.shape->inner_reach())
      return false;
    constexpr int most_rounds = 60;
    Vector3d      v           = between;
    for (int round = 0; round < most_rounds; ++round)
      {
        const double length = v.norm();
        if (length < gap)
          return false;
        const Vector3d support = one.furthest(-v) - other.furthest(v) - shift;
        if (v.dot(support) >= gap * length)
          return true;
        const Vector3d step = support - v;
        const double   room = step.squaredNorm();
        if (!(room > 0))
          return false;
        v += std::clamp(-v.dot(step) / room, 0.0, 1.0) * step;
      }
    return false;
  }
} // namespace dem
