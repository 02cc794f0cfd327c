#pragma once

#include "dem/facets/contact_zones.h"
#include "dem/facets/surface.h"
#include "dem/model/particles.h"

#include <vector>

namespace dem
{
  /**
   * Whether the centre of a particle has gone through facets in the last step: whether its way, as seen from a facet that moves as
   * well, pierces one of them.
   *
   * @param near points of all facets that it may have reached @param centre where it is @param moved in the step [m]
   */
  bool goes_through(const Surface                &surface,
                    const std::vector<NearPoint> &near,
                    const Eigen::Vector3d        &centre,
                    const Eigen::Vector3d        &moved);

  /**
   * Whether a place lies on the inner side of facets that bound a body, at the point that is nearest to it: by the normals of all
   * facets that meet there, each by its angle.
   *
   * @pre surface.mesh.outward
   */
  bool lies_behind(const Surface                &surface,
                   const std::vector<NearPoint> &near,
                   const NearPoint              &nearest,
                   const Eigen::Vector3d        &centre);

  /** A particle whose centre has gone so deep that its contact is lost. @throws base::NumericalError always, naming both */
  [[noreturn]] void refuse_sunk(const Particles &particles, std::int32_t particle, const Surface &surface);
} // namespace dem
