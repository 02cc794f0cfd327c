#pragma once

#include "apps/models/material.h"
#include "apps/runs/particles/groups.h"
#include "apps/specimens/mixed_specimen.h"
#include "apps/text/corner_list.h"
#include "base/entry_path.h"
#include "base/length_unit.h"
#include "dem/genesis/convex_body.h"

#include <functional>
#include <list>
#include <optional>
#include <string>

namespace apps
{
  /** Sub-section of "More particles": one sphere, those of another packing file, or a convex body of pebbles. Its name is that of a group. */
  struct AddedParticles
  {
    enum class Source
    {
      sphere,
      file,
      body ///< rigid, filled with pebbles
    };

    std::string                     name;
    Source                          source = Source::sphere;
    std::string                     file;
    std::optional<base::LengthUnit> length_unit; ///< of the file
    CornerList                      corners;     ///< of a body
    dem::Filling                    filling = dem::Filling::close;
    std::array<double, 3>           centre  = {
                 0, 0, 0};  ///< of the sphere, or what is added to the places of the file and to corners [m]
    double      radius = 0; ///< of the sphere, or of each pebble [m]
    bool        bonded = false;
    std::string material; ///< "": as Regions and file say

    void check(const base::EntryPath &section, int dimension, const MaterialSection &materials) const;
    /** @param dimension of the scene */
    dem::Packing particles(int dimension) const;
  };

  /** Which two particles of a packing are of one body, and may overlap as they like. */
  using OneBody = std::function<std::function<bool(std::size_t, std::size_t)>(const dem::Packing &)>;

  /** Section "More particles": spheres beside those of the specimen. */
  struct MoreParticlesSection
  {
    std::list<AddedParticles> added;

    /** @param names takes theirs. @throws base::InputError. */
    void check(const base::EntryPath &root, int dimension, const MaterialSection &materials, GroupNames &names) const;
    /** Specimen and added particles together, loose ones last, with their materials. @param one_body what may overlap in it @param cell as specimen_particles() has it @throws base::InputError, and as make_packing() */
    dem::Packing compose(const MixedSpecimen                                &specimen,
                         const OneBody                                      &one_body,
                         const std::function<bool(const Eigen::Vector3d &)> &keeps = {},
                         std::optional<dem::Packing>                        *cell  = nullptr) const;

    std::size_t loose(int dimension) const; ///< how many of the last particles are linked to nothing
    /** Where those of each sub-section are. @param particles how many there are of all, in what compose() made */
    ParticleGroups groups_in(std::size_t particles, int dimension) const;

  private:
    std::vector<const AddedParticles *> in_order() const; ///< of numbers: bonded ones first
  };
} // namespace apps
