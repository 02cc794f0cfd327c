#include "apps/scene/continuum/materials.h"

#include "apps/runs/continuum/cells.h"
#include "apps/scene/constant_entries.h"
#include "apps/scene/continuum/cells.h"
#include "apps/scene/section.h"

#include <nlohmann/json.hpp>

namespace apps
{
  namespace
  {
    /** Where a stiffness may stand in for the constants; they are then not needed. */
    void declare_stiffness_file(Section &section, MaterialOfGroup::Block &block)
    {
      section.file("Stiffness file", block.stiffness_file)
        .means("homogenised.json of breccia homogenise, in place of the entries");
      section.find_entry("Stiffness file")->required = false;
      section
        .choice("Stiffness way", block.stiffness_way,
                {{"relaxed", std::string("relaxed")},
                 {"affine", std::string("affine")},
                 {"statistics", std::string("statistics")}},
                Need::optional)
        .means("Which of the three stiffnesses of the file");
    }
  } // namespace

  void declare(Section                     &section,
               MaterialOfGroup             &material_of_group,
               const std::function<bool()> &is_explicit,
               const bool                   holds_particles)
  {
    using Block = MaterialOfGroup::Block;
    auto kinds  = fem::material_kinds();
    kinds.push_back(cells_kind());
    std::vector<std::string> names;
    for (const auto &kind : kinds)
      names.push_back(kind->name());
    material_of_group.law = kinds.front().get();
    section
      .choice_of(
        "Law", names, 0,
        [&material_of_group, kinds](const std::size_t i) { material_of_group.law = kinds.at(i).get(); }, Need::required)
      .means("Law of the group; the section of its name holds its constants");
    section.number("Density", material_of_group.density, "kg/m^3", Range::positive(), Need::required)
      .means("Mass per volume")
      .only_if([&material_of_group, is_explicit] { return is_explicit() && !material_of_group.is_homogenised(); },
               holds_particles ? "in motion or under its weight, and the law is not homogenised" :
                                 "Model/Analysis = explicit");

    for (const auto &kind : kinds)
      {
        Section &entries = section.section(kind->name(), kind->meaning());
        entries.only_if([&material_of_group, kind] { return material_of_group.law == kind.get(); },
                        "Law = " + kind->name());
        Block &block    = material_of_group.blocks[kind->name()];
        block.constants = kind->constants();
        if (kind->takes_stiffness())
          declare_stiffness_file(entries, block);
        if (kind->takes_stiffness() && holds_particles)
          entries.flag("Homogenised", block.homogenised)
            .means("Stiffness and density are those of the particles inside the solid, found from their periodic cell; "
                   "where "
                   "there are Regions, of that in which the elements lie");
        const std::size_t first = entries.entries().size();
        block.constants->visit(ConstantEntries{entries});
        if (auto *cells = dynamic_cast<CellsConstants *>(block.constants.get()))
          declare(entries, *cells);
        for (std::size_t i = first; kind->takes_stiffness() && i < entries.entries().size(); ++i)
          entries.entries()[i]->only_if([&block] { return block.stiffness_file.empty() && !block.homogenised; },
                                        holds_particles ? "there is no Stiffness file, and Homogenised = false" :
                                                          "there is no Stiffness file");
      }
  }

  void
  declare(Section &root, MaterialsSection &materials, std::function<bool()> is_explicit, const bool holds_particles)
  {
    Section &s = root.section("Materials", "One sub-section per named group of elements: its law");
    s.named_sections("GROUP", [&materials, is_explicit = std::move(is_explicit), holds_particles](Section &opened) {
      materials.groups.push_back(std::make_unique<MaterialOfGroup>());
      materials.groups.back()->group = opened.name();
      materials.groups.back()->place = opened.place();
      declare(opened, *materials.groups.back(), is_explicit, holds_particles);
    });
  }
} // namespace apps
