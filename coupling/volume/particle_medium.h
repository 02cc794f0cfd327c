#pragma once

#include "base/voigt.h"
#include "dem/model/materials.h"
#include "dem/network/elastic_network.h"
#include "fem/points/material_points.h"

#include <optional>

namespace coupling
{
  /** What particles are to a solid around them that is too coarse to see them. */
  struct ParticleMedium
  {
    /** Of the periodic cell, particles in equilibrium [Pa]. In the plane, what is out of it is stiff by itself alone. */
    base::Stiffness stiffness = base::Stiffness::Zero();
    double          density   = 0; ///< of the bulk [kg/m^3]
  };

  /**
   * The medium that a periodic cell of particles is.
   * @param density of the particles that have none of their own [kg/m^3] @return none: the cell does not resist every strain
   */
  std::optional<ParticleMedium> medium_of_cell(const dem::Packing           &cell,
                                               const dem::NetworkParameters &links,
                                               const dem::LinkMaterials     &materials,
                                               double                        density);

  /** Elastic waves along an axis, at right angles to an interface: energy that media of other impedances reflect, of compression and of shear. */
  struct Mismatch
  {
    double compression = 0, shear = 0;
  };

  /** What a solid's stiffness acts in. */
  struct StressState
  {
    int        dimension = 3;
    fem::Plane plane     = fem::Plane::strain; ///< in the plane only
  };

  /** The worst of the axes. @param density of the solid [kg/m^3]; 0: both are as heavy */
  Mismatch reflected_by_mismatch(const ParticleMedium  &medium,
                                 const base::Stiffness &solid,
                                 double                 density,
                                 const StressState     &state);

  /** By how much a solid's stiffness is another one, over the norm of the particles'; in the plane what acts in it. */
  double difference_of_stiffness(const ParticleMedium &medium, const base::Stiffness &solid, const StressState &state);
} // namespace coupling
