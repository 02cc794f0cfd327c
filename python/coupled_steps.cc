#include "python/coupled_steps.h"

#include "apps/process/mpi_session.h"
#include "apps/runs/continuum/probe_column.h"
#include "apps/scene/reader.h"
#include "apps/scene/scene_of.h"
#include "base/errors.h"
#include "python/arrays.h"
#include "python/held_groups.h"
#include "python/node_arrays.h"
#include "python/signals.h"
#include "python/specimen_arrays.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <stdexcept>

namespace py = pybind11;

namespace python
{
  using Eigen::Vector3d;

  namespace
  {
    constexpr std::int64_t most_at_once = 100; // windows between two checks for signals

    const apps::CoupledModel &model_of(const apps::CheckedScene &scene)
    {
      const auto *coupled = dynamic_cast<const apps::SceneOf<apps::CoupledModel> *>(scene.scene.get());
      if (!coupled)
        throw base::InputError(scene.file + ": Kind = " + scene.kind +
                               ": only runs of scenes of kind coupled are advanced step by step.");
      return coupled->model();
    }
  } // namespace

  CoupledSteps::CoupledSteps(const std::string &file, const std::vector<std::string> &changes, const RunChoice &choice)
    : scene(apps::read_scene(file, changes))
    , model(model_of(scene))
    , request(request_for(scene, choice))
    , report(request)
    , run(std::make_unique<apps::CoupledRun>(request, model))
    , life(std::make_unique<apps::LifeCycle>(request, model.particles.output.checkpoint_interval, *run))
  {
    if (scene.report)
      request.observers.push_back(&report);
    apps::start_mpi();
    const py::gil_scoped_release letting_go;
    apps::with_places(*scene.root, [this] { life->start(); });
  }

  void CoupledSteps::let_go()
  {
    life.reset();
    run.reset();
  }

  bool CoupledSteps::go_on()
  {
    bool goes_on = false;
    try
      {
        apps::with_places(*scene.root, [&] { goes_on = life->go_on(); });
      }
    catch (...)
      {
        is_over = is_finished = true;
        life.reset(); // its last state has been left already
        throw;
      }
    is_over = !goes_on;
    return goes_on;
  }

  std::int64_t CoupledSteps::advance(const std::int64_t windows, const std::function<bool()> &stop)
  {
    const std::int64_t before = moving().windows();
    while (!is_over && moving().windows() - before < windows && !stop())
      {
        run->set_most_windows(std::min(most_at_once, windows - (moving().windows() - before)));
        go_on();
      }
    return moving().windows() - before;
  }

  std::int64_t CoupledSteps::advance_to(const double time, const std::function<bool()> &stop)
  {
    constexpr double   rounding = 1e-12; // of sums of steps, as a run has it
    const std::int64_t before   = moving().windows();
    while (!is_over && moving().time() < time * (1 - rounding) && !stop())
      {
        const double fit = std::floor((time - moving().time()) / moving().steps().window);
        run->set_most_windows(static_cast<std::int64_t>(std::clamp(fit, 1.0, static_cast<double>(most_at_once))));
        go_on();
      }
    return moving().windows() - before;
  }

  std::vector<std::pair<std::string, Vector3d>> CoupledSteps::surface_forces() const
  {
    const std::vector<postprocess::SeriesColumn>  columns = moving().columns();
    const std::vector<double>                     row     = moving().row();
    std::vector<std::pair<std::string, Vector3d>> found;
    for (const apps::CouplingSection &coupling : model.couplings.couplings)
      {
        Vector3d force = Vector3d::Zero();
        for (int axis = 0; axis < 3; ++axis)
          {
            const std::string name = apps::column_name(coupling.name) + "_force_" + "xyz"[axis];
            for (std::size_t c = 0; c < columns.size(); ++c)
              if (columns[c].name == name)
                force[axis] = row.at(c);
          }
        found.emplace_back(coupling.name, force);
      }
    return found;
  }

  void CoupledSteps::demand_particle(const std::size_t particle) const
  {
    demand_one_of("particle", particle, run->moving().particles().specimen().counts().particles);
  }

  void CoupledSteps::demand_node(const std::size_t node) const
  {
    demand_one_of("node", node, moving().nodes().participant().carriers());
  }

  void CoupledSteps::push_particle(const std::size_t particle, const Vector3d &force, const Vector3d &couple)
  {
    demand_particle(particle);
    apps::OutsideForces::Push &push = outside.particles[particle];
    push.force += force;
    push.couple += couple;
    moving().push(outside);
  }

  void CoupledSteps::push_node(const std::size_t node, const Vector3d &force)
  {
    demand_node(node);
    outside.nodes.emplace(node, Vector3d::Zero()).first->second += force;
    moving().push(outside);
  }

  void CoupledSteps::clear_forces()
  {
    outside = {};
    moving().push(outside);
  }

  void CoupledSteps::kick_particle(const std::size_t particle, const Vector3d &change, const Vector3d &spin)
  {
    demand_particle(particle);
    moving().particles().specimen().partners().apply_impulse(particle, change, spin);
  }

  void CoupledSteps::kick_node(const std::size_t node, const Vector3d &change)
  {
    demand_node(node);
    moving().nodes().participant().apply_impulse(node, change);
  }

  std::shared_ptr<apps::RunResult> CoupledSteps::finish()
  {
    if (is_finished)
      throw std::logic_error("the run is over: its result has been taken, or it has failed.");
    const py::gil_scoped_release letting_go;
    if (!is_over)
      life->interrupt();
    is_over = is_finished = true;
    auto result           = std::make_shared<apps::RunResult>();
    apps::with_places(*scene.root, [&] { *result = life->finish(); });
    life.reset(); // and with it the folder
    keep_until_exit(result);
    return result;
  }

  void bind_coupled_steps(py::module_ &module)
  {
    using Steps = CoupledSteps;
    py::class_<Steps>(module, "CoupledSteps")
      .def(py::init([](const std::string &file, const std::vector<std::string> &changes, const std::string &folder,
                       const bool resume) {
        return std::make_unique<Steps>(file, changes, RunChoice{folder, resume, py::none()});
      }))
      .def_property_readonly("time", [](const Steps &s) { return s.moving().time(); })
      .def_property_readonly("windows", [](const Steps &s) { return s.moving().windows(); })
      .def_property_readonly("window", [](const Steps &s) { return s.moving().steps().window; })
      .def_property_readonly("over", &Steps::over)
      .def("advance",
           [](Steps &s, const std::int64_t windows) {
             return let_interrupt([&](const auto &stop) { return s.advance(windows, stop); });
           })
      .def("advance_to",
           [](Steps &s, const double time) {
             return let_interrupt([&](const auto &stop) { return s.advance_to(time, stop); });
           })
      .def("row", [](const Steps &s) { return named_numbers(s.moving().columns(), s.moving().row()); })
      .def("surface_forces", &Steps::surface_forces)
      .def(
        "particles",
        [](const py::object &owner) { return views_of(owner, owner.cast<Steps &>().moving().particles().specimen()); })
      .def("places", [](const Steps &s) { return places_of(s.moving().nodes()); })
      .def("displacement", [](const Steps &s) { return displacements_of(s.moving().nodes()); })
      .def("velocity", [](const Steps &s) { return velocities_of(s.moving().nodes()); })
      .def("nodes_on", [](const Steps &s, const std::string &boundary) { return s.moving().nodes().on(boundary); })
      .def("push_particle", &Steps::push_particle)
      .def("push_node", &Steps::push_node)
      .def("clear_forces", &Steps::clear_forces)
      .def("kick_particle", &Steps::kick_particle)
      .def("kick_node", &Steps::kick_node)
      .def("finish", &Steps::finish);
  }
} // namespace python
