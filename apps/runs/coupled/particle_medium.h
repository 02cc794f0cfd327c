#pragma once

#include "apps/runs/continuum/model.h"
#include "apps/runs/coupled/handshakes.h"
#include "apps/specimens/mixed_specimen.h"
#include "coupling/volume/particle_medium.h"
#include "dem/model/packing.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace apps
{
  /** What particles would be in the places of the solid: of each group of elements. */
  class ParticleMedia
  {
  public:
    /** Nothing is known. */
    ParticleMedia() = default;

    bool empty() const { return of_group.empty(); }
    /** nullptr: not known, or it would be several */
    const coupling::ParticleMedium *of(const std::string &group) const;
    /** Materials of the particles that would be in a group's places, where these are several; "" where no region is. */
    std::vector<std::string> several_in(const std::string &group) const;

    void set(const std::string &group, const coupling::ParticleMedium &medium) { of_group[group] = medium; }
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
    std::map<std::string, coupling::ParticleMedium> of_group;
    std::map<std::string, std::vector<std::string>> mixed;
  };

  /** The particles of a scene, as far as their medium goes. */
  struct MediumSource
  {
    const std::optional<dem::Packing> &cell; ///< periodic, of which they are a part
    MixedSpecimen                      specimen;
    bool                               rotations = true; ///< whether particles spin
  };

  /**
   * Nothing where there is no periodic cell, it does not resist every strain, or particles are of a mix, whose aggregates lie in the box that the
   * specimen is, and in no cell of the packing. Of a group of elements whose places lie in one region of
   * a material, the cell with all its particles of that; where no region is, with materials as the packing numbers them.
   * @param handshakes what of the elements goes
   */
  ParticleMedia
  media_of(const MediumSource &source, const ContinuumModel &continuum, const HandshakesSection &handshakes);

  /** Materials that are homogenised become the medium of their group. @throws base::InputError where there is none */
  void give_media(const MaterialsSection &materials, const ParticleMedia &media);
} // namespace apps
