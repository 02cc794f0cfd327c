#pragma once

#include "dem/facets/footprint.h"
#include "dem/facets/ground.h"

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
    /** @param zone of one point @param spheres the one that touches first; others bound its cell. All but them must outlive it */
    MeanSurface(const FacetMesh                    &mesh,
                const FacetsAround                 &around,
                const std::vector<Eigen::Vector3d> &place,
                const ContactZone                  &zone,
                const std::vector<StandingSphere>  &spheres);

    /** @param reaches how far from its centre the sphere touches [m] @return false where nothing is spread */
    bool nearest(double reaches, SpreadContact &found) const;

  private:
    /** The mean place about a point of the undeformed face. */
    struct Mean
    {
      cells::Point                   at     = cells::Point::Zero(); ///< from where the search begins [m]
      bool                           inside = false;                ///< the face
      bool                           whole  = false;                ///< the cell: it ends nowhere
      double                         area   = 0;                    ///< of it that counts [m^2]
      std::int32_t                   facet  = 0;                    ///< that holds the point
      std::vector<VertexWeight>      weights;
      Eigen::Vector3d                place = {0, 0, 0}; ///< [m]
      std::array<Eigen::Vector3d, 2> along;             ///< how it moves with the point [-]
    };

    Mean            mean_at(const cells::Point &at, std::int32_t from) const;
    Eigen::Vector3d moves(const Mean &mean, int along) const;
    cells::Point    step(const Mean &mean) const;

    const FacetMesh                    &mesh;
    const FacetsAround                 &around;
    const std::vector<Eigen::Vector3d> &place;
    Eigen::Vector3d                     centre;   ///< of the sphere [m]
    double                              radius;   ///< [m]
    std::int32_t                        first;    ///< facet where the search begins
    cells::Tangents                     tangents; ///< of the undeformed face, where the search begins
    cells::Polygon                      cell;
  };
} // namespace dem
