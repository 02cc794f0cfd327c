#pragma once

#include "apps/runs/particles/driven_particles.h"
#include "apps/scene/kinds/read_scene.h"
#include "python/held_groups.h"

#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace python
{
  /** The particles of a scene of kind "particles", moved step by step from outside: what the scene does to them still happens. */
  class MovingParticles
  {
  public:
    /** @throws base::InputError for a scene of another kind, too */
    MovingParticles(const std::string &file, const std::vector<std::string> &changes);

    dem::Specimen       &specimen() { return body->specimen(); }
    const dem::Specimen &specimen() const { return body->specimen(); }

    /** So many steps, each with the scene's motion, forces and walls. @return steps taken: fewer where `stop` says so */
    std::int64_t advance(std::int64_t steps, const std::function<bool()> &stop);

    /** Push a particle in every step until clear_forces() [N, N m]; several add up. @throws std::out_of_range */
    void add_force(std::size_t particle, const Eigen::Vector3d &force, const Eigen::Vector3d &couple);
    void clear_forces() { driven->let_go(); }
    /** Change a particle's velocity at once [m/s, rad/s]. @throws std::out_of_range */
    void apply_impulse(std::size_t particle, const Eigen::Vector3d &change, const Eigen::Vector3d &spin);
    /** Hold particles along x, y, z and about them, at first at rest. @return the group's number @throws std::out_of_range */
    std::size_t hold(const std::vector<std::size_t> &particles, const std::array<bool, 6> &along);
    /** @throws std::out_of_range for a group that hold() has not made */
    void            set_velocity(std::size_t group, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin);
    Eigen::Vector3d reaction(std::size_t group) const;

    /** Keep the present state, and go back to it as often as wanted. @throws std::logic_error without one, or once more is held */
    void save();
    void restore();

  private:
    void demand_particle(std::size_t particle) const;

    apps::CheckedScene                     scene;
    dem::Packing                           packing;
    std::unique_ptr<apps::ParticlesBody>   body;
    std::unique_ptr<apps::DrivenParticles> driven;
    HeldGroups                             held;
  };

  void bind_moving_particles(pybind11::module_ &module);
} // namespace python
