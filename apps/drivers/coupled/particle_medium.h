#pragma once

#include "apps/drivers/continuum/model.h"
#include "apps/drivers/coupled/handshakes.h"
#include "apps/scene/material_section.h"
#include "apps/scene/specimen_section.h"
#include "base/voigt.h"
#include "dem/model/packing.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace apps
{
  /** What particles are to a solid around them that is too coarse to see them. */
  struct ParticleMedium
  {
    /** Of the periodic cell, particles in equilibrium [Pa]. In the plane, what is out of it is stiff by itself alone. */
    base::Stiffness stiffness = base::Stiffness::Zero();
    double          density   = 0; ///< of the bulk [kg/m^3]
  };

  /** What particles would be in the places of the solid: of each group of elements. */
  class ParticleMedia
  {
  public:
    /** Nothing is known. */
    ParticleMedia() = default;

    bool empty() const { return of_group.empty(); }
    /** nullptr: not known, or it would be several */
    const ParticleMedium *of(const std::string &group) const;
    /** Materials of the particles that would be in a group's places, where these are several; "" where no region is. */
    std::vector<std::string> several_in(const std::string &group) const;

    void set(const std::string &group, const ParticleMedium &medium) { of_group[group] = medium; }
    void set_several(const std::string &group, std::vector<std::string> materials)
    {
      mixed[group] = std::move(materials);
    }

    /** As `breccia homogenise` writes it, and the density; where groups differ, of each of them. @throws postprocess::OutputError */
    void write(const std::filesystem::path &file) const;
    /** What a run has written into its folder; nothing where it wrote none. @throws base::InputError */
    static ParticleMedia kept_in(const std::filesystem::path &folder, const ContinuumModel &continuum);

    static constexpr const char *file_name = "homogenised.json";

  private:
    std::map<std::string, ParticleMedium>           of_group;
    std::map<std::string, std::vector<std::string>> mixed;
  };

  /** The particles of a scene, as far as their medium goes. */
  struct MediumSource
  {
    const std::optional<dem::Packing> &cell; ///< periodic, of which they are a part
    const SpecimenSection             &specimen;
    const MaterialSection             &material;
    int                                dimension = 3;
    bool                               rotations = true; ///< whether particles spin
  };

  /**
   * Nothing where there is no periodic cell, or it does not resist every strain. Of a group of elements whose places lie in one region of
   * a material, the cell with all its particles of that; where no region is, with materials as the packing numbers them.
   * @param handshakes what of the elements goes
   */
  ParticleMedia
  media_of(const MediumSource &source, const ContinuumModel &continuum, const HandshakesSection &handshakes);

  /** Materials that are homogenised become the medium of their group. @throws base::InputError where there is none */
  void give_media(const MaterialsSection &materials, const ParticleMedia &media);

  /** Elastic waves along an axis, at right angles to an interface: energy that media of other impedances reflect, of compression and of shear. */
  struct Mismatch
  {
    double compression = 0, shear = 0;
  };

  /** The worst of the axes. @param density of the solid [kg/m^3]; 0: both are as heavy */
  Mismatch reflected_by_mismatch(const ParticleMedium  &medium,
                                 const base::Stiffness &solid,
                                 double                 density,
                                 const SolidSection    &model);

  /** By how much a solid's stiffness is another one, over the norm of the particles'; in the plane what acts in it. */
  double difference_of_stiffness(const ParticleMedium &medium, const base::Stiffness &solid, const SolidSection &model);
} // namespace apps
