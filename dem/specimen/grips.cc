#include "dem/specimen/grips.h"

#include "base/errors.h"
#include "dem/specimen/core.h"

#include <string>

namespace dem
{
  Eigen::Vector3d GripReadings::reaction(const std::size_t grip) const { return core->held.reaction(grip); }

  Eigen::Vector3d GripReadings::reaction_moment(const std::size_t grip) const
  {
    return core->held.reaction_moment(grip);
  }

  Eigen::Vector3d GripReadings::reaction_moment(const std::size_t grip, const Eigen::Vector3d &about) const
  {
    core->gather_places();
    return core->held.reaction_moment(core->particles, grip, about);
  }

  std::size_t Grips::add(const Grip &grip)
  {
    if (core->parameters.physics.periodic)
      throw base::InputError("Grips: a periodic cell has no place for them; it is loaded by its deformation.");
    for (const std::size_t particle : grip.particles)
      if (core->particles.clump_of(static_cast<std::size_t>(core->slot.at(particle))) >= 0)
        throw base::InputError("Grips: particle " + std::to_string(particle + 1) +
                               " is a pebble of a clump, which moves as a whole. Hold others.");
    const std::size_t added = core->held.add(grip, core->slot, core->particles, core->shape.dimension);
    set_velocity(added, grip.velocity, grip.spin);
    return added;
  }

  void Grips::set_velocity(const std::size_t grip, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin)
  {
    core->held.set_rates(grip, velocity, spin, core->particles, core->work_of_changes());
  }

  void Grips::set_velocities(const std::size_t                   grip,
                             const std::vector<Eigen::Vector3d> &velocity,
                             const std::vector<Eigen::Vector3d> &spin)
  {
    core->held.set_own_rates(grip, velocity, spin, core->particles, core->work_of_changes());
  }
} // namespace dem
