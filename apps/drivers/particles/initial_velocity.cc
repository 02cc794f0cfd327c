#include "apps/drivers/particles/initial_velocity.h"

namespace apps
{
  void InitialVelocitySection::declare(Section &root)
  {
    root
      .section("Initial velocity",
               "One sub-section per group that moves at the start, named after the group; of two groups with the same "
               "particle the later one counts")
      .named_sections("GROUP", [this](Section &opened) {
        MotionFormulas &added = velocities.emplace_back();
        added.group           = opened.name();
        added.declare(opened, "At the start, by the place of each particle; empty: none");
      });
  }

  void InitialVelocitySection::validate(const Section &root, const dem::Physics &physics, const GroupNames &names) const
  {
    const Section &all = *root.find_section("Initial velocity");
    names.require_sections(all);
    for (const MotionFormulas &given : velocities)
      given.validate(*all.find_section(given.group), physics);
  }

  void
  InitialVelocitySection::give(dem::Specimen &specimen, const dem::Packing &packing, const ParticleGroups &groups) const
  {
    for (const MotionFormulas &given : velocities)
      for (const std::size_t i : groups.at(given.group))
        specimen.set_velocity(i, value_of(given.velocity, packing.centre[i], 0),
                              value_of(given.spin, packing.centre[i], 0));
  }
} // namespace apps
