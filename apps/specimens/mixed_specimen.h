#pragma once

#include "apps/models/material.h"
#include "apps/models/mix.h"
#include "apps/models/specimen.h"
#include "apps/specimens/mix_work.h"
#include "base/entry_path.h"
#include "dem/model/materials.h"
#include "dem/model/packing.h"

#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /**
   * The sections of a scene that say which particles there are and of what each is, together: with a mix, particles are mortar or aggregate; their
   * constants follow from section Material, that of the mortar, or are those of section Materials.
   */
  struct MixedSpecimen
  {
    const SpecimenSection &source;
    const MixSection      &mix; ///< perhaps none
    const MaterialSection &material;
    int                    dimension;

    /** Rules between entries of the mix. @pre source and material are checked @throws base::InputError */
    void check(const base::EntryPath &root) const;

    /** Particles with their materials, in a box or as a periodic cell. @throws as make_packing(), take_mix() */
    dem::Packing packing() const;

    /** Number and name the materials of particles that are there. @param origin where they come from, for messages @throws likewise */
    void number(dem::Packing &packed, const std::string &origin) const;

    /** @param names of the packing's materials */
    dem::LinkMaterials materials(const std::vector<std::string> &names) const;
    /** Class of each pair of these materials, in the order of dem::material_pair(); empty: there is one. */
    std::vector<std::string> link_classes(const std::vector<std::string> &names) const;

    /** Asked and reached. @param cell edges, of a periodic one; empty: the box @pre there is a mix */
    MixFigures figures(const std::optional<Eigen::Vector3d> &cell = std::nullopt) const;
  };
} // namespace apps
