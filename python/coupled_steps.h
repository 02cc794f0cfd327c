#pragma once

#include "apps/results/life_cycle.h"
#include "apps/results/run_report.h"
#include "apps/runs/coupled/run.h"
#include "python/run_of_scene.h"
#include "python/until_exit.h"

#include <array>
#include <functional>
#include <utility>

namespace python
{
  /** A run of a scene of kind "coupled" that goes on window by window, as requested from outside; its result is that of the program's run. */
  class CoupledSteps : public UntilExit
  {
  public:
    /** Make both sides, or take up what an interrupted run left. @throws as a run; base::InputError for a scene of another kind, too */
    CoupledSteps(const std::string &file, const std::vector<std::string> &changes, const RunChoice &choice);

    void let_go() override;

    apps::CoupledBody       &moving() { return run->moving(); }
    const apps::CoupledBody &moving() const { return run->moving(); }
    bool                     over() const { return is_over; } ///< at its end, stopped, or failed

    /** So many windows, as a run takes them. @return windows taken: fewer at the end, and where `stop` says so @throws as a run */
    std::int64_t advance(std::int64_t windows, const std::function<bool()> &stop);
    /** Up to a time or somewhat beyond, but not beyond the scene's end [s]. @return as advance() */
    std::int64_t advance_to(double time, const std::function<bool()> &stop);

    /** By the name of each surface coupling: force of the particles on the solid there, at the last that is known [N]. */
    std::vector<std::pair<std::string, Eigen::Vector3d>> surface_forces() const;

    /** Forces from outside, beside the scene's, until clear_forces() [N, N m]; several add up. @throws std::out_of_range */
    void push_particle(std::size_t particle, const Eigen::Vector3d &force, const Eigen::Vector3d &couple);
    void push_node(std::size_t node, const Eigen::Vector3d &force);
    void clear_forces();
    /** Change a velocity at once [m/s, rad/s]. @throws std::out_of_range */
    void kick_particle(std::size_t particle, const Eigen::Vector3d &change, const Eigen::Vector3d &spin);
    void kick_node(std::size_t node, const Eigen::Vector3d &change);

    /** Once: save, where there is a folder and the end has not come, and say what was found. */
    std::shared_ptr<apps::RunResult> finish();

  private:
    void demand_particle(std::size_t particle) const;
    void demand_node(std::size_t node) const;
    /** One window, or a whole sample. @return whether there is more to do */
    bool go_on();

    apps::CheckedScene                scene;
    const apps::CoupledModel         &model;
    apps::RunRequest                  request;
    apps::RunReport                   report;
    std::unique_ptr<apps::CoupledRun> run;
    std::unique_ptr<apps::LifeCycle>  life;
    apps::OutsideForces               outside;
    bool                              is_over = false, is_finished = false;
  };

  void bind_coupled_steps(pybind11::module_ &module);
} // namespace python
