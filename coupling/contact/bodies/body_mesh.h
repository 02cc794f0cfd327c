#pragma once

#include "coupling/contact/bodies/overlap.h"

#include <cstdint>
#include <string>
#include <vector>

namespace coupling::bodies
{
  /** A simplex of a body. */
  struct BodySimplex
  {
    std::array<std::int32_t, 4> vertex{};
    std::int32_t                element = 0;
    std::uint8_t                surface = 0; ///< bit k: the side opposite to corner k is part of the body's surface
    std::uint8_t inward = 0; ///< bit k: behind that side there is more of the body, which is not in the mesh
  };

  /** An element of a body: what simplices were made of. */
  struct BodyElement
  {
    std::int32_t body = 0;
    double       size = 0; ///< volume to the power of 2/3 [m^2], in the plane square root of the area times thickness
    std::vector<std::int32_t> vertices;
  };

  /**
   * Deformable bodies as contact sees them: simplices that fill a layer under their surfaces, whose vertices somebody
   * else moves. `depth` is zero on the surface and grows inwards; within a simplex it is linear.
   */
  struct BodyMesh
  {
    int                          corners   = 4; ///< of a simplex: 4 in space, 3 in the plane
    double                       thickness = 1; ///< in the plane [m]
    std::vector<Eigen::Vector3d> place;         ///< of the vertices [m]
    std::vector<double>          depth;         ///< of the vertices below the surface of the undeformed body [m]
    std::vector<BodySimplex>     simplices;
    std::vector<BodyElement>     elements;
    std::vector<std::string>     bodies; ///< names

    std::int32_t body_of(const BodySimplex &s) const { return elements[static_cast<std::size_t>(s.element)].body; }
    Simplex      at(const BodySimplex &s) const
    {
      Simplex simplex;
      simplex.corners = corners;
      for (int c = 0; c < corners; ++c)
        simplex.corner[c] = place[static_cast<std::size_t>(s.vertex[c])];
      return simplex;
    }
  };
} // namespace coupling::bodies
