#pragma once

#include "apps/models/material_interface.h"
#include "apps/models/material_region.h"
#include "base/entry_path.h"
#include "dem/laws/registry.h"
#include "dem/model/packing.h"

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** What a link between two particles of one material obeys: law, and a block with the constants of every law there is. */
  struct LinkLaw
  {
    const dem::LinkLawKind                                    *law      = nullptr; ///< the chosen one
    const dem::LinkLawKind                                    *contacts = nullptr; ///< likewise; none: that of `law`
    bool                                                       given    = false;   ///< it was chosen explicitly
    std::map<std::string, std::shared_ptr<dem::LinkConstants>> constants;          ///< of every law, by its name

    /** From code: a law by its constants, e.g. dem::LinearContactParameters. */
    template <typename Parameters>
    void choose(const Parameters &parameters)
    {
      using Law = typename Parameters::Law;
      law       = dem::find_link_law(Law::name);
      given     = true;

      constants[Law::name] = dem::LinkLawKindOf<Law>::constants_of(parameters);
    }
    /** Constants of the chosen law. */
    const dem::LinkConstants &chosen() const { return *constants.at(law->name()); }
    /** Rules between the constants of the chosen laws. @throws base::InputError */
    void check() const;
  };

  /** Sub-section of "Materials": one of several. */
  struct NamedMaterial
  {
    std::string name;
    LinkLaw     law;
    double      density = 0; ///< of its particles [kg/m^3]; 0: that of the specimen
  };

  /**
   * Of what material particles and links are: section "Material" where there is one; or "Materials", one sub-section for each, and
   * "Regions", which say where each is, unless the packing does.
   */
  struct MaterialSection
  {
    LinkLaw                      only;    ///< section Material
    std::list<NamedMaterial>     named;   ///< as the scene names them; empty: there is one
    std::list<MaterialRegion>    regions; ///< in the scene's order
    std::list<MaterialInterface> interfaces;

    /** Rules between the constants of the selected laws, and between names. @throws base::InputError. */
    void check(const base::EntryPath &root, int dimension) const;

    dem::LinkMaterials       materials() const;
    std::vector<std::string> names() const; ///< empty where there is one
    /** The interface of two materials: the last of several; nullptr if there is none. */
    const MaterialInterface *between(const std::string &one, const std::string &other) const;

    /**
     * Number the packing's particles as materials(): by the names that the packing gives them (or its numbers, or else all the
     * first), and then by the regions, of which later ones win. With one material the packing is left with none.
     *
     * @param origin where the packing came from, for messages
     * @throws base::InputError for a material that the scene does not name, or that no particle is of
     */
    void assign(dem::Packing &packing, int dimension, const std::string &origin) const;

    /** The same for a part of a packing, which need not have particles of every material. */
    void number(dem::Packing &part, int dimension, const std::string &origin) const;
    /** @throws base::InputError for a material that no particle of a whole packing, numbered as above, is of */
    void require_all(const dem::Packing &packing, const std::string &origin) const;

  private:
    void check_interfaces(const base::EntryPath &root) const;
    /** Every pair of materials has a law. @throws base::InputError */
    void check_pairs(const base::EntryPath &root) const;
    /** The same by their numbers. */
    const MaterialInterface *between(std::int32_t one, std::int32_t other) const;
    /** Law of the links of each pair of materials, in the order of dem::material_pair(); nullptr: none follows from the scene. */
    std::vector<const dem::LinkLawKind *> laws_of_pairs() const;
    /** All materials by one law, which all pairs obey, or the contacts of all. */
    dem::LinkMaterials by_law(const dem::LinkLawKind &kind) const;
    /** All materials by one of several laws: what obeys another one has constants of this one that are not used. */
    dem::LinkMaterials by_law(const dem::LinkLawKind                      &kind,
                              const std::vector<const dem::LinkLawKind *> &of_pairs) const;
  };
} // namespace apps
