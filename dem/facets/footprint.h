#pragma once

#include "dem/facets/contact_zones.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /** Part of a vertex in the place of a contact. */
  struct VertexWeight
  {
    std::int32_t vertex;
    double       weight;
  };

  /** A sphere's contact, spread over the facets under it. */
  struct SpreadContact
  {
    std::vector<VertexWeight> weights; ///< each vertex once; sum 1
    Eigen::Vector3d           place;   ///< sum of weight and vertex [m]
    double                    overlap; ///< of the mean surface [m]; not positive where it is not reached
  };

  /**
   * Spreads contacts of spheres that are large beside the facets (doc/theory/facets.md, 7): each acts on a square in the tangential plane as
   * wide as the sphere, its cell in a square layer, so that equal spheres side by side press like a uniform pressure whatever the
   * facets. Weights are the integrals of the shape functions over that part of the square that has as much surface beyond the contact
   * as before it: the mean place stays where the contact is. Beside an edge of the surface that part is narrower, and on the edge a point.
   */
  class Footprint
  {
  public:
    Footprint() = default;
    /** @param mesh with its vertices where they are in the undeformed surface */
    explicit Footprint(const FacetMesh &mesh);

    bool given() const { return !from.empty(); }
    /** How far from its centre a sphere looks for facets, over its radius: a dent under it is deeper than the mean surface. */
    static constexpr double reach = 1.1;

    /**
     * @param mesh that it was made from @param place of the vertices now @param found its room is used again
     * @return false where all of the square lies in one facet: then the contact is what it was
     */
    bool spread(const FacetMesh                    &mesh,
                const std::vector<Eigen::Vector3d> &place,
                const ContactZone                  &zone,
                double                              radius,
                SpreadContact                      &found) const;

  private:
    std::vector<std::size_t>  from;   ///< of each vertex, in the next
    std::vector<std::int32_t> around; ///< facets of each vertex
  };
} // namespace dem
