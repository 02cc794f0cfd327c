#pragma once

#include "dem/facets/footprint.h"

namespace dem
{
  /**
   * A flat face as a sphere feels it: the mean place of its cell, M(s) = sum_i w_i(s) x_i, over the point s of the undeformed face about
   * which that lies. The weights are those of the undeformed face: they turn with the body and do not depend on where its vertices are.
   * A contact is where M is nearest to the centre: there its overlap does not depend on s, and with the weights as parts of the vertices
   * its force is the slope of its energy, exactly, for the sphere and for every vertex (doc/theory/facets.md, 7).
   */
  class MeanSurface
  {
  public:
    /** @param place of the vertices now @param zone of one point on a flat face. All parameters must outlive it */
    MeanSurface(const FacetMesh                    &mesh,
                const FlatFaces                    &faces,
                const std::vector<Eigen::Vector3d> &place,
                const ContactZone                  &zone,
                const TouchingSphere               &touching);

    /** @return false where nothing is spread */
    bool nearest(const FacetsAround &around, SpreadRoom &room) const;

  private:
    /** The mean place about a point of the undeformed face, from the centre. */
    struct Mean
    {
      cells::Point                   at     = cells::Point::Zero(); ///< in the plane of the face [m]
      std::int32_t                   facet  = 0;                    ///< that holds the point
      bool                           inside = false;                ///< the face
      bool                           whole  = false;                ///< the cell: it ends nowhere
      double                         area   = 0;                    ///< of it that counts [m^2]
      Eigen::Vector3d                place  = {0, 0, 0};            ///< [m]
      std::array<Eigen::Vector3d, 2> along;                         ///< how it moves with the point [-]
      cells::Point                   slope; ///< how fast it comes nearer, times the distance [m]
      Eigen::Matrix2d                bend;  ///< second derivatives of half its square distance [-]
    };

    Mean mean_at(const cells::Point &at, std::int32_t from, const FacetsAround &around, cells::Cover &cover) const;
    void integrate(Mean &mean, const cells::Cover &cover) const;
    cells::Point step(const Mean &mean) const;
    bool         nearer(const Mean &next, const Mean &now) const;

    const FacetMesh                    &mesh;
    const FlatFaces                    &faces;
    const std::vector<Eigen::Vector3d> &place;
    const TouchingSphere               &touching;
    Eigen::Vector3d                     centre;  ///< of the sphere [m]
    double                              radius;  ///< [m]
    cells::Polygon                      cell;    ///< about the point of the zone, in the plane of the face
    double                              whole;   ///< its area [m^2]
    bool                                spreads; ///< it lies in more than one facet, and on more than the rim
    std::int32_t                        from;    ///< facet where the search begins, and the point in it
    cells::Point                        start;
  };
} // namespace dem
