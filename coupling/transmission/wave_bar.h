#pragma once

#include "coupling/transmission/wave_case.h"

namespace coupling
{
  /**
   * The same in a bar of spheres without order, between two continua of their density and homogenised stiffness: the packet starts in its
   * middle into both directions. Sides slide, so that it is plane. @throws base::InputError where the packing is not stiff
   */
  WaveAnswer transmit_in_bar(const WaveCase &wave);
} // namespace coupling
