#include "dem/joints/joint_plane.h"

#include "base/errors.h"

#include <Eigen/Geometry>

#include <cmath>

namespace dem
{
  using Eigen::Vector3d;

  namespace
  {
    constexpr double radians = 3.14159265358979323846 / 180;

    Vector3d in_plane_of(const Vector3d &normal) { return {-normal.y(), normal.x(), 0}; }

    /** Whether a place on the plane is between the corners: as often left as right of them, seen along the normal's largest component. */
    bool within_corners(const JointPlane &joint, const Vector3d &place, const int dimension)
    {
      const auto &c = joint.corners;
      if (dimension == 2)
        return (place - c[0]).dot(c[1] - c[0]) >= 0 && (place - c[1]).dot(c[0] - c[1]) >= 0;
      int along = 0;
      joint.normal.cwiseAbs().maxCoeff(&along);
      const int u = (along + 1) % 3, v = (along + 2) % 3;
      bool      inside = false;
      for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++)
        if ((c[i][v] > place[v]) != (c[j][v] > place[v]) &&
            place[u] < c[i][u] + (c[j][u] - c[i][u]) * (place[v] - c[i][v]) / (c[j][v] - c[i][v]))
          inside = !inside;
      return inside;
    }

    /** The joint as a polygon, or a segment, that reaches at least so far from the place. */
    std::vector<Vector3d>
    outline(const JointPlane &joint, const Vector3d &place, const double reach, const int dimension)
    {
      if (!joint.corners.empty())
        return joint.corners;
      const Vector3d centre =
        joint.radius > 0 ? joint.centre : Vector3d(place - joint.normal.dot(place - joint.centre) * joint.normal);
      if (dimension == 2)
        {
          const Vector3d half = (joint.radius > 0 ? joint.radius : reach) * in_plane_of(joint.normal);
          return {centre - half, centre + half};
        }
      const Vector3d        first = joint.normal.unitOrthogonal(), second = joint.normal.cross(first);
      const int             n    = joint.radius > 0 ? 96 : 4;
      const double          turn = 360 * radians / n;
      const double          r    = joint.radius > 0 ? joint.radius * std::sqrt(turn / std::sin(turn)) : 2 * reach;
      std::vector<Vector3d> corners;
      for (int i = 0; i < n; ++i)
        corners.push_back(centre + r * (std::cos(turn * i) * first + std::sin(turn * i) * second));
      return corners;
    }

    /** What of a polygon, or a segment, lies where sign x[axis] <= sign limit (Sutherland and Hodgman, 1974). */
    std::vector<Vector3d>
    clipped(const std::vector<Vector3d> &corners, const int axis, const double sign, const double limit)
    {
      std::vector<Vector3d> kept;
      const bool            closed = corners.size() > 2;
      for (std::size_t i = 0; i < corners.size(); ++i)
        {
          const Vector3d &here = corners[i], &next = corners[(i + 1) % corners.size()];
          const double    a = sign * (here[axis] - limit), b = sign * (next[axis] - limit);
          if (a <= 0)
            kept.push_back(here);
          if ((closed || i + 1 < corners.size()) && (a <= 0) != (b <= 0))
            kept.push_back(here + a / (a - b) * (next - here));
        }
      return kept;
    }

    double size_of(const std::vector<Vector3d> &corners)
    {
      if (corners.size() < 2)
        return 0;
      if (corners.size() == 2)
        return (corners[1] - corners[0]).norm();
      Vector3d sum = Vector3d::Zero();
      for (std::size_t i = 2; i < corners.size(); ++i)
        sum += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
      return 0.5 * sum.norm();
    }
  } // namespace

  JointPlane segment_joint(const Vector3d &from, const Vector3d &to)
  {
    const Vector3d along = to - from;
    if (!(along.norm() > 0))
      throw base::InputError("both ends are the same place.");
    JointPlane joint;
    joint.centre  = 0.5 * (from + to);
    joint.normal  = Vector3d(along.y(), -along.x(), 0).normalized();
    joint.corners = {from, to};
    return joint;
  }

  JointPlane polygon_joint(const std::vector<Vector3d> &corners)
  {
    JointPlane joint;
    Vector3d   area = Vector3d::Zero(), middle = Vector3d::Zero();
    double     size = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
      {
        middle += corners[i] / static_cast<double>(corners.size());
        size = std::max(size, (corners[i] - corners[0]).norm());
        if (i > 1)
          area += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
      }
    if (corners.size() < 3 || !(area.norm() > 1e-9 * size * size))
      throw base::InputError("a joint in space has at least three corners, which span an area.");
    joint.normal  = area.normalized();
    joint.centre  = middle;
    joint.corners = corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
      if (std::abs(joint.normal.dot(corners[i] - middle)) > 1e-6 * size)
        throw base::InputError("corner " + std::to_string(i + 1) + " does not lie on the plane of the others.");
    return joint;
  }

  Vector3d normal_of_dip(const double dip, const double dip_direction, const int dimension)
  {
    const double sin = std::sin(dip * radians), cos = std::cos(dip * radians);
    if (dimension == 2)
      return {-sin, cos, 0};
    return {sin * std::cos(dip_direction * radians), sin * std::sin(dip_direction * radians), cos};
  }

  bool
  crosses(const JointPlane &joint, const Vector3d &one, const Vector3d &other, const int dimension, Vector3d &crossing)
  {
    const double a = joint.normal.dot(one - joint.centre), b = joint.normal.dot(other - joint.centre);
    if ((a < 0) == (b < 0))
      return false;
    crossing = one + a / (a - b) * (other - one);
    if (joint.radius > 0 && !((crossing - joint.centre).norm() <= joint.radius))
      return false;
    return joint.corners.empty() || within_corners(joint, crossing, dimension);
  }

  double extent_in_box(const JointPlane &joint, const Vector3d &lower, const Vector3d &upper, const int dimension)
  {
    const Vector3d        middle  = 0.5 * (lower + upper);
    std::vector<Vector3d> corners = outline(joint, middle, (upper - lower).norm(), dimension);
    for (int axis = 0; axis < dimension; ++axis)
      corners = clipped(clipped(corners, axis, 1, upper[axis]), axis, -1, lower[axis]);
    return size_of(corners);
  }
} // namespace dem
