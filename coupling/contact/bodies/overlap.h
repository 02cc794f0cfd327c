#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace coupling::bodies
{
  /** A tetrahedron, or in the plane a triangle, at the places of its corners; its volume is positive. */
  struct Simplex
  {
    int                            corners = 4; ///< 4: tetrahedron, 3: triangle in the plane z = 0
    std::array<Eigen::Vector3d, 4> corner;      ///< [m]

    double volume() const; ///< signed [m^3]; of a triangle its area [m^2]
    /** Slope of the barycentric coordinate that is one in a corner [1/m]. */
    Eigen::Vector3d slope(int of) const;
  };

  /** A piece of the boundary of an overlap: a triangle, or in the plane a segment. */
  struct OverlapPiece
  {
    int                            of    = 0;     ///< 0: of the first simplex, 1: of the second
    int                            side  = 0;     ///< of it, the one opposite to this corner
    bool                           twice = false; ///< lies in a piece of the first simplex, and bounds no other volume
    std::array<Eigen::Vector3d, 3> corner;        ///< [m]; of a segment the first two
    Eigen::Vector3d                area; ///< outward from the overlap, as long as the piece is large [m^2 or m]
  };

  /** What two simplices have in common. */
  struct Overlap
  {
    double                    volume   = 0;                       ///< [m^3], in the plane the area [m^2]
    Eigen::Vector3d           centroid = Eigen::Vector3d::Zero(); ///< [m]
    std::vector<OverlapPiece> pieces;                             ///< of its boundary; none: the simplices are apart
  };

  /**
   * Sides of each simplex cut by the planes of the other bound the overlap; its volume and centroid follow from them (Gauss).
   * @param found its room is used again
   */
  void find_overlap(const Simplex &first, const Simplex &second, Overlap &found);
} // namespace coupling::bodies
