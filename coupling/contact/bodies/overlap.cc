#include "coupling/contact/bodies/overlap.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace coupling::bodies
{
  using Eigen::Vector3d;

  namespace
  {
    /** Corners of the side opposite to each corner, turning left as seen from outside. */
    constexpr int side_of_tetrahedron[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    constexpr int side_of_triangle[3][2]    = {{1, 2}, {2, 0}, {0, 1}};

    /** Distances that differ by less than this part of a simplex's size are the same: coplanar sides. */
    constexpr double rounding = 1e-13;

    struct Plane
    {
      Vector3d normal; ///< outward
      double   at = 0, tolerance = 0;

      double above(const Vector3d &x) const { return normal.dot(x) - at; }
    };

    struct Planes
    {
      std::array<Plane, 4> side;
      int                  count = 0;
    };

    Vector3d area_of_side(const Simplex &s, const int side)
    {
      if (s.corners == 3)
        {
          const Vector3d along = s.corner[side_of_triangle[side][1]] - s.corner[side_of_triangle[side][0]];
          return {along[1], -along[0], 0};
        }
      const int *c = side_of_tetrahedron[side];
      return 0.5 * (s.corner[c[1]] - s.corner[c[0]]).cross(s.corner[c[2]] - s.corner[c[0]]);
    }

    Planes planes_of(const Simplex &s)
    {
      Planes found;
      found.count = s.corners;
      double size = 0;
      for (int c = 1; c < s.corners; ++c)
        size = std::max(size, (s.corner[c] - s.corner[0]).cwiseAbs().maxCoeff());
      for (int side = 0; side < s.corners; ++side)
        {
          Plane &plane    = found.side[side];
          plane.normal    = area_of_side(s, side).normalized();
          plane.at        = plane.normal.dot(s.corner[(side + 1) % s.corners]);
          plane.tolerance = rounding * (size + std::fabs(plane.at));
        }
      return found;
    }

    /** A convex polygon with room for all cuts of a triangle by four planes, or a segment. */
    struct Polygon
    {
      std::array<Vector3d, 8> corner;
      int                     count = 0;

      void add(const Vector3d &x) { corner[count++] = x; }
    };

    /** Corner of a simplex that is the k-th of a side. */
    int corner_of_side(const Simplex &s, const int side, const int k)
    {
      return s.corners == 4 ? side_of_tetrahedron[side][k] : side_of_triangle[side][k];
    }

    Polygon side_polygon(const Simplex &s, const int side)
    {
      Polygon polygon;
      for (int k = 0; k + 1 < s.corners; ++k)
        polygon.add(s.corner[corner_of_side(s, side, k)]);
      return polygon;
    }

    /** How far the corners of a simplex lie above the planes of another: by plane, then corner. */
    using CornerHeights = std::array<std::array<double, 4>, 4>;

    /** @return false where all lie above one of them: the two are apart */
    bool find_heights(const Simplex &simplex, const Planes &other, CornerHeights &heights)
    {
      for (int k = 0; k < other.count; ++k)
        {
          bool all_above = true;
          for (int c = 0; c < simplex.corners; ++c)
            {
              heights[k][c] = other.side[k].above(simplex.corner[c]);
              all_above     = all_above && heights[k][c] >= 0;
            }
          if (all_above)
            return false;
        }
      return true;
    }

    /**
     * Which corners lie above a plane, in one run from the highest: those of a convex polygon do. Where it nearly lies in the plane,
     * rounding has others above it as well, which stay: a cut adds one corner at most.
     */
    std::array<bool, 8> run_above(const Polygon &polygon, const std::array<double, 8> &above)
    {
      std::array<bool, 8> gone{};
      const int           highest =
        static_cast<int>(std::max_element(above.begin(), above.begin() + polygon.count) - above.begin());
      for (const int way : {1, polygon.count - 1})
        for (int step = 0, k = highest; step < polygon.count && above[k] > 0; ++step, k = (k + way) % polygon.count)
          gone[k] = true;
      return gone;
    }

    /** How far the corners of a polygon lie above a plane. */
    struct Heights
    {
      std::array<double, 8> of;
      double                most = 0; ///< of all, or 0 where none is above
      bool                  all = true, in_plane = true;

      Heights(const Polygon &polygon, const Plane &plane)
      {
        for (int k = 0; k < polygon.count; ++k)
          add(k, plane.above(polygon.corner[k]), plane.tolerance);
      }

      /** Of a whole side, where they are known. */
      Heights(const Simplex &simplex, const int side, const std::array<double, 4> &known, const Plane &plane)
      {
        for (int k = 0; k + 1 < simplex.corners; ++k)
          add(k, known[corner_of_side(simplex, side, k)], plane.tolerance);
      }

    private:
      void add(const int k, const double above, const double tolerance)
      {
        of[k]    = above;
        most     = std::max(most, above);
        all      = all && above > 0;
        in_plane = in_plane && !(std::fabs(above) > tolerance);
      }
    };

    /** A side of which nothing is left below some plane, whatever the others leave of it. */
    bool is_beyond(const Simplex &simplex, const int side, const CornerHeights &heights, const Planes &other)
    {
      for (int k = 0; k < other.count; ++k)
        {
          bool above = true;
          for (int c = 0; c < simplex.corners && above; ++c)
            above = c == side || heights[k][c] > other.side[k].tolerance;
          if (above)
            return true;
        }
      return false;
    }

    /** The part below a plane that some of it is above. */
    void cut(Polygon &polygon, const Heights &above)
    {
      if (above.all)
        {
          polygon.count = 0;
          return;
        }
      const bool                closed = polygon.count > 2;
      const std::array<bool, 8> gone   = run_above(polygon, above.of);
      Polygon                   left;
      for (int k = 0; k < polygon.count; ++k)
        {
          const int next = (k + 1) % polygon.count;
          if (!gone[k])
            left.add(polygon.corner[k]);
          if ((closed || next > k) && gone[k] != gone[next])
            {
              const double part = above.of[k] / (above.of[k] - above.of[next]);
              left.add(polygon.corner[k] + part * (polygon.corner[next] - polygon.corner[k]));
            }
        }
      std::copy_n(left.corner.begin(), left.count, polygon.corner.begin());
      polygon.count = left.count;
    }

    /** Of a simplex of that number in its pair; pieces lie in a side of it. */
    struct SideOf
    {
      int  simplex = 0, side = 0;
      bool twice = false; ///< lies in a piece of the first simplex
    };

    void add_pieces(const Polygon &polygon, const SideOf &of, std::vector<OverlapPiece> &pieces)
    {
      if (polygon.count == 2)
        {
          const Vector3d &a = polygon.corner[0], &b = polygon.corner[1];
          const Vector3d  along = b - a;
          pieces.push_back({of.simplex, of.side, of.twice, {a, b, b}, {along[1], -along[0], 0}});
        }
      for (int k = 1; k + 1 < polygon.count; ++k)
        {
          const Vector3d &a = polygon.corner[0], &b = polygon.corner[k], &c = polygon.corner[k + 1];
          pieces.push_back({of.simplex, of.side, of.twice, {a, b, c}, 0.5 * (b - a).cross(c - a)});
        }
    }

    /** The sides of one simplex, cut by the other. */
    void cut_sides(const Simplex             &simplex,
                   const CornerHeights       &heights,
                   const Planes              &other,
                   const Planes              &own,
                   const bool                 second,
                   std::vector<OverlapPiece> &pieces)
    {
      for (int side = 0; side < simplex.corners; ++side)
        {
          if (is_beyond(simplex, side, heights, other))
            continue;
          Polygon polygon = side_polygon(simplex, side);
          bool    whole   = true;
          SideOf  of{second ? 1 : 0, side};
          for (int k = 0; k < other.count && polygon.count > 0; ++k)
            {
              const Plane  &plane = other.side[k];
              const Heights above = whole ? Heights(simplex, side, heights[k], plane) : Heights(polygon, plane);
              if (above.in_plane && plane.normal.dot(own.side[side].normal) > 0)
                of.twice = second;
              else if (above.most > 0)
                {
                  cut(polygon, above);
                  whole = false;
                }
            }
          if (polygon.count >= simplex.corners - 1)
            add_pieces(polygon, of, pieces);
        }
    }

    Eigen::AlignedBox3d around(const std::vector<OverlapPiece> &pieces, const int corners)
    {
      Eigen::AlignedBox3d box;
      for (const OverlapPiece &piece : pieces)
        for (int c = 0; c < corners; ++c)
          box.extend(piece.corner[c]);
      return box;
    }

    Vector3d middle(const std::vector<OverlapPiece> &pieces, const int corners)
    {
      Vector3d sum = Vector3d::Zero();
      for (const OverlapPiece &piece : pieces)
        for (int c = 0; c < corners; ++c)
          sum += piece.corner[c] / (corners * static_cast<double>(pieces.size()));
      return sum;
    }

    void measure(Overlap &found, const bool plane)
    {
      const int      corners = plane ? 2 : 3; // of a piece
      const Vector3d origin  = found.pieces.front().corner[0];
      Vector3d       moment  = Vector3d::Zero();
      for (const OverlapPiece &piece : found.pieces)
        {
          if (piece.twice)
            continue;
          // The cone from the origin over the piece.
          Vector3d sum = Vector3d::Zero();
          for (int c = 0; c < corners; ++c)
            sum += piece.corner[c] - origin;
          const double volume = piece.area.dot(piece.corner[0] - origin) / corners;
          found.volume += volume;
          moment += volume / (corners + 1) * sum;
        }
      found.volume = std::max(found.volume, 0.0); // where it is thinner than rounding
      if (found.volume > 0)
        found.centroid = origin + moment / found.volume;
      if (!(found.volume > 0) || !around(found.pieces, corners).contains(found.centroid))
        found.centroid = middle(found.pieces, corners);
    }
  } // namespace

  double Simplex::volume() const
  {
    const Vector3d a = corner[1] - corner[0], b = corner[2] - corner[0];
    return corners == 3 ? 0.5 * (a[0] * b[1] - a[1] * b[0]) : a.cross(b).dot(corner[3] - corner[0]) / 6;
  }

  Vector3d Simplex::slope(const int of) const { return -area_of_side(*this, of) / ((corners - 1) * volume()); }

  void find_overlap(const Simplex &first, const Simplex &second, Overlap &found)
  {
    found.volume = 0;
    found.pieces.clear();
    CornerHeights of_corners_of_first, of_corners_of_second;
    const Planes  of_first = planes_of(first);
    if (!find_heights(second, of_first, of_corners_of_second))
      return;
    const Planes of_second = planes_of(second);
    if (!find_heights(first, of_second, of_corners_of_first))
      return;
    cut_sides(first, of_corners_of_first, of_second, of_first, false, found.pieces);
    cut_sides(second, of_corners_of_second, of_first, of_second, true, found.pieces);
    if (!found.pieces.empty())
      measure(found, first.corners == 3);
  }
} // namespace coupling::bodies
