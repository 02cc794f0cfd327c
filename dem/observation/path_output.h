#pragma once

#include "dem/model/particles.h"
#include "dem/specimen/results.h"
#include "dem/statics/quasi_static_path.h"

#include <vector>

namespace dem
{
  /** Displacement of each particle of a loaded network [m]. */
  std::vector<Eigen::Vector3d> displacements_of(const LoadedNetwork &loaded, const LoadedMotion &motion);

  /**
   * A point of a quasi-static path as observers of a Specimen see it: nothing moves (velocities are zero), stresses refer to the
   * particle's share of the volume by its own, exhausted links count as broken.
   *
   * @param radius of each particle [m]
   */
  ParticleOutput particles_of(const LoadedNetwork       &loaded,
                              const QuasiStaticPath     &path,
                              const std::vector<double> &radius,
                              const ParticleShape       &shape);

  /** The links of the same. */
  LinkOutput links_of(const LoadedNetwork &loaded, const QuasiStaticPath &path);
} // namespace dem
