#include "dem/genesis/polygon.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dem
{
  using Eigen::Vector2d;

  namespace
  {
    double cross(const Vector2d &a, const Vector2d &b) { return a.x() * b.y() - a.y() * b.x(); }

    /** Call use(corner, next corner, twice the area of the triangle with the origin) for each edge. */
    template <typename Use>
    void for_edges(const Polygon &polygon, const Use &use)
    {
      const auto &c = polygon.corners;
      for (std::size_t i = 0; i < c.size(); ++i)
        use(c[i], c[(i + 1) % c.size()], cross(c[i], c[(i + 1) % c.size()]));
    }

    /** Largest gap between the two along outward normals of the first. */
    double gap_along_normals(const Polygon &one, const Polygon &other)
    {
      double best = -std::numeric_limits<double>::infinity();
      for_edges(one, [&](const Vector2d &a, const Vector2d &b, double) {
        const Vector2d normal  = Vector2d(b.y() - a.y(), a.x() - b.x()).normalized();
        double         nearest = std::numeric_limits<double>::infinity();
        for (const Vector2d &corner : other.corners)
          nearest = std::min(nearest, normal.dot(corner - a));
        best = std::max(best, nearest);
      });
      return best;
    }
  } // namespace

  double Polygon::area() const
  {
    double sum = 0;
    for_edges(*this, [&](const Vector2d &, const Vector2d &, const double twice) { sum += 0.5 * twice; });
    return sum;
  }

  Vector2d Polygon::centroid() const
  {
    Vector2d sum = Vector2d::Zero();
    for_edges(*this, [&](const Vector2d &a, const Vector2d &b, const double twice) { sum += twice * (a + b); });
    return sum / (6 * area());
  }

  double Polygon::polar_moment() const
  {
    Polygon about_centroid = *this;
    about_centroid.move(-centroid());
    double sum = 0;
    for_edges(about_centroid, [&](const Vector2d &a, const Vector2d &b, const double twice) {
      sum += twice * (a.squaredNorm() + a.dot(b) + b.squaredNorm()) / 12;
    });
    return sum / area();
  }

  bool Polygon::holds(const Vector2d &place) const
  {
    bool inside = true;
    for_edges(*this, [&](const Vector2d &a, const Vector2d &b, double) { inside &= cross(b - a, place - a) >= 0; });
    return inside;
  }

  double Polygon::depth(const Vector2d &place) const
  {
    double least = std::numeric_limits<double>::infinity();
    for_edges(*this, [&](const Vector2d &a, const Vector2d &b, double) {
      least = std::min(least, cross(b - a, place - a) / (b - a).norm());
    });
    return least;
  }

  void Polygon::scale(const double factor)
  {
    const Vector2d centre = centroid();
    for (Vector2d &corner : corners)
      corner = centre + factor * (corner - centre);
  }

  void Polygon::move(const Vector2d &by)
  {
    for (Vector2d &corner : corners)
      corner += by;
  }

  Polygon convex_polygon(const std::vector<Vector2d> &corners)
  {
    /** Sine of the least angle by which an outline turns at a corner: less is a place on an edge, or the same place again. */
    constexpr double least_turn = 1e-6;
    Polygon          made{corners};
    const auto       n = corners.size();
    if (n < 3)
      throw base::InputError("a polygon has at least 3 corners, and " + std::to_string(n) + " were given.");
    if (made.area() < 0)
      std::reverse(made.corners.begin(), made.corners.end());
    double turned = 0;
    for (std::size_t i = 0; i < n; ++i)
      {
        const Vector2d in  = made.corners[i] - made.corners[(i + n - 1) % n],
                       out = made.corners[(i + 1) % n] - made.corners[i];
        turned += std::atan2(cross(in, out), in.dot(out));
        if (cross(in, out) > least_turn * in.norm() * out.norm())
          continue;
        const auto given = std::find(corners.begin(), corners.end(), made.corners[i]) - corners.begin();
        throw base::InputError("the polygon is not convex at corner " + std::to_string(given + 1) +
                               ": it turns the other way there, or not at all.");
      }
    if (turned > 3 * M_PI) // a star turns the same way everywhere, twice around
      throw base::InputError("the outline of the polygon crosses itself. Give its corners in their order.");
    return made;
  }

  double separation(const Polygon &one, const Polygon &other)
  {
    return std::max(gap_along_normals(one, other), gap_along_normals(other, one));
  }

  PackedBody body_of(const Polygon &polygon)
  {
    PackedBody body;
    body.volume        = polygon.area();
    body.centre        = {polygon.centroid().x(), polygon.centroid().y(), 0};
    body.inertia(2, 2) = polygon.polar_moment();
    return body;
  }

  Polygon random_polygon(const double radius, const int fewest, const int most, UniformRandom &random)
  {
    for (;;)
      {
        const auto          corners = static_cast<std::size_t>(std::round(fewest + random() * (most - fewest)));
        std::vector<double> angle(corners);
        for (double &a : angle)
          a = 2 * M_PI * random();
        std::sort(angle.begin(), angle.end());
        double smallest = 2 * M_PI, largest = 0;
        for (std::size_t i = 0; i < corners; ++i)
          {
            const double between = i + 1 < corners ? angle[i + 1] - angle[i] : angle[0] + 2 * M_PI - angle[i];
            smallest             = std::min(smallest, between);
            largest              = std::max(largest, between);
          }
        if (smallest < 0.25 * 2 * M_PI / static_cast<double>(corners) || largest >= M_PI)
          continue;
        Polygon made;
        for (const double a : angle)
          made.corners.emplace_back(radius * std::cos(a), radius * std::sin(a));
        made.scale(std::sqrt(M_PI * radius * radius / made.area()));
        return made;
      }
  }
} // namespace dem
