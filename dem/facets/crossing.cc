#include "dem/facets/crossing.h"

#include "base/errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace dem
{
  namespace
  {
    using Corners = std::array<Eigen::Vector3d, 3>;

    /** Of the step's motion: how far beside a facet what crosses its plane still pierces it, for the plane may turn meanwhile. */
    constexpr double beside_it = 1e-3;

    Corners corners_of(const Surface &surface, const std::size_t facet, const double steps_back)
    {
      Corners found = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
      for (std::size_t c = 0; c < static_cast<std::size_t>(surface.mesh.corners); ++c)
        {
          const auto v = static_cast<std::size_t>(surface.mesh.facet[facet][c]);
          found[c]     = surface.place[v] - steps_back * surface.motion[v];
        }
      return found;
    }

    double height_over(const Corners &x, const bool segment, const Eigen::Vector3d &of)
    {
      return facet_normal(x, segment).dot(of - x[0]);
    }

    bool pierces(const Surface         &surface,
                 const std::size_t      facet,
                 const Eigen::Vector3d &centre,
                 const Eigen::Vector3d &moved,
                 const double           way)
    {
      const bool   segment = surface.mesh.corners == 2;
      const double before  = height_over(corners_of(surface, facet, 1), segment, centre - moved),
                   now     = height_over(corners_of(surface, facet, 0), segment, centre);
      if ((before >= 0) == (now >= 0))
        return false;
      const double          back   = now / (now - before);
      const Eigen::Vector3d x      = centre - back * moved;
      const Corners         corner = corners_of(surface, facet, back);
      const FacetPoint      point  = segment ? closest_on_segment(corner, x) : closest_on_triangle(corner, x);
      return (point.place - x).norm() <= beside_it * way;
    }

    /** Angle of a facet at the only corner that weighs; pi on an edge, and of a segment. */
    double angle_at(const Surface &surface, const NearPoint &point)
    {
      const auto &weight = point.point.weight;
      const auto  here   = static_cast<std::size_t>(std::max_element(weight.begin(), weight.end()) - weight.begin());
      if (surface.mesh.corners == 2 || weight[here] < 1)
        return M_PI;
      const Corners         x = corners_of(surface, static_cast<std::size_t>(point.facet), 0);
      const Eigen::Vector3d a = x[(here + 1) % 3] - x[here], b = x[(here + 2) % 3] - x[here];
      return std::atan2(a.cross(b).norm(), a.dot(b));
    }
  } // namespace

  bool goes_through(const Surface                &surface,
                    const std::vector<NearPoint> &near,
                    const Eigen::Vector3d        &centre,
                    const Eigen::Vector3d        &moved)
  {
    if (surface.mesh.is_plane()) // is known by its sign
      return false;
    const double own_way = moved.norm();
    return std::any_of(near.begin(), near.end(), [&](const NearPoint &point) {
      const auto facet = static_cast<std::size_t>(point.facet);
      double     way   = 0;
      for (std::size_t c = 0; c < static_cast<std::size_t>(surface.mesh.corners); ++c)
        way = std::max(way, surface.motion[static_cast<std::size_t>(surface.mesh.facet[facet][c])].norm());
      way += own_way;
      return point.distance <= way && pierces(surface, facet, centre, moved, way);
    });
  }

  bool lies_behind(const Surface                &surface,
                   const std::vector<NearPoint> &near,
                   const NearPoint              &nearest,
                   const Eigen::Vector3d        &centre)
  {
    const double    same_place = 1e-9 * (nearest.distance + (surface.place.front() - centre).norm());
    Eigen::Vector3d outward    = Eigen::Vector3d::Zero();
    for (const NearPoint &point : near)
      if ((point.point.place - nearest.point.place).norm() <= same_place)
        {
          const auto facet = static_cast<std::size_t>(point.facet);
          outward += surface.mesh.outward[facet] * angle_at(surface, point) * surface.bounds(facet).normal;
        }
    return outward.dot(centre - nearest.point.place) < 0;
  }

  void refuse_sunk(const Particles &p, const std::int32_t i, const Surface &surface)
  {
    std::ostringstream message;
    message << "particle " << p.number[static_cast<std::size_t>(i)] + 1 << " has sunk into wall " << surface.name
            << (surface.holds_from_within() ? " by twice its radius" : " by its radius")
            << ". Raise the wall's Effective modulus, or lower the load or Time/Step factor.";
    throw base::NumericalError(message.str());
  }
} // namespace dem
