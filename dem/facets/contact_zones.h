#pragma once

#include "dem/core/recycled.h"
#include "dem/facets/facet_mesh.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /** Nearest point of one facet within the radius of a sphere. */
  struct NearPoint
  {
    std::int32_t facet; ///< of its surface
    FacetPoint   point;
    double       distance; ///< from the centre [m], in (0, radius); of a centre within a body negative, in (-radius, 0)
    Eigen::Vector3d direction; ///< from the centre, unit; from within a body the other way: into it
  };

  /** Where a sphere touches a surface: one contact, whatever the number of facets that it stands on. */
  struct ContactZone
  {
    /** A facet's part in it. */
    struct Part
    {
      std::int32_t          facet;
      std::array<double, 3> weight; ///< of its corners; all weights of a zone add up to 1
    };

    Eigen::Vector3d   place;     ///< sum of weight and corner [m]
    double            distance;  ///< of the place from the centre [m]
    double            overlap;   ///< mean of the points that weigh [m]
    Eigen::Vector3d   direction; ///< from the centre to the place, unit
    double            share;     ///< of a whole contact, (0, 1]: less where its cap overlaps with that of a deeper zone
    std::int32_t      facet;     ///< the deepest
    std::vector<Part> parts;
  };

  /** What contact_zones() finds, and its memory for the next time. */
  struct ZoneRoom
  {
    /** Points that are the same contact, the deepest first. */
    struct Cluster
    {
      std::vector<const NearPoint *> points;
      double                         share;
    };

    Recycled<ContactZone> zones;
    Recycled<Cluster>     clusters;
    std::vector<double>   weight; ///< of the points of one cluster
  };

  /**
   * Sorts nearest points into zones (doc/theory/facets.md, 2).
   *
   * The deepest point cuts a cap from the sphere: all that lies beyond the tangential plane there. A nearest point of another facet
   * within that cap is the same contact: always where the surface is flat or convex there (the point then lies in the plane or beyond
   * it), so that faces, edges and corners count once. In a hollow it lies above the plane; both then weigh in the mean place by their
   * heights above each other's planes, which vanish where either begins or ends to be, so that place and force are continuous. Points
   * outside the cap are zones of their own, grown from nothing while the caps part. All but the deepest fade out as it comes nearer
   * to the centre than 0.6 radii, and count for nothing from 0.3 on: the push is then the slope of the square of its overlap.
   *
   * @param near within the radius; is sorted @param room whose zones are found
   */
  void contact_zones(std::vector<NearPoint> &near, const Eigen::Vector3d &centre, double radius, ZoneRoom &room);
} // namespace dem
