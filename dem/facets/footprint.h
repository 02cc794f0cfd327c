#pragma once

#include "dem/facets/contact_zones.h"
#include "dem/facets/flat_faces.h"
#include "dem/facets/ground.h"

#include <vector>

namespace dem
{
  /** Point of the undeformed face on which a contact stands: the next step searches near it first. */
  struct FacePoint
  {
    std::int32_t    facet = -1;        ///< that holds it; -1: the contact stands on no flat face
    Eigen::Vector3d place = {0, 0, 0}; ///< [m]
  };

  /** A sphere's contact, spread over the facets under it. */
  struct SpreadContact
  {
    std::vector<VertexWeight> weights; ///< each vertex once; sum 1
    Eigen::Vector3d           place;   ///< sum of weight and vertex [m]
    double                    overlap; ///< of the mean surface [m]; not positive where it is not reached
    FacePoint                 stands;
  };

  /** What is found, and memory that is used again. */
  struct SpreadRoom
  {
    SpreadContact found;
    cells::Cover  cover;
  };

  /** A sphere that touches a surface. */
  struct TouchingSphere
  {
    const std::vector<StandingSphere> &spheres; ///< itself first, then those that may stand beside it
    double                             reaches; ///< how far from its centre it touches [m]
    FacePoint                          before;  ///< where its contact stood; only a better start of the search
  };

  /**
   * Spreads contacts of spheres that are large beside the facets (doc/theory/facets.md, 7): each acts on its cell in the tangential plane:
   * the part that is nearer to it than to those that stand beside it, so that equal spheres in a regular layer press like a uniform
   * pressure whatever the facets and however the layer is turned. Weights are the integrals of the shape functions over that part of
   * the cell that has as much surface beyond the contact as before it: the mean place stays where the contact is. Beside an edge of the
   * surface that part is narrower, and on the edge a point.
   *
   * On a face that was flat contacts are those with its mean surface, at the nearest point of that (dem/facets/mean_surface.h): their
   * forces are the slope of their energy whatever the dent.
   */
  class Footprint
  {
  public:
    Footprint() = default;
    /** @param mesh with its vertices where they are in the undeformed surface */
    explicit Footprint(const FacetMesh &mesh);

    bool given() const { return around.given(); }
    /** Distance from its centre within which a sphere finds facets, over its radius: a dent under it is deeper than the mean surface. */
    static constexpr double reach = 1.1;
    /** Spheres further apart than this part of the sum of their radii do not bound each other's cell. */
    static constexpr double widest = 2.2;

    /**
     * @param mesh that it was made from @param place of the vertices now @param zone in which the sphere touches
     * @return false where all of the cell lies in one facet: then the contact is what it was
     */
    bool spread(const FacetMesh                    &mesh,
                const std::vector<Eigen::Vector3d> &place,
                const ContactZone                  &zone,
                const TouchingSphere               &touching,
                SpreadRoom                         &room) const;

    /** Whether two contacts stand on the same flat face. */
    bool share_face(const std::int32_t one, const std::int32_t other) const { return faces.share_face(one, other); }

    /** Of nearest points those that can be contacts of their own: dents of a flat face are no hollows (dem/facets/flat_faces.h). */
    void keep_own(const FacetMesh                    &mesh,
                  const std::vector<Eigen::Vector3d> &place,
                  const Eigen::Vector3d              &centre,
                  std::vector<NearPoint>             &near) const
    {
      faces.keep_nearest(mesh, place, centre, near);
    }

  private:
    FacetsAround around;
    FlatFaces    faces;
  };
} // namespace dem
