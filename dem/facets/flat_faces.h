#pragma once

#include "dem/facets/contact_zones.h"
#include "dem/facets/facets_around.h"

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
    bool beyond_rim(const FacetMesh                    &mesh,
                    const std::vector<Eigen::Vector3d> &place,
                    const Eigen::Vector3d              &centre,
                    const NearPoint                    &point) const;

    std::vector<std::int32_t>        face; ///< of each facet; -1: not flat, or goes on evenly
    std::vector<std::array<bool, 3>> rim;  ///< of each facet: whether the side across from that corner ends the face
  };
} // namespace dem
