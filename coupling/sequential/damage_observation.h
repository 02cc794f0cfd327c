#pragma once

#include "coupling/sequential/averaging.h"

namespace coupling
{
  /**
   * The damage that governs the strength of a strained specimen, as points of a transfer would get it: the mean tensor of all particles
   * where every point takes that one, and otherwise of the slab across the axis with the largest mean damage, as thick as the kernel
   * is wide.
   * @param element_size [m], for kernels whose width follows from it
   */
  Eigen::Matrix3d
  observed_damage(const ParticleField &field, const AveragingOptions &averaging, int axis, double element_size);
} // namespace coupling
