#include "dem/loading/section.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
  namespace
  {
    constexpr int planes            = 20; ///< how many cuts are looked at
    constexpr int points_per_circle = 24; ///< exact along the axes; the hull of one lone circle comes out 1.2 % small

    double turn(const Eigen::Vector2d &o, const Eigen::Vector2d &a, const Eigen::Vector2d &b)
    {
      return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
    }

    /** Area of the convex hull by the monotone chain (Andrew, 1979, Inf. Process. Lett. 9, 216). */
    double hull_area(std::vector<Eigen::Vector2d> points)
    {
      const auto before = [](const Eigen::Vector2d &a, const Eigen::Vector2d &b) {
        return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
      };
      std::sort(points.begin(), points.end(), before);
      std::vector<Eigen::Vector2d> hull;
      for (int side = 0; side < 2; ++side)
        {
          const std::size_t start = hull.size();
          for (const auto &point : points)
            {
              while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0)
                hull.pop_back();
              hull.push_back(point);
            }
          hull.pop_back();
          std::reverse(points.begin(), points.end());
        }
      double twice = 0;
      for (std::size_t i = 0; i < hull.size(); ++i)
        twice += turn(Eigen::Vector2d::Zero(), hull[i], hull[(i + 1) % hull.size()]);
      return 0.5 * twice;
    }

    /** Smallest over the planes of measure(height); zero measure: the plane meets nothing and does not count. */
    template <typename Measure>
    double smallest_over_planes(const double low, const double high, Measure &&measure)
    {
      double smallest = std::numeric_limits<double>::infinity();
      for (int i = 0; i < planes; ++i)
        {
          const double found = measure(low + (high - low) * (i + 0.5) / planes);
          if (found > 0)
            smallest = std::min(smallest, found);
        }
      return smallest;
    }
  } // namespace

  double smallest_section(const std::vector<Eigen::Vector3d> &centre,
                          const std::vector<double>          &radius,
                          const int                           axis,
                          const double                        low,
                          const double                        high)
  {
    return smallest_over_planes(low, high, [&](const double height) {
      std::vector<Eigen::Vector2d> points;
      for (std::size_t i = 0; i < centre.size(); ++i)
        {
          if (std::abs(height - centre[i][axis]) >= radius[i])
            continue;
          const Eigen::Vector2d middle(centre[i][(axis + 1) % 3], centre[i][(axis + 2) % 3]);
          for (int k = 0; k < points_per_circle; ++k)
            {
              const double angle = 2.0 * M_PI * k / points_per_circle;
              points.push_back(middle + radius[i] * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
            }
        }
      return points.empty() ? 0.0 : hull_area(std::move(points));
    });
  }

  double smallest_plane_section(const std::vector<Eigen::Vector3d> &centre,
                                const std::vector<double>          &radius,
                                const int                           axis,
                                const double                        low,
                                const double                        high,
                                const double                        thickness)
  {
    return smallest_over_planes(low, high, [&](const double height) {
      double least = std::numeric_limits<double>::infinity(), most = -least;
      for (std::size_t i = 0; i < centre.size(); ++i)
        {
          if (std::abs(height - centre[i][axis]) >= radius[i])
            continue;
          const double across = centre[i][1 - axis];
          least               = std::min(least, across - radius[i]);
          most                = std::max(most, across + radius[i]);
        }
      return most > least ? (most - least) * thickness : 0.0;
    });
  }
} // namespace dem
