#include "apps/runs/particles/forces.h"

namespace apps
{
  void ForcesSection::check(const base::EntryPath &root, const int dimension, const GroupNames &names) const
  {
    const base::EntryPath all = root.at("Forces");
    for (const GroupForce &given : forces)
      names.require_section(all, given.group);
    for (const GroupForce &given : forces)
      if (dimension == 2 && given.force[2].given())
        all.at(given.group).refuse("Force z", "in two dimensions forces lie in the plane.");
  }

  AppliedForces::AppliedForces(dem::Specimen &body, const ForcesSection &section, const ParticleGroups &found)
    : specimen(&body)
    , forces(section.forces.begin(), section.forces.end())
    , groups(&found)
  {
  }

  void AppliedForces::apply()
  {
    if (forces.empty())
      return;
    specimen->partners().clear_forces();
    for (const GroupForce &given : forces)
      for (const std::size_t i : groups->at(given.group))
        specimen->partners().add_force(i, value_of(given.force, specimen->particle(i).position, specimen->time()),
                                       Eigen::Vector3d::Zero());
  }
} // namespace apps
