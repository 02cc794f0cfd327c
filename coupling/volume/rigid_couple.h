#pragma once

#include "coupling/volume/multipliers.h"

#include <Eigen/Core>

namespace coupling
{
  /**
   * The smallest impulses on nodes, in the norm of their masses, that have no sum and are a couple: those of a rigid rotation about their
   * centre, m w x (x - c) with J w = couple (doc/theory/volume-coupling.md, 3). Where nodes lie on a line, what would turn them about it is left out.
   *
   * @param couple [N m s] @param places now [m] @param mass of each node, along each axis [kg]; one that is held along any takes nothing
   * @param inverse likewise, zero where held [1/kg]
   */
  CarrierRows impulses_of_couple(const Eigen::Vector3d &couple,
                                 const CarrierRows     &places,
                                 const CarrierRows     &mass,
                                 const CarrierRows     &inverse,
                                 int                    dimension);
} // namespace coupling
