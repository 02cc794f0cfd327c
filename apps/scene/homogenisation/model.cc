#include "apps/scene/homogenisation/model.h"

#include "apps/scene/entries/specimen.h"
#include "apps/scene/length_unit_entry.h"
#include "apps/scene/number_list.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, HomogenisationModel &model)
  {
    Section &s = root.section("Homogenisation", "Macroscopic stiffness of periodic packings, from links and relaxed");
    s.choice("Source", model.source,
             {{"generator", SpecimenSection::Source::generator}, {"file", SpecimenSection::Source::file}},
             Need::optional)
      .means("Packings made by compaction, or one read from a file");
    s.file("File", model.file)
      .means("Periodic packing")
      .only_if([&model] { return model.source == SpecimenSection::Source::file; }, "Source = file");
    declare_packing_unit(s, model.length_unit)
      .only_if([&model] { return model.source == SpecimenSection::Source::file; }, "Source = file");
    s.number("Particle radius", model.radius, "m", Range::positive(), Need::optional)
      .means("Of the spheres of made packings");
    s.integer("Particles", model.particles, "-", Range::between(8, 1e6), Need::optional)
      .means("Spheres of each made packing");
    s.integer("Seeds", model.seeds, "-", Range::between(1, 1000), Need::optional).means("Packings made, one per seed");
    s.number("Friction coefficient", model.friction, "-", Range::at_least(0), Need::optional)
      .means("During compaction; 1 leaves a packing fraction of 0.55, 0.1 of 0.61");
    s.number("Normal modulus", model.normal_modulus, "Pa", Range::positive(), Need::required)
      .means("E of the link material");
    declare_numbers(s, "Interaction ratios", model.interaction_ratios, "", "numbers from 1 to 10", Need::required)
      .means("Numbers from 1 to 10, separated by commas");
    declare_numbers(s, "Shear ratios", model.shear_ratios, "", "numbers above 0", Need::required)
      .means("G/E of the link material, numbers above 0, separated by commas");
    s.number("Thickness", model.thickness, "m", Range::at_least(0), Need::optional)
      .means("0: spheres; above: the packing of the file is of discs this thick");
    s.number("Tolerance", model.tolerance, "-", Range::between(1e-13, 1e-2), Need::optional)
      .means("Unbalanced force over link forces");
  }
} // namespace apps
