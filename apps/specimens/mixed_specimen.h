#pragma once

#include "apps/models/material.h"
#include "apps/models/mix.h"
#include "apps/models/specimen.h"
#include "apps/specimens/mix_work.h"
#include "base/entry_path.h"
#include "dem/model/materials.h"
#include "dem/model/packing.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
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

    bool given() const { return mix.given(); }

    /** Particles with their materials, in a box or as a periodic cell. @throws as make_packing(), take_mix() */
    dem::Packing packing() const;

    /** Number and name the materials of particles that are there. @param origin where they come from, for messages @throws likewise */
    void number(dem::Packing &packed, const std::string &origin) const;
    /** The same for a part of the particles, which need not have some of every material. */
    void number_part(dem::Packing &part, const std::string &origin) const;
    /** @throws base::InputError for a material of section Materials that no particle, numbered as above, is of */
    void require_all(const dem::Packing &packed, const std::string &origin) const;

    /** @param names of the packing's materials */
    dem::LinkMaterials materials(const std::vector<std::string> &names) const;
    /** Class of each pair of these materials, in the order of dem::material_pair(); empty: there is one. */
    std::vector<std::string> link_classes(const std::vector<std::string> &names) const;

    /** Requested and reached. @param cell edges, of a periodic one; empty: the box @pre there is a mix */
    MixFigures figures(const std::optional<Eigen::Vector3d> &cell = std::nullopt) const;
    /** Entry "mix" of a summary, with these figures; none without a mix. @param cell likewise */
    void put_into(nlohmann::json &summary, const std::optional<Eigen::Vector3d> &cell = std::nullopt) const;
    /** Line of a report; "" without a mix. @param cell likewise */
    std::string text(const std::optional<Eigen::Vector3d> &cell = std::nullopt) const;
    /** grading.png in a folder; nothing without a mix. @param cell likewise @return what went wrong, "" if nothing */
    std::string draw_grading(const std::filesystem::path          &folder,
                             const std::optional<Eigen::Vector3d> &cell = std::nullopt) const;

  private:
    /** Section Materials with further numbers of the aggregate, so many materials in all; without a mix as it is. */
    MaterialSection named_materials(std::size_t numbers) const;
    std::size_t     number_in_scene(std::size_t number) const; ///< of a material in section Materials
    std::string     class_of(const std::vector<std::string> &names, std::size_t one, std::size_t other) const;
    Eigen::Vector3d walls() const; ///< edges of the specimen's box; zero where it has none
    /** Where the aggregates lie: all edges zero where there is none. */
    MixBox box(const std::optional<Eigen::Vector3d> &cell) const;
  };
} // namespace apps
