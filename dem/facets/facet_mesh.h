#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace dem
{
  /**
   * What a surface is made of: triangles; in the plane segments; or one unbounded plane (in the plane: a line), which is all that lies
   * on the far side of its normal as well.
   *
   * Triangles and segments have no thickness and push from both sides, and no centre of a particle goes through them; unless they
   * bound a body: then they push out of it, from within as well. Their connectivity is free: two facets may share
   * corners by number, by place, or not at all.
   */
  struct FacetMesh
  {
    std::vector<Eigen::Vector3d>             vertex;      ///< [m]
    std::vector<std::array<std::int32_t, 3>> facet;       ///< numbers of vertices; only the first `corners` count
    int                                      corners = 3; ///< of each facet: 3, 2 (segments) or 1 (a plane through it)
    Eigen::Vector3d                          normal  = {0, 0, 0}; ///< of a plane, unit, to where the particles are
    std::vector<signed char> outward; ///< of facets that bound a body: 1 where facet_normal() leaves it, -1 where not

    std::size_t size() const { return facet.size(); }
    bool        is_plane() const { return corners == 1; }
    /** @param normal of any length */
    static FacetMesh plane(const Eigen::Vector3d &point, const Eigen::Vector3d &normal);
  };

  /**
   * Refuse what is no surface: no facet at all, a vertex that is not there or not finite, a facet of zero length or area, or one that
   * does not fit the dimension (in two dimensions segments in the plane z = 0).
   * @param name of the surface, for the message @throws base::InputError naming the facet, counted from 1
   */
  void check_facets(const FacetMesh &mesh, const std::string &name, int dimension);

  /** Point of a facet, and which part in its motion its corners have. */
  struct FacetPoint
  {
    Eigen::Vector3d       place;  ///< [m]
    std::array<double, 3> weight; ///< shape functions N_i of the corners there; sum 1, sum of N_i x_i is the place
  };

  /** Unit normal: of a triangle by the right hand about its corners, of a segment to the left. */
  Eigen::Vector3d facet_normal(const std::array<Eigen::Vector3d, 3> &corner, bool segment);

  /** Point of a triangle that is nearest to x; C. Ericson, Real-Time Collision Detection (2005), 5.1.5. */
  FacetPoint closest_on_triangle(const std::array<Eigen::Vector3d, 3> &corner, const Eigen::Vector3d &x);
  /** The same of a segment between the first two corners. */
  FacetPoint closest_on_segment(const std::array<Eigen::Vector3d, 3> &corner, const Eigen::Vector3d &x);
  /** The same of a facet of a mesh, with its vertices at the places given. */
  FacetPoint closest_on_facet(const FacetMesh                    &mesh,
                              const std::vector<Eigen::Vector3d> &vertex,
                              std::size_t                         facet,
                              const Eigen::Vector3d              &x);
} // namespace dem
