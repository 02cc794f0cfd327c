#include "coupling/multiscale/ellipticity.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <vector>

namespace coupling
{
  using Eigen::Vector3d;

  Eigen::Matrix<double, 6, 3> jump_strain(const Vector3d &n)
  {
    Eigen::Matrix<double, 6, 3> N;
    N << n[0], 0, 0, 0, n[1], 0, 0, 0, n[2], 0, n[2], n[1], n[2], 0, n[0], n[1], n[0], 0;
    return N;
  }

  namespace
  {
    double left_of(const base::Stiffness &tangent, const base::Stiffness &elastic, const Vector3d &n)
    {
      const Eigen::Matrix<double, 6, 3> N = jump_strain(n);
      return (N.transpose() * tangent * N).determinant() / (N.transpose() * elastic * N).determinant();
    }

    /** Half of the directions, evenly: the other half are their opposites. */
    std::vector<Vector3d> directions(const bool in_plane)
    {
      std::vector<Vector3d> all;
      constexpr int         around = 90, over = 500;
      for (int i = 0; in_plane && i < around; ++i)
        all.push_back({std::cos(M_PI * i / around), std::sin(M_PI * i / around), 0});
      if (in_plane)
        return all;
      const double golden = M_PI * (3 - std::sqrt(5.0));
      for (int i = 0; i < over; ++i) // a spiral over the half sphere
        {
          const double z = (i + 0.5) / over, r = std::sqrt(1 - z * z);
          all.push_back({r * std::cos(golden * i), r * std::sin(golden * i), z});
        }
      return {all.begin(), all.end()};
    }
  } // namespace

  WeakestPlane weakest_plane(const base::Stiffness &tangent, const base::Stiffness &elastic, const bool in_plane)
  {
    WeakestPlane best;
    best.left             = std::numeric_limits<double>::infinity();
    const auto try_normal = [&](const Vector3d &n) {
      const double left = left_of(tangent, elastic, n);
      if (!(left < best.left))
        return false;
      best = {n, left};
      return true;
    };
    for (const Vector3d &n : directions(in_plane))
      try_normal(n);
    for (double turn = 0.05; turn > 1e-6;) // downhill, over ever smaller angles [rad]
      {
        const Vector3d n = best.normal, across = in_plane ? Vector3d(-n[1], n[0], 0) : n.unitOrthogonal(),
                       other = n.cross(across);
        bool better = try_normal((n + turn * across).normalized()) || try_normal((n - turn * across).normalized());
        if (!in_plane)
          better = try_normal((n + turn * other).normalized()) || try_normal((n - turn * other).normalized()) || better;
        if (!better)
          turn /= 2;
      }
    return best;
  }

  Vector3d first_lost_normal(const base::Stiffness &unloading,
                             const base::Stiffness &tangent,
                             const base::Stiffness &elastic,
                             const bool             in_plane)
  {
    constexpr int halvings = 20;
    double        kept = 0, lost = 1;
    WeakestPlane  plane = weakest_plane(tangent, elastic, in_plane);
    for (int i = 0; i < halvings; ++i)
      {
        const double          middle  = 0.5 * (kept + lost);
        const base::Stiffness between = unloading + middle * (tangent - unloading);
        const WeakestPlane    there   = weakest_plane(between, elastic, in_plane);
        if (there.is_lost())
          plane = there;
        (there.is_lost() ? lost : kept) = middle;
      }
    return plane.normal;
  }
} // namespace coupling
