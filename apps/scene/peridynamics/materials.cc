#include "apps/scene/peridynamics/materials.h"

#include "apps/scene/entries/components.h"
#include "apps/scene/entries/material_region.h"
#include "apps/scene/entries/output.h"
#include "apps/scene/entries/region.h"
#include "apps/scene/section.h"

namespace apps
{
  namespace pd = dem::peridynamics;

  void declare(Section &section, PeridynamicConstants &peridynamic_constants)
  {
    section.number("Young modulus", peridynamic_constants.young_modulus, "Pa", Range::positive(), Need::required)
      .means("Of the continuum");
    section.number("Density", peridynamic_constants.density, "kg/m^3", Range::at_least(0), Need::optional)
      .means("Needed by motion");
    section.number("Critical stretch", peridynamic_constants.critical_stretch, "-", Range::at_least(0), Need::optional)
      .means("At which a bond breaks for ever; 0: from the fracture energy, or never");
    section
      .number("Fracture energy", peridynamic_constants.fracture_energy, "J/m^2", Range::at_least(0), Need::optional)
      .means("Of a crack, in place of the critical stretch; 0: none");
  }

  void declare(Section &section, PeridynamicInterface &peridynamic_interface)
  {
    declare_pair(section, peridynamic_interface.one, peridynamic_interface.other, "bonds between its own nodes");
    section.flag("Bonded", peridynamic_interface.bonded).means("Off: bonds between the two are broken from the start");
    section.number("Young modulus", peridynamic_interface.young_modulus, "Pa", Range::at_least(0), Need::optional)
      .means("Of bonds between the two; 0: the harmonic mean of theirs, as of two halves in series");
    section.number("Critical stretch", peridynamic_interface.critical_stretch, "-", Range::at_least(0), Need::optional)
      .means("At which they break; 0: from the fracture energy, or when the first half reaches that of its material");
    section
      .number("Fracture energy", peridynamic_interface.fracture_energy, "J/m^2", Range::at_least(0), Need::optional)
      .means("Of a crack along the interface, in place of the critical stretch; 0: none");
  }

  void declare(Section &root, PeridynamicMaterialsSection &peridynamic_materials)
  {
    Section &s = root.section("Material", "Of the bonds");
    s.choice("Model", peridynamic_materials.bonds,
             {{"prototype", pd::BondModel::prototype}, {"general", pd::BondModel::general}}, Need::optional)
      .means("The force of a bond grows with its stretch, or with its elongation");
    s.choice("Calibration", peridynamic_materials.calibration,
             {{"none", pd::Calibration::none}, {"axis", pd::Calibration::axis}, {"bulk", pd::Calibration::bulk}},
             Need::optional)
      .means("The bond constant is divided so that the grid has Young's modulus along its axes, or the stiffness "
             "against equal strains");
    s.number("Poisson ratio", peridynamic_materials.poisson_ratio, "-", Range::between(0, 0.5), Need::optional)
      .means("Bonds have 1/3 in plane stress and 1/4 in plane strain and in space, and no other; 0: not compared");
    declare(s, peridynamic_materials.only);
    s.find_entry("Young modulus")
      ->only_if([&peridynamic_materials] { return peridynamic_materials.named.empty(); },
                "there is no section Materials");

    Section &several = root.section("Materials", "One sub-section per material, of those that Regions name; elsewhere "
                                                 "the body is of the first");
    several.only_if([&peridynamic_materials] { return !peridynamic_materials.named.empty(); },
                    "there are several materials");
    several.named_list("MATERIAL", peridynamic_materials.named, &PeridynamicConstants::name);

    Section &between = root.section("Interfaces", "One sub-section per pair of materials whose bonds have constants of "
                                                  "their own");
    between.only_if([&peridynamic_materials] { return !peridynamic_materials.interfaces.empty(); },
                    "there are several materials");
    between.named_list("INTERFACE", peridynamic_materials.interfaces, &PeridynamicInterface::name);
    declare_regions(root, peridynamic_materials.regions, "nodes");
  }
} // namespace apps
