#pragma once

#include "apps/runs/particles/motion.h"
#include "base/entry_path.h"

namespace apps
{
  /** Section "Initial velocity": of groups, at the start. */
  struct InitialVelocitySection
  {
    std::list<MotionFormulas> velocities; ///< later ones win where groups overlap

    /** @throws base::InputError. */
    void check(const base::EntryPath &root, const dem::Physics &physics, const GroupNames &names) const;
    /** Set them, by the places of the particles, before the first step. */
    void give(dem::Specimen &specimen, const dem::Packing &packing, const ParticleGroups &groups) const;
    /**
     * Names of groups whose momentum is that of the start and of the weight since: nothing has acted on them. A group of which particles
     * are held is left out. @param acceleration of free fall [m/s^2]
     */
    std::vector<std::string> untouched_since(const dem::ObservedSpecimen &specimen,
                                             const dem::Packing          &packing,
                                             const ParticleGroups        &groups,
                                             const Eigen::Vector3d       &acceleration) const;
  };
} // namespace apps
