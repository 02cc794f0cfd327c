#include "apps/runs/sequential/groundwork.h"

#include "apps/runs/sequential/outline.h"

namespace apps
{
  SequentialGroundwork groundwork_of(const SequentialModel &model)
  {
    SequentialGroundwork found;
    const SolidOutline   solid = outline_of(model.continuum); // before the packing, which may take long
    found.packing              = event_packing(model.particles);
    const StudyUnits units =
      check_study(model, base::EntryPath().at("Study"), solid, outlines_of(model, found.packing));
    found.element_size    = solid.mean_element_size(model.continuum.solid.dimension);
    found.elements        = solid.elements;
    found.unknowns        = solid.unknowns;
    found.horizontal_unit = units.horizontal;
    found.vertical_unit   = units.vertical;

    using Source                           = ParticleEventSection::Source;
    const SequentialModel::Digests digests = model.digests ? model.digests() : SequentialModel::Digests();
    if (model.particles.source == Source::uniaxial)
      found.origin.test = model.particles.compresses() ? "compression" : "tension";
    if (model.particles.source != Source::file)
      found.origin.particles = digests.particles;
    for (const MaterialOfGroup *group : model.receivers())
      {
        const auto        known  = digests.materials.find(group->group);
        const std::string digest = known == digests.materials.end() ? "" : known->second;
        if (found.origin.continuum.empty())
          {
            found.origin.material  = group->law->name();
            found.origin.continuum = digest;
          }
        else if (found.origin.continuum != digest)
          found.doubts.push_back("the groups of elements are of several materials, and the mapping law is one: \"" +
                                 group->group + "\" differs from the first.");
      }
    if (const std::string doubt = doubt_about_law(model.transfer, found.origin); !doubt.empty())
      found.doubts.push_back(doubt);
    return found;
  }
} // namespace apps
