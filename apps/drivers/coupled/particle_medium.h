#pragma once

#include "apps/drivers/continuum/materials.h"
#include "apps/scene/material_section.h"
#include "apps/scene/specimen_section.h"
#include "base/voigt.h"
#include "dem/model/packing.h"

#include <filesystem>
#include <optional>

namespace apps
{
  /** What particles are to a solid around them that is too coarse to see them. */
  struct ParticleMedium
  {
    base::Stiffness stiffness = base::Stiffness::Zero(); ///< of the periodic cell, particles in equilibrium [Pa]
    double          density   = 0;                       ///< of the bulk [kg/m^3]

    /** As `breccia homogenise` writes it, and the density. @throws postprocess::OutputError */
    void write(const std::filesystem::path &file) const;
    /** What a run has written into its folder; none where it wrote none. @throws base::InputError */
    static std::optional<ParticleMedium> kept_in(const std::filesystem::path &folder);

    static constexpr const char *file_name = "homogenised.json";
  };

  /**
   * None where there is no periodic cell, or a plane, or materials by regions; and where the cell does not resist every strain.
   * @param rotations whether particles spin
   */
  std::optional<ParticleMedium> medium_of(const std::optional<dem::Packing> &cell,
                                          const SpecimenSection             &specimen,
                                          const MaterialSection             &material,
                                          int                                dimension,
                                          bool                               rotations);

  /** Materials that are homogenised become the medium. @throws base::InputError where there is none */
  void give_medium(const MaterialsSection &materials, const std::optional<ParticleMedium> &medium);

  /** Elastic waves along an axis, at right angles to an interface: energy that media of other impedances reflect, of compression and of shear. */
  struct Mismatch
  {
    double compression = 0, shear = 0;
  };

  /** The worst of the three axes. @param density of the solid [kg/m^3]; 0: both are as heavy */
  Mismatch reflected_by_mismatch(const ParticleMedium &medium, const base::Stiffness &solid, double density);
} // namespace apps
