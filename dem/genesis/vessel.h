#pragma once

#include <Eigen/Core>

#include <array>

namespace dem
{
  /** One wall near a particle. */
  struct WallTouch
  {
    double          gap;    ///< between wall and particle, negative when they overlap [m]
    Eigen::Vector3d inward; ///< unit normal of the wall
  };

  /** Walls near one particle. */
  struct WallTouches
  {
    static constexpr int most = 6;

    std::array<WallTouch, most> touch;
    int                         count = 0;

    const WallTouch *begin() const { return touch.data(); }
    const WallTouch *end() const { return touch.data() + count; }
  };

  /**
   * What particles are made in: a box with one corner in the origin (a window, in the plane), or an upright cylinder with its axis along z
   * in the middle of such a box. Its walls are frictionless.
   */
  struct Vessel
  {
    enum class Shape
    {
      box,
      cylinder
    };

    int             dimension = 2;
    Shape           shape     = Shape::box;
    Eigen::Vector3d size      = {0, 0, 0}; ///< edges of the box [m]; the third does not count in the plane

    /** @throws base::InputError for edges that are none, a cylinder in the plane or one that is not round */
    void check() const;
    /** Area [m^2] in the plane, else volume [m^3]. */
    double space() const;
    /** Walls whose gap to a particle is below a margin. */
    WallTouches near(const Eigen::Vector3d &centre, double radius, double margin) const;
    /** A place for a centre where a particle of this radius lies inside, from three numbers in [0, 1). */
    Eigen::Vector3d place(const std::array<double, 3> &random, double radius) const;
  };
} // namespace dem
