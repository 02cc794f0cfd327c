#pragma once

#include <array>
#include <string>
#include <vector>

/** What the built-in shapes are made from: numbers alone, so that a scene can hold them without knowing any mesh. */
namespace fem
{
  /// Shape of the elements: quadrilaterals and hexahedra, or triangles and tetrahedra.
  enum class ElementFamily
  {
    hypercube,
    simplex
  };

  /// From the origin to `size` [m]. Boundaries left, right (x), bottom, top (y), back, front (z).
  struct BoxShape
  {
    std::array<double, 3>       size{1, 1, 1};
    std::array<unsigned int, 3> divisions{1, 1, 1};
    std::array<double, 3>       growth{1, 1, 1}; ///< size of an element over that of its neighbour towards the origin
  };

  /// One of several boxes. Its boundaries bear its name before theirs: "NAME left".
  struct NamedBox
  {
    std::string                 name, material = "solid";
    std::array<double, 3>       corner{}; ///< of least coordinates [m]
    std::array<double, 3>       size{1, 1, 1};
    std::array<unsigned int, 3> divisions{1, 1, 1};
  };

  /// One of several balls, in the plane discs; all of its surface is the boundary of its name.
  struct NamedBall
  {
    std::string           name, material = "solid";
    std::array<double, 3> centre{};      ///< [m]
    double                radius    = 1; ///< [m]
    unsigned int          divisions = 8; ///< elements around a quarter of the circumference, even
    std::array<double, 3> towards{};     ///< side on which elements are finest, of any length
    double                fineness = 1;  ///< how much smaller they are there than elsewhere
  };

  /// Several bodies, which share no node even where they touch.
  struct BodiesShape
  {
    std::vector<NamedBox>  boxes;
    std::vector<NamedBall> balls;
  };

  /**
   * Beam along x, from the origin to (length, height, width), with a notch of rectangular section from below at
   * mid-span.
   *
   * Elements are fine in a band around the notch; there are nodes at both supports and at the edges of the notch, and a column of
   * elements at mid-span.
   * Boundaries left, right, bottom, top, back, front, notch. The mesh is symmetric about mid-span.
   */
  struct NotchedBeamShape
  {
    double       length = 0, height = 0, width = 0; ///< [m]; width in three dimensions
    double       span        = 0;                   ///< between the supports [m], not above the length
    double       notch_depth = 0, notch_width = 0;  ///< [m]
    double       fine_size = 0, coarse_size = 0;    ///< largest edges of the elements, in the band and beside it [m]
    double       band            = 0;               ///< width of the fine band [m], above the notch's
    unsigned int width_divisions = 1;
  };

  /// Quarter of a plate with a circular hole around the origin. Boundaries hole, left (x = 0), bottom (y = 0), right, top, back,
  /// front.
  struct PlateWithHoleShape
  {
    double       radius     = 0;                             ///< of the hole [m]
    double       half_width = 0, half_height = 0, depth = 0; ///< of the whole plate [m]; depth in three dimensions
    unsigned int radial_divisions = 16, angular_divisions = 16, depth_divisions = 1; ///< angular: even
  };

  /// Round bar along x from the origin. Boundaries left, right, side. Three dimensions only.
  struct CylinderShape
  {
    double       length = 0, radius = 0; ///< [m]
    unsigned int divisions = 8;          ///< along the axis; across there are five blocks, refined with the rest
  };
}
