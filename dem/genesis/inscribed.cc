#include "dem/genesis/inscribed.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace dem
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  namespace
  {
    using Touched = std::array<const Obstacle *, 4>; ///< in the plane three of them

    /** Centre as a + b r, from all touched but the first, if that is a sphere; in the plane with its height. */
    bool centre_by_radius(const Touched &touched, const int dimension, const Vector3d &place, Vector3d &a, Vector3d &b)
    {
      const Obstacle &first = *touched[0];
      Matrix3d        rows  = Matrix3d::Identity();
      Vector3d        fixed = place, by_radius = Vector3d::Zero();
      for (int k = 0; k < dimension; ++k)
        {
          const Obstacle &other = *touched[static_cast<std::size_t>(k + 1)];
          if (other.is_wall()) // n x = offset + r
            {
              rows.row(k)  = other.normal.transpose();
              fixed[k]     = other.offset;
              by_radius[k] = 1;
              continue;
            }
          // |x - c|^2 = (R + r)^2, less the same of the first, from whose centre places are measured.
          const Vector3d from = other.centre - first.centre;
          rows.row(k)         = from.transpose();
          fixed[k]            = from.dot(first.centre) +
                     0.5 * (from.squaredNorm() + first.radius * first.radius - other.radius * other.radius);
          by_radius[k] = first.radius - other.radius;
        }
      const Eigen::FullPivLU<Matrix3d> lu(rows);
      if (!lu.isInvertible())
        return false;
      a = lu.solve(fixed);
      b = lu.solve(by_radius);
      return true;
    }

    /** Radii with which a + b r touches the sphere. */
    std::array<double, 2> touching_radii(const Obstacle &sphere, const Vector3d &a, const Vector3d &b)
    {
      const Vector3d from   = a - sphere.centre;
      const double   square = b.squaredNorm() - 1, linear = b.dot(from) - sphere.radius,
                   constant = from.squaredNorm() - sphere.radius * sphere.radius;
      const double root     = linear * linear - square * constant;
      if (root < 0)
        return {-1, -1};
      const double q = -(linear + std::copysign(std::sqrt(root), linear));
      return {square != 0 ? q / square : -1.0, q != 0 ? constant / q : -1.0};
    }

    /** Whether something is touched on every side: the directions away from it add up to nothing with weights above 0. */
    bool is_held(const Touched &touched, const int dimension, const Vector3d &centre)
    {
      constexpr double enough = 1e-9;
      Eigen::Matrix4d  rows   = Eigen::Matrix4d::Identity();
      for (int k = 0; k <= dimension; ++k)
        {
          rows.col(k).head<3>() = touched[static_cast<std::size_t>(k)]->direction(centre);
          rows(3, k)            = 1;
        }
      if (dimension == 2)
        {
          rows.col(3).setZero();
          rows(2, 3) = 1;
        }
      const Eigen::FullPivLU<Eigen::Matrix4d> lu(rows);
      return lu.isInvertible() && lu.solve(Eigen::Vector4d::Unit(3)).head(dimension + 1).minCoeff() > enough;
    }
  } // namespace

  double Obstacle::distance(const Vector3d &place) const
  {
    return is_wall() ? normal.dot(place) - offset : (place - centre).norm() - radius;
  }

  Vector3d Obstacle::direction(const Vector3d &place) const
  {
    return is_wall() ? normal : Vector3d((place - centre).normalized());
  }

  std::optional<InscribedSphere> inscribed_sphere(const std::vector<Obstacle> &obstacles,
                                                  const int                    dimension,
                                                  const Vector3d              &place,
                                                  const double                 furthest)
  {
    std::optional<InscribedSphere> best;
    const auto                     consider = [&](const Touched &touched) {
      Vector3d a, b;
      if (touched[0]->is_wall() || !centre_by_radius(touched, dimension, place, a, b))
        return;
      for (const double radius : touching_radii(*touched[0], a, b))
        {
          constexpr double rounding = 1e-10;
          const Vector3d   centre   = a + radius * b;
          const double     off      = (centre - place).norm();
          if (!(radius > 0) || off > furthest || (best && off >= (best->centre - place).norm()) ||
              !is_held(touched, dimension, centre))
            continue;
          if (std::all_of(obstacles.begin(), obstacles.end(),
                                              [&](const Obstacle &one) { return one.distance(centre) >= radius * (1 - rounding); }))
            best = {centre, radius};
        }
    };
    // Spheres before walls, so that the first of a subset is one; what walls alone hold is a corner, which holds nothing.
    std::vector<const Obstacle *> sorted;
    for (const bool walls : {false, true})
      for (const Obstacle &one : obstacles)
        if (one.is_wall() == walls)
          sorted.push_back(&one);
    const std::size_t n = sorted.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        for (std::size_t k = j + 1; k < n; ++k)
          if (dimension == 2)
            consider({sorted[i], sorted[j], sorted[k], nullptr});
          else
            for (std::size_t l = k + 1; l < n; ++l)
              consider({sorted[i], sorted[j], sorted[k], sorted[l]});
    return best;
  }
} // namespace dem
