#include "dem/joints/joint_cuts.h"

#include "dem/model/particles.h"
#include "dem/neighbours/cell_list.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dem
{
  using Eigen::Vector2d;
  using Eigen::Vector3d;

  namespace
  {
    constexpr double near_enough   = 2;   ///< pairs up to so many sums of radii may come to touch
    constexpr double radii_to_skin = 1.5; ///< from the outermost crossings to the surface, in mean radii

    struct Bounds
    {
      Vector3d lower = Vector3d::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
      double   largest = 0, mean = 0; ///< radius

      Bounds(const Packing &packing, const std::size_t count)
      {
        for (std::size_t i = 0; i < count; ++i)
          {
            const Vector3d skin = Vector3d::Constant(packing.radius[i]);
            lower               = lower.cwiseMin(packing.centre[i] - skin);
            upper               = upper.cwiseMax(packing.centre[i] + skin);
            largest             = std::max(largest, packing.radius[i]);
            mean += packing.radius[i] / static_cast<double>(count);
          }
      }
    };

    double left_of(const Vector2d &o, const Vector2d &a, const Vector2d &b)
    {
      return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
    }

    /** Area of the convex hull of places (Andrew's chain), widened all around. */
    double widened_hull(std::vector<Vector2d> places, const double by)
    {
      std::sort(places.begin(), places.end(),
                [](const Vector2d &a, const Vector2d &b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
      std::vector<Vector2d> hull;
      for (int side = 0; side < 2; ++side)
        {
          const std::size_t first = hull.size();
          for (const Vector2d &each : places)
            {
              while (hull.size() >= first + 2 && left_of(hull[hull.size() - 2], hull.back(), each) <= 0)
                hull.pop_back();
              hull.push_back(each);
            }
          hull.pop_back();
          std::reverse(places.begin(), places.end());
        }
      double area = 0, around = 0;
      for (std::size_t i = 0; i < hull.size(); ++i)
        {
          const Vector2d &a = hull[i], &b = hull[(i + 1) % hull.size()];
          area += 0.5 * (a.x() * b.y() - a.y() * b.x());
          around += (b - a).norm();
        }
      return area + by * around + M_PI * by * by;
    }

    /**
     * Across which axis a joint all through a body is looked at: the one nearest to its normal of those whose ends it stays clear of, so that
     * it leaves the body at the sides along that axis; none: its own normal.
     */
    Vector3d seen_along(const JointPlane            &joint,
                        const std::vector<Vector3d> &crossings,
                        const Bounds                &bounds,
                        const int                    dimension)
    {
      constexpr double flattest = 0.1; // cosine; below, little is seen of it
      const double     clear    = 2 * bounds.largest;
      Vector3d         best     = joint.normal;
      double           nearest  = flattest;
      if (joint.radius > 0 || !joint.corners.empty())
        return best;
      for (int axis = 0; axis < dimension; ++axis)
        {
          const auto ends =
            std::minmax_element(crossings.begin(), crossings.end(),
                                [axis](const Vector3d &a, const Vector3d &b) { return a[axis] < b[axis]; });
          if (std::abs(joint.normal[axis]) > nearest && (*ends.first)[axis] > bounds.lower[axis] + clear &&
              (*ends.second)[axis] < bounds.upper[axis] - clear)
            {
              nearest = std::abs(joint.normal[axis]);
              best    = Vector3d::Unit(axis);
            }
        }
      return best;
    }

    /** Length or area over which links cross a joint, whose outermost ones lie inside the surface. */
    double
    crossed(const JointPlane &joint, const std::vector<Vector3d> &crossings, const Bounds &bounds, const int dimension)
    {
      const double          skin      = radii_to_skin * bounds.mean;
      const Vector3d        seen      = seen_along(joint, crossings, bounds, dimension);
      const Vector3d        first     = dimension == 2 ? Vector3d(-seen.y(), seen.x(), 0) : seen.unitOrthogonal();
      const Vector3d        second    = seen.cross(first);
      const double          steepness = std::abs(seen.dot(joint.normal)); // area seen over its own
      std::vector<Vector2d> places;
      for (const Vector3d &each : crossings)
        places.emplace_back((each - joint.centre).dot(first), (each - joint.centre).dot(second));
      if (dimension == 3)
        return widened_hull(std::move(places), skin) / steepness;
      const auto ends = std::minmax_element(places.begin(), places.end(),
                                            [](const Vector2d &a, const Vector2d &b) { return a.x() < b.x(); });
      return (ends.second->x() - ends.first->x() + 2 * skin) / steepness;
    }

    /** Particles that a joint may pass near. */
    std::vector<std::int32_t>
    beside(const Packing &packing, const std::size_t count, const JointPlane &joint, const double reach)
    {
      double bound = joint.radius > 0 ? joint.radius : std::numeric_limits<double>::infinity();
      if (!joint.corners.empty())
        bound = 0;
      for (const Vector3d &corner : joint.corners)
        bound = std::max(bound, (corner - joint.centre).norm());
      std::vector<std::int32_t> found;
      for (std::size_t i = 0; i < count; ++i)
        if (const Vector3d from = packing.centre[i] - joint.centre;
            std::abs(joint.normal.dot(from)) <= reach && from.norm() <= bound + reach)
          found.push_back(static_cast<std::int32_t>(i));
      return found;
    }

    /** A cut of a pair that the specimen links. */
    struct Linked
    {
      std::size_t cut;
      Vector3d    crossing;
    };

    /** Everything that the joints cut, one joint after the other; areas are the links' own cross-sections (doc/theory/smooth-joint.md, 4). */
    struct AllCuts
    {
      std::vector<JointCut> cuts;
      std::vector<Linked>   linked;

      void add(const Packing         &packing,
               const JointedSpecimen &specimen,
               const Bounds          &bounds,
               const std::size_t      count,
               const JointPlane      &joint,
               const std::int32_t     number)
      {
        const ParticleShape shape{specimen.dimension, 1, specimen.thickness};
        const double        factor = std::max(near_enough, specimen.interaction_ratio);
        const auto near = beside(packing, count, joint, 2 * factor * bounds.largest + specimen.installation_gap);
        std::vector<Vector3d> centre;
        std::vector<double>   radius;
        for (const std::int32_t i : near)
          {
            centre.push_back(packing.centre[static_cast<std::size_t>(i)]);
            radius.push_back(packing.radius[static_cast<std::size_t>(i)]);
          }
        for (const NeighbourPair &pair : find_pairs(centre, radius, factor, specimen.installation_gap, std::nullopt))
          {
            const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
            Vector3d   crossing;
            if (!crosses(joint, centre[a], centre[b], specimen.dimension, crossing))
              continue;
            if ((centre[a] - centre[b]).norm() <
                specimen.interaction_ratio * (radius[a] + radius[b]) + specimen.installation_gap)
              linked.push_back({cuts.size(), crossing});
            cuts.push_back(
              {std::min(near[a], near[b]), std::max(near[a], near[b]), number, shape.link_area(radius[a], radius[b])});
          }
      }

      /** Their order by particles; of a pair that several joints cut the first one's alone: the sort is stable. */
      std::vector<std::size_t> in_order() const
      {
        std::vector<std::size_t> order(cuts.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [this](const std::size_t a, const std::size_t b) { return cuts[a] < cuts[b]; });
        order.erase(std::unique(order.begin(), order.end(),
                                [this](const std::size_t a, const std::size_t b) { return !(cuts[a] < cuts[b]); }),
                    order.end());
        return order;
      }
    };
  } // namespace

  JointCuts find_cuts(const Packing &packing, const JointedSpecimen &specimen, const std::vector<JointPlane> &joints)
  {
    const std::size_t count = std::min(specimen.particles, packing.size());
    const Bounds      bounds(packing, count);
    AllCuts           all;
    for (std::size_t j = 0; j < joints.size(); ++j)
      all.add(packing, specimen, bounds, count, joints[j], static_cast<std::int32_t>(j));
    const std::vector<std::size_t> order = all.in_order();

    std::vector<bool> kept(all.cuts.size(), false);
    for (const std::size_t i : order)
      kept[i] = true;
    std::vector<std::vector<Vector3d>> crossings(joints.size());
    std::vector<double>                sections(joints.size(), 0.0), share(joints.size(), 1.0);
    for (const Linked &each : all.linked)
      if (kept[each.cut])
        {
          const JointCut &cut = all.cuts[each.cut];
          crossings[static_cast<std::size_t>(cut.joint)].push_back(each.crossing);
          sections[static_cast<std::size_t>(cut.joint)] += cut.area;
        }

    JointCuts found;
    for (std::size_t j = 0; j < joints.size(); ++j)
      {
        CutFigures &figures = found.of_joint.emplace_back();
        figures.set         = joints[j].set;
        figures.normal      = joints[j].normal;
        figures.links       = crossings[j].size();
        if (figures.links == 0)
          continue;
        figures.area = (specimen.dimension == 2 ? specimen.thickness : 1.0) *
                       std::min(extent_in_box(joints[j], bounds.lower, bounds.upper, specimen.dimension),
                                crossed(joints[j], crossings[j], bounds, specimen.dimension));
        share[j] = figures.area / sections[j];
      }
    for (const std::size_t i : order)
      {
        found.cuts.push_back(all.cuts[i]);
        found.cuts.back().area *= share[static_cast<std::size_t>(all.cuts[i].joint)];
      }
    return found;
  }
} // namespace dem
