#pragma once

#include "dem/facets/facet_mesh.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <vector>

namespace dem
{
  /** A sphere that stands on a surface, or is near it. */
  struct StandingSphere
  {
    Eigen::Vector3d centre; ///< [m]
    double          radius; ///< [m]
  };
} // namespace dem

/** Polygons in the tangential plane of a contact, and the cell that a sphere has there (doc/theory/facets.md, 7). */
namespace dem::cells
{
  using Point = Eigen::Vector2d;

  /** Areas that differ by less than this part of a cell are equal. */
  constexpr double rounding = 1e-10;
  /** Corners of a cell, at most. What facets share of it has more: by three for a facet, and three for a mirrored one. */
  constexpr int corners_of_cell = 24, corners_of_part = corners_of_cell + 6;

  inline double turn(const Point &a, const Point &b) { return a.x() * b.y() - a.y() * b.x(); }

  /** What a side of a polygon goes with, in ways of the contact as that glides over the surface. */
  enum class Side : signed char
  {
    surface  = 0, ///< rests
    cell     = 1,
    mirrored = 2 ///< a facet's mirror image through the contact
  };

  /** A linear function of the plane, and the half of that where it is not negative. */
  struct HalfPlane
  {
    double at(const Point &p) const { return at_origin + slope.x() * p.x() + slope.y() * p.y(); }
    /** Its mirror image through a point. */
    HalfPlane mirrored(const Point &through) const { return {at_origin + 2 * slope.dot(through), -slope}; }

    double at_origin = 0;
    Point  slope     = Point::Zero();
  };

  /** Convex, turning left. */
  struct Polygon
  {
    std::array<Point, corners_of_part> corner;
    std::array<Side, corners_of_part>  side; ///< from that corner to the next
    int                                count = 0;

    Polygon() = default;
    Polygon(const Polygon &other) { *this = other; }
    Polygon &operator=(const Polygon &other)
    {
      count = other.count;
      std::copy_n(other.corner.begin(), count, corner.begin());
      std::copy_n(other.side.begin(), count, side.begin());
      return *this;
    }

    /** Beyond what there is room for are only corners that rounding makes. */
    void add(const Point &p, const Side to_next)
    {
      if (count == corners_of_part)
        return;
      corner[static_cast<std::size_t>(count)] = p;
      side[static_cast<std::size_t>(count++)] = to_next;
    }
  };

  /** Keep what lies in the half plane. @param kind of the side that this makes */
  void cut(Polygon &polygon, const HalfPlane &by, Side kind);

  /** Area and its first moment. */
  struct Area
  {
    double size   = 0;
    Point  moment = Point::Zero();

    void add(const Area &other, const double factor)
    {
      size += factor * other.size;
      moment += factor * other.moment;
    }
  };
  Area area_of(const Polygon &polygon);
  /** How area and moment change as the contact glides along the first and the second axis, exactly: integrals over the sides that move. */
  std::array<Area, 2> glide_of(const Polygon &polygon);

  /** The tangential plane: its sides as nearly along the axes as the surface lets them be; in the plane z is one of them. */
  struct Tangents
  {
    Tangents(const Eigen::Vector3d &origin_, const Eigen::Vector3d &across_, const bool in_the_plane)
      : origin(origin_)
      , across(across_)
    {
      Eigen::Index least = 0;
      across.cwiseAbs().minCoeff(&least);
      const Eigen::Vector3d axis = in_the_plane ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::Unit(least);
      second = in_the_plane ? axis : Eigen::Vector3d((axis - across.dot(axis) * across).normalized());
      first  = second.cross(across);
    }
    Point of(const Eigen::Vector3d &x) const { return {first.dot(x - origin), second.dot(x - origin)}; }

    Eigen::Vector3d in_space(const Point &p) const { return origin + p.x() * first + p.y() * second; }

    Eigen::Vector3d origin, across, first, second; ///< across: away from the spheres that stand there
  };

  /** As symmetric about the contact as a layer is about each of its spheres. @param spheres the one whose cell it is first */
  Polygon cell_of(const std::vector<StandingSphere> &spheres, const Tangents &tangents, bool in_the_plane);
} // namespace dem::cells
