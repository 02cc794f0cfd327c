#pragma once

#include "dem/facets/contact_zones.h"
#include "dem/facets/facets_around.h"
#include "dem/facets/ground.h"

namespace dem
{
  /**
   * Faces of a surface that were flat when it was made, each as large as it can be, and bounded by nothing that goes on from it by less
   * than 40 degrees: those of a block, and not those of a cylinder's round.
   */
  class FlatFaces
  {
  public:
    FlatFaces() = default;
    /** @param mesh with its vertices where they are in the undeformed surface */
    FlatFaces(const FacetMesh &mesh, const FacetsAround &around);

    bool is_flat(const std::int32_t facet) const { return face[static_cast<std::size_t>(facet)] >= 0; }
    /** Whether both are of the same flat face; -1 is of none. */
    bool share_face(const std::int32_t one, const std::int32_t other) const
    {
      return one >= 0 && is_flat(one) && face[static_cast<std::size_t>(one)] == face[static_cast<std::size_t>(other)];
    }
    /** The plane of the face that a facet is of, undeformed. @pre is_flat(facet) */
    const cells::Tangents &plane_of(const std::int32_t facet) const
    {
      return plane[static_cast<std::size_t>(face[static_cast<std::size_t>(facet)])];
    }
    /** A facet of a flat face in that plane. */
    const cells::Facet &in_plane(const std::int32_t facet) const { return seen[static_cast<std::size_t>(facet)]; }
    /** Whether a point of a facet lies where the face ends. @param weight of its corners */
    bool on_rim(std::int32_t facet, const std::array<double, 3> &weight) const;

    /**
     * Of each flat face keep the point that is nearest to the centre, and those on its rim beyond which the centre lies: others are parts
     * of the same dent. @param place of the vertices now @param near its order may change
     */
    void keep_nearest(const FacetMesh                    &mesh,
                      const std::vector<Eigen::Vector3d> &place,
                      const Eigen::Vector3d              &centre,
                      std::vector<NearPoint>             &near) const;

  private:
    void join(const FacetMesh &mesh, const FacetsAround &around);
    void find_rims(const FacetMesh &mesh);
    void see(const FacetMesh &mesh);
    bool beyond_rim(const FacetMesh                    &mesh,
                    const std::vector<Eigen::Vector3d> &place,
                    const Eigen::Vector3d              &centre,
                    const NearPoint                    &point) const;

    std::vector<std::int32_t>        face;  ///< of each facet; -1: not flat, or goes on evenly
    std::vector<std::array<bool, 3>> rim;   ///< of each facet: whether the side across from that corner ends the face
    std::vector<std::array<bool, 3>> tip;   ///< of each facet: whether that corner lies on a side that does
    std::vector<cells::Tangents>     plane; ///< of each face that was visited, flat or not
    std::vector<cells::Facet>        seen;  ///< of each facet of a flat face, in the plane of that
  };
} // namespace dem
