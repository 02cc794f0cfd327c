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
  /** Corners of a cell, at most; parts of facets in it, and what two of them share, have some more. */
  constexpr int corners_of_cell = 24, corners_of_part = 2 * corners_of_cell;

  /** Convex, turning left. */
  struct Polygon
  {
    std::array<Point, corners_of_part> corner;
    int                                count = 0;

    Polygon() = default;
    Polygon(const Polygon &other)
      : count(other.count)
    {
      std::copy_n(other.corner.begin(), count, corner.begin());
    }
    Polygon &operator=(const Polygon &other)
    {
      count = other.count;
      std::copy_n(other.corner.begin(), count, corner.begin());
      return *this;
    }

    /** Beyond what there is room for are only corners that rounding makes. */
    void add(const Point &p)
    {
      if (count < corners_of_part)
        corner[static_cast<std::size_t>(count++)] = p;
    }
    const Point &at(const int k) const { return corner[static_cast<std::size_t>(k % count)]; }
  };

  inline double turn(const Point &a, const Point &b) { return a.x() * b.y() - a.y() * b.x(); }

  /** Keep what lies to the left of the way from a to b. */
  void cut(Polygon &polygon, const Point &a, const Point &b);
  /** By the sides of another; those that rounding has left have no direction. */
  void cut(Polygon &polygon, const Polygon &by);

  /** Area and its first moment. */
  struct Area
  {
    double size   = 0;
    Point  moment = Point::Zero();
  };
  Area area_of(const Polygon &polygon);

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

    Eigen::Vector3d origin, across, first, second; ///< across: away from the spheres that stand there
  };

  /** As symmetric about the contact as a layer is about each of its spheres. @param spheres the one whose cell it is first */
  Polygon cell_of(const std::vector<StandingSphere> &spheres, const Tangents &tangents, bool in_the_plane);
} // namespace dem::cells
