#include "dem/facets/contact_zones.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    /** Lengths below this part of the radius are round-off of places. */
    constexpr double rounding = 1e-11;

    /** Half the opening angle of the cap that a point at this distance cuts off. */
    double half_angle(const double distance, const double radius)
    {
      return std::acos(std::min(distance / radius, 1.0));
    }

    /** Accurate for small angles, too. */
    double angle_between(const Eigen::Vector3d &a, const Eigen::Vector3d &b)
    {
      return 2 * std::atan2((a - b).norm(), (a + b).norm());
    }

    /** Height of the point of `other` above the tangential plane at that of `one` [m]. */
    double height_above(const NearPoint &one, const NearPoint &other)
    {
      return one.distance - other.distance * one.direction.dot(other.direction);
    }

    /** Part of a pair's weight that the second has: 0 where it begins to be, 1 where the first ends. */
    double part_of_second(const NearPoint &first, const NearPoint &second, const double radius)
    {
      const double above = height_above(first, second), below = height_above(second, first);
      if (above <= rounding * radius)
        return 0;
      return below <= rounding * radius ? 1.0 : above / (above + below);
    }

    /**
     * What all points but the deepest count for. Near the centre their caps are half of the sphere, and shares of a whole contact that
     * is as strong as any would make and lose much energy.
     */
    double counts_of_others(const double deepest, const double radius)
    {
      constexpr double none = 0.3, whole = 0.6;
      const double     x = std::min(std::max((deepest / radius - none) / (whole - none), 0.0), 1.0);
      return x * x * (3 - 2 * x);
    }

    using Cluster = ZoneRoom::Cluster;

    /** Of the same contact, in a hollow; others weigh nothing. */
    bool weighs(const Cluster &cluster, const NearPoint &point, const double radius)
    {
      if (height_above(*cluster.points.front(), point) <= rounding * radius)
        return false;
      return std::none_of(cluster.points.begin(), cluster.points.end(), [&](const NearPoint *known) {
        return (known->point.place - point.point.place).norm() <= rounding * radius; // an edge or corner that both have
      });
    }

    /** 3: inside a triangle, 2: on an edge, 1: at a corner. */
    int corners_that_weigh(const NearPoint &point)
    {
      return static_cast<int>(
        std::count_if(point.point.weight.begin(), point.point.weight.end(), [](const double w) { return w > 0; }));
    }

    /** Of points as near as this one to rounding, put the one that lies inside its facet here: next to edges it is the exact one. */
    void prefer_inside(std::vector<NearPoint> &near, const std::size_t here, const double radius)
    {
      for (std::size_t k = here + 1; k < near.size() && near[k].distance <= near[here].distance + 4e-15 * radius; ++k)
        if ((near[k].point.place - near[here].point.place).norm() < 1e-6 * radius &&
            corners_that_weigh(near[k]) > corners_that_weigh(near[here]))
          std::swap(near[k], near[here]);
    }

    /**
     * Shares of two clusters whose caps overlap, though neither lies in the other's: together 1 + s, where s grows from 0 as they part
     * to 1; of what is not whole they share as points of one cluster do.
     */
    void part_caps(Recycled<Cluster> &clusters, const double radius)
    {
      for (std::size_t b = 1; b < clusters.size(); ++b)
        for (std::size_t a = 0; a < b; ++a)
          {
            const NearPoint &deep = *clusters[a].points.front(), &other = *clusters[b].points.front();
            const double     apart = angle_between(deep.direction, other.direction) - half_angle(deep.distance, radius),
                         cap       = half_angle(other.distance, radius);
            if (apart >= cap)
              continue;
            const double whole = std::max(apart / cap, 0.0), part = part_of_second(deep, other, radius);
            clusters[a].share *= 1 - (1 - whole) * part;
            clusters[b].share *= whole + (1 - whole) * part;
          }
    }

    /** @param others what the points count for beside the deepest of all, if that is one of them */
    void add_zone(
      ZoneRoom &room, const Cluster &cluster, const Eigen::Vector3d &centre, const double radius, const double others)
    {
      const auto          &points = cluster.points;
      std::vector<double> &weight = room.weight;
      double               sum    = 0;
      weight.assign(points.size(), 1.0);
      for (std::size_t k = 0; k < points.size(); ++k)
        {
          for (std::size_t j = 0; j < points.size(); ++j)
            if (j != k)
              weight[k] *= part_of_second(*points[j], *points[k], radius);
          sum += weight[k];
        }
      if (!(sum > 0)) // each begins on the plane of another
        {
          std::fill(weight.begin(), weight.end(), 0.0);
          sum = weight.front() = 1;
        }
      if (others < 1)
        {
          for (double &w : weight)
            w *= others / sum;
          weight.front() += 1 - others;
          sum = 1;
        }
      const NearPoint &deepest = *points.front();
      ContactZone     &zone    = room.zones.add();
      zone.place.setZero();
      zone.distance  = deepest.distance;
      zone.overlap   = 0;
      zone.direction = deepest.direction;
      zone.share     = cluster.share;
      zone.facet     = deepest.facet;
      zone.parts.clear();
      for (std::size_t k = 0; k < points.size(); ++k)
        if (weight[k] > 0)
          {
            const double part = weight[k] / sum;
            auto         own  = points[k]->point.weight;
            for (double &w : own)
              w *= part;
            zone.parts.push_back({points[k]->facet, own});
            zone.place += part * points[k]->point.place;
            zone.overlap += part * (radius - points[k]->distance);
          }
      if (zone.parts.size() > 1) // a mean place; of one point all is known to the last bit
        {
          const Eigen::Vector3d branch = zone.place - centre;
          zone.distance                = branch.norm();
          zone.direction               = branch / zone.distance;
        }
    }
  } // namespace

  void contact_zones(std::vector<NearPoint> &near, const Eigen::Vector3d &centre, const double radius, ZoneRoom &room)
  {
    std::sort(near.begin(), near.end(), [](const NearPoint &a, const NearPoint &b) {
      return a.distance != b.distance ? a.distance < b.distance : a.facet < b.facet;
    });
    room.clusters.clear();
    room.zones.clear();
    const double others = near.empty() ? 1.0 : counts_of_others(near.front().distance, radius);
    if (others == 0)
      {
        prefer_inside(near, 0, radius);
        near.resize(1);
      }
    for (std::size_t k = 0; k < near.size(); ++k)
      {
        prefer_inside(near, k, radius);
        const NearPoint &point = near[k];
        bool             known = false;
        for (Cluster &cluster : room.clusters)
          {
            const NearPoint &deepest = *cluster.points.front();
            const double     apart   = angle_between(deepest.direction, point.direction),
                         cap         = half_angle(deepest.distance, radius);
            if (apart <= cap || height_above(deepest, point) <= rounding * radius)
              {
                known = true;
                if (weighs(cluster, point, radius))
                  cluster.points.push_back(&point);
                break;
              }
          }
        if (!known)
          {
            Cluster &cluster = room.clusters.add();
            cluster.points.assign(1, &point);
            cluster.share = 1;
          }
      }
    part_caps(room.clusters, radius);
    for (std::size_t k = 0; k < room.clusters.size(); ++k)
      {
        Cluster &cluster = room.clusters[k];
        if (others < 1)
          cluster.share = k == 0 ? 1 - (1 - cluster.share) * others : cluster.share * others;
        add_zone(room, cluster, centre, radius, k == 0 ? others : 1.0);
      }
  }
} // namespace dem
