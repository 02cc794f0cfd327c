#pragma once

#include "apps/runs/particles/motion.h"
#include "apps/runs/particles/walls.h"
#include "base/entry_path.h"
#include "dem/specimen/observation.h"

#include <array>
#include <list>
#include <string>

namespace apps
{
  /** Sub-section of "Probes": one number that is measured at every sample. */
  struct ProbeSection
  {
    enum class Quantity
    {
      position,
      displacement,
      velocity,
      spin,
      distance,
      reaction,
      reaction_moment,
      reaction_torque,
      wall_force,
      wall_moment,
      wall_travel,
      wall_impulse,
      force,
      kinetic_energy, // vectors until here, numbers from here on
      broken_links,
      unbalanced_ratio
    };
    enum class Component
    {
      x,
      y,
      z,
      size
    };

    std::string name;
    Quantity    quantity  = Quantity::displacement;
    Component   component = Component::size;
    std::string group     = GroupNames::all, other, wall;

    std::array<double, 3> point = {0, 0, 0}; ///< about which a moment is taken

    /** @throws base::InputError. */
    void        check(const base::EntryPath         &section,
                      const GroupNames              &names,
                      const PrescribedMotionSection &motion,
                      const WallsSection            &walls) const;
    bool        of_grip() const { return quantity >= Quantity::reaction && quantity <= Quantity::reaction_torque; }
    bool        of_wall() const { return quantity >= Quantity::wall_force && quantity <= Quantity::wall_impulse; }
    bool        is_vector() const { return quantity < Quantity::kinetic_energy; }
    const char *unit() const;

    Eigen::Vector3d about() const { return {point[0], point[1], point[2]}; }
  };

  /** Section "Probes". */
  struct ProbesSection
  {
    std::list<ProbeSection> probes;

    /** @throws base::InputError. */
    void check(const base::EntryPath         &root,
               const GroupNames              &names,
               const PrescribedMotionSection &motion,
               const WallsSection            &walls) const;
  };

  /** The state of a specimen at one moment, as all probes read it. */
  struct ProbedBody
  {
    const dem::ObservedSpecimen   &specimen;
    const dem::ParticleKinematics &particles;
    const PrescribedMotion        &motion;
    const ParticleGroups          &groups;
    const Walls                   &walls;
  };

  /** Value of a probe. Means over a group are those of its centre of mass; a rigid body counts as one. */
  double value_of(const ProbeSection &probe, const ProbedBody &seen);
} // namespace apps
