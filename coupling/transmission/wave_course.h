#pragma once

#include "coupling/transmission/wave_case.h"

#include <Eigen/Core>

namespace coupling
{
  /** Where a packet of waves begins and how long it is under way, and the bodies around it. Particles end with the overlap, which begins at x = 0. */
  struct WaveCourse
  {
    double          width = 0;                                ///< sigma of the envelope exp(-(s/sigma)^2) [m]
    Eigen::Vector3d start, direction;                         ///< its centre [m], where it goes
    double          overlap_end = 0;                          ///< [m]
    double          left = 0, right = 0, bottom = 0, top = 0; ///< of particles or continuum [m]
    double          duration = 0;                             ///< until the packet has passed [s]
  };

  /** In the plane. */
  WaveCourse course_of(const WaveCase &wave);

  /** Velocity of a packet that is about to run into both directions, over its amplitude. @param shear across its way */
  Eigen::Vector3d packet_velocity(const WaveCase &wave, const WaveCourse &course, const Eigen::Vector3d &place);
} // namespace coupling
