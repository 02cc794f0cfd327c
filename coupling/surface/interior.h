#pragma once

#include "dem/facets/facet_mesh.h"

#include <Eigen/Geometry>

namespace coupling
{
  /** What a closed surface of triangles, in the plane of segments, encloses. */
  class Interior
  {
  public:
    /** @param mesh its facets may have any orientation */
    explicit Interior(dem::FacetMesh mesh);

    /** By the number of facets between it and infinity: odd inside. */
    bool holds(const Eigen::Vector3d &x) const;

  private:
    dem::FacetMesh      facets;
    Eigen::AlignedBox3d around;
  };
} // namespace coupling
