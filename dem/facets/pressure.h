#pragma once

#include "dem/facets/contact_zones.h"
#include "dem/facets/surface.h"

#include <vector>

namespace dem
{
  /** Part of a contact that a vertex of its surface has. */
  struct VertexPart
  {
    std::int32_t    vertex;
    double          weight;    ///< in the motion of the place; all of a contact add up to 1
    Eigen::Vector3d force;     ///< of the particle on it [N]
    double          stiffness; ///< across the surface that it feels: sum of k N_i [N/m]
  };

  /** Where and how a sphere presses on a surface with a skin. */
  struct PressedPatch
  {
    Eigen::Vector3d place     = Eigen::Vector3d::Zero(); ///< centre of pressure [m]
    Eigen::Vector3d push      = Eigen::Vector3d::Zero(); ///< on the sphere [N]
    double          total     = 0;                       ///< integral of the pressure [N]
    double          stiffness = 0;                       ///< of the whole patch [N/m]
    double          spring    = 0;                       ///< stored in the skin [J]
    double          deepest   = 0;                       ///< overlap [m]
    std::int32_t    facet     = -1;                      ///< of the deepest
    bool            touches() const { return total > 0; }
  };

  /**
   * The pressure between a sphere and the facets near it (doc/theory/facets.md, 6): the modulus of the contact over the thickness of the
   * skin, times the overlap, towards and away from the centre, integrated over the facets as large as they were made. It is the slope
   * of an energy: work is kept on both sides.
   *
   * @param near nearest points within the radius; only their facets are visited
   * @param thickness of discs [m]; 1 of spheres
   * @param parts those of the vertices are appended: weights, and forces of the pressure alone
   */
  PressedPatch press(const Surface                &surface,
                     const std::vector<NearPoint> &near,
                     const Eigen::Vector3d        &centre,
                     double                        radius,
                     double                        thickness,
                     std::vector<VertexPart>      &parts);
} // namespace dem
