#pragma once

#include "apps/runs/continuum/moving_solid.h"
#include "apps/scene/kinds/read_scene.h"
#include "python/held_groups.h"
#include "python/until_exit.h"

#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace python
{
  /** The solid of a scene of kind "continuum" in explicit motion, moved step by step from outside: what the scene does to it still happens. */
  class MovingSolid : public UntilExit
  {
  public:
    /** @throws base::InputError for a scene of another kind, too */
    MovingSolid(const std::string &file, const std::vector<std::string> &changes);

    void let_go() override { body.reset(); }

    apps::MovingSolid       &solid() { return *body; }
    const apps::MovingSolid &solid() const { return *body; }

    double       time_step() const;          ///< of the next step, by itself as a run of the scene takes it [s]
    void         set_time_step(double step); ///< from now on [s]; 0: as a run does
    std::int64_t steps() const { return taken; }

    /** So many steps. @return steps taken: fewer where `stop` says so @throws base::NumericalError */
    std::int64_t advance(std::int64_t steps, const std::function<bool()> &stop);
    /** Up to a time [s]. @return as advance() */
    std::int64_t advance_to(double time, const std::function<bool()> &stop);

    // Of nodes by their numbers. @throws std::out_of_range

    void add_force(std::size_t node, const Eigen::Vector3d &force);      ///< until clear_forces() [N]
    void apply_impulse(std::size_t node, const Eigen::Vector3d &change); ///< [m/s]
    /** Hold nodes along axes, at first at rest. @return the group's number @throws base::InputError where the scene holds them */
    std::size_t hold(const std::vector<std::size_t> &nodes, const std::array<bool, 3> &along);
    void        set_velocity(std::size_t group, const Eigen::Vector3d &velocity); ///< of all of a group [m/s]
    /** What holds a group [N]; inertia does not count. */
    Eigen::Vector3d reaction(std::size_t group) const;

    /** Keep the present state, and go back to it as often as wanted. @throws std::logic_error without one, or once more is held */
    void save();
    void restore();

  private:
    void demand_node(std::size_t node) const;

    apps::CheckedScene                 scene;
    std::unique_ptr<apps::MovingSolid> body;
    double                             own_step = 0; ///< that was set; 0: none [s]
    std::int64_t                       taken = 0, taken_then = 0;
    HeldGroups                         held;
  };

  void bind_moving_solid(pybind11::module_ &module);
} // namespace python
