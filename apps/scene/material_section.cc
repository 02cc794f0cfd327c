#include "apps/scene/material_section.h"

#include "apps/scene/law_block.h"

namespace apps
{
  void MaterialSection::declare(Section &root)
  {
    Section &section = root.section("Material", "The material of the links");
    section.choice("Law", law, {{dem::CpmDescription::name, dem::CpmDescription::name}}, Need::required)
      .means("Law of the links; the section of its name holds its constants");
    Section &block = section.section(dem::CpmDescription::name,
                                     "Cohesive particle model: damage in tension, cohesion and friction in shear");
    block.only_if([this] { return law == dem::CpmDescription::name; }, "Material/Law = CPM");
    declare_law<dem::CpmDescription>(block, cpm);
  }

  void MaterialSection::validate() const { dem::CpmConstants{cpm}; }
} // namespace apps
