#pragma once

#include "apps/text/place.h"
#include "base/entry_path.h"
#include "fem/points/registry.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** A stiffness of homogenised.json, symmetric. @param way "relaxed", "affine" or "statistics" @throws base::InputError */
  base::Stiffness stiffness_in(const std::string &file, const std::string &way);

  class CellsConstants;

  /** Sub-section of "Materials": the law of one group of elements. */
  struct MaterialOfGroup
  {
    /** The block of one law. */
    struct Block
    {
      std::unique_ptr<fem::MaterialConstants> constants;
      std::string                             stiffness_file; ///< of `breccia homogenise`; "": the constants
      std::string                             stiffness_way = "relaxed";
      bool                                    homogenised   = false; ///< it is that of particles inside the solid
    };

    std::string                  group;
    Place                        place{"model"};    ///< for messages: where it was written
    const fem::MaterialKind     *law     = nullptr; ///< the chosen one
    double                       density = 0;       ///< [kg/m^3], in explicit analyses
    std::map<std::string, Block> blocks;            ///< of every law, by its name

    bool is_homogenised() const { return law->takes_stiffness() && chosen().homogenised; }
    /** In place of constants and density of a material that is homogenised. */
    void become(const base::Stiffness &stiffness, double density);

    const Block &chosen() const { return blocks.at(law->name()); }
    /** Of a group whose points are cells; nullptr otherwise. */
    const CellsConstants *cells() const;

    /** Room for points of this law. @throws base::InputError naming the group and the constant that is refused. */
    std::unique_ptr<fem::MaterialPoints> make_points(fem::Plane plane) const;

    /** @throws base::InputError for elements wider than the law can soften in [m]. */
    void require_element_size(double size) const;
  };

  /** Section "Materials": a law for every named group of elements. */
  struct MaterialsSection
  {
    std::vector<std::unique_ptr<MaterialOfGroup>> groups;

    void check(const base::EntryPath &root, bool large_displacement) const;
  };
} // namespace apps
