#pragma once

#include "coupling/contact/bodies/body_contact_parameters.h"
#include "coupling/contact/bodies/body_mesh.h"

namespace coupling::bodies
{
  /** What an overlap of two simplices does (doc/theory/body-contact.md, 3). */
  struct OverlapForce
  {
    std::array<std::array<Eigen::Vector3d, 4>, 2> force;  ///< on the corners of either [N]
    std::array<std::array<double, 4>, 2>          weight; ///< barycentric coordinates of the centroid [-]
    Eigen::Vector3d                               on_first = Eigen::Vector3d::Zero(); ///< resultant [N]
    Eigen::Vector3d                               place    = Eigen::Vector3d::Zero(); ///< centroid [m]
    Eigen::Vector3d area       = Eigen::Vector3d::Zero(); ///< of both surfaces in it, from the first outwards [m^2]
    double          volume     = 0;                       ///< [m^3]
    double          stored     = 0;                       ///< energy of the potential [J]
    double          stiffness  = 0;                       ///< of the normal force, at most [N/m]
    bool            too_deep   = false;                   ///< it reaches further into a body than the mesh of it
    bool            inside_out = false;                   ///< a simplex has no volume left
  };

  /**
   * @param stiffness k_v [N/m^3]
   *
   * Potential: U = k_v/2 int (d_1 + d_2) dV over the overlap, d the depth below the surface of either body (after Munjiza, The Combined
   * Finite-Discrete Element Method, 2004, chapter 2); forces are its exact slope with respect to the corners, so that deformable bodies
   * get back what they gave. Terms of sides inside a body cancel between neighbours and are left out.
   *
   * Penalty: k_v V at the centroid, across the plane of the intersection of both surfaces (after Frenning, Comput. Methods Appl. Mech. Eng.
   * 197, 2008).
   */
  OverlapForce overlap_force(const BodyMesh    &mesh,
                             const BodySimplex &first,
                             const BodySimplex &second,
                             BodyContactForm    form,
                             double             stiffness,
                             Overlap           &room);
} // namespace coupling::bodies
