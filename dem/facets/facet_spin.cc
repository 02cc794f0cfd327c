#include "dem/facets/facet_spin.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace dem
{
  FacetSpin::FacetSpin(const Surface &surface, const std::size_t facet, const double back)
    : corners(static_cast<std::size_t>(surface.mesh.corners))
  {
    for (std::size_t c = 0; c < corners; ++c)
      {
        const auto v = static_cast<std::size_t>(surface.mesh.facet[facet][c]);
        arm[c]       = surface.place[v] - back * surface.motion[v];
      }
    measure();
  }

  FacetSpin::FacetSpin(const FacetMesh &mesh, const std::vector<Eigen::Vector3d> &place, const std::size_t facet)
    : corners(static_cast<std::size_t>(mesh.corners))
  {
    for (std::size_t c = 0; c < corners; ++c)
      arm[c] = place[static_cast<std::size_t>(mesh.facet[facet][c])];
    measure();
  }

  void FacetSpin::measure()
  {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (std::size_t c = 0; c < corners; ++c)
      mean += arm[c] / static_cast<double>(corners);
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    for (std::size_t c = 0; c < corners; ++c)
      {
        arm[c] -= mean;
        inertia += arm[c].squaredNorm() * Eigen::Matrix3d::Identity() - arm[c] * arm[c].transpose();
      }
    if (corners == 3)
      {
        inverse = inertia.inverse();
        return;
      }
    inverse.setZero();
    inverse(2, 2) = 1 / inertia(2, 2);
  }

  Eigen::Vector3d FacetSpin::turn(const std::array<Eigen::Vector3d, 3> &moved) const
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t c = 0; c < corners; ++c)
      sum += arm[c].cross(moved[c]);
    return inverse * sum;
  }

  std::array<Eigen::Vector3d, 3> FacetSpin::forces(const Eigen::Vector3d &couple) const
  {
    const Eigen::Vector3d          q = inverse * couple;
    std::array<Eigen::Vector3d, 3> g;
    for (std::size_t c = 0; c < corners; ++c)
      g[c] = q.cross(arm[c]);
    return g;
  }

  double FacetSpin::stiffness(const std::size_t corner, const double turning) const
  {
    double all = 0;
    for (std::size_t c = 0; c < corners; ++c)
      all += arm[c].norm();
    return turning * inverse.squaredNorm() * arm[corner].norm() * all;
  }
} // namespace dem
