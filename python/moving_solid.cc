#include "python/moving_solid.h"

#include "apps/process/mpi_session.h"
#include "apps/scene/reader.h"
#include "apps/scene/scene_of.h"
#include "base/errors.h"
#include "base/number_text.h"
#include "python/arrays.h"
#include "python/node_arrays.h"
#include "python/signals.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>

namespace py = pybind11;

namespace python
{
  using Eigen::Vector3d;

  MovingSolid::MovingSolid(const std::string &file, const std::vector<std::string> &changes)
    : scene(apps::read_scene(file, changes))
  {
    const auto *continuum = dynamic_cast<const apps::SceneOf<apps::ContinuumModel> *>(scene.scene.get());
    if (!continuum)
      throw base::InputError(file + ": Kind = " + scene.kind +
                             ": only scenes of kind continuum have a solid that is moved step by step.");
    apps::start_mpi();
    apps::with_places(*scene.root, [&] { body = apps::make_moving_solid(continuum->model()); });
  }

  double MovingSolid::time_step() const { return own_step > 0 ? own_step : body->next_step(body->longest_step()); }

  void MovingSolid::set_time_step(const double step)
  {
    if (!(step >= 0 && step <= body->longest_step()))
      throw base::InputError("time_step = " + base::number_text(step) +
                             " s: must not be below 0, and is stable up to " + base::number_text(body->longest_step()) +
                             " s now.");
    own_step = step;
  }

  std::int64_t MovingSolid::advance(const std::int64_t steps, const std::function<bool()> &stop)
  {
    std::int64_t count = 0;
    for (; count < steps && !stop(); ++count, ++taken)
      body->advance(time_step());
    return count;
  }

  std::int64_t MovingSolid::advance_to(const double time, const std::function<bool()> &stop)
  {
    constexpr double rounding = 1e-12; // of sums of steps, as a run has it
    std::int64_t     count    = 0;
    for (; body->time() < time * (1 - rounding) && !stop(); ++count, ++taken)
      {
        const double rest = time - body->time();
        body->advance(own_step > 0 ? std::min(own_step, rest) : body->next_step(rest));
      }
    return count;
  }

  void MovingSolid::demand_node(const std::size_t node) const
  {
    demand_one_of("node", node, body->nodes().participant().carriers());
  }

  void MovingSolid::add_force(const std::size_t node, const Vector3d &force)
  {
    demand_node(node);
    body->nodes().participant().add_force(node, force);
  }

  void MovingSolid::apply_impulse(const std::size_t node, const Vector3d &change)
  {
    demand_node(node);
    body->nodes().participant().apply_impulse(node, change);
  }

  std::size_t MovingSolid::hold(const std::vector<std::size_t> &nodes, const std::array<bool, 3> &along)
  {
    for (const std::size_t node : nodes)
      {
        demand_node(node);
        for (int axis = 0; axis < 3; ++axis)
          if (along[axis] && body->nodes().is_held(node, axis))
            throw base::InputError("node " + std::to_string(node) + ": the scene prescribes its displacement along " +
                                   "xyz"[axis] + ".");
      }
    const std::size_t group = body->nodes().participant().prescribe(nodes, along);
    held.add(group, nodes.size());
    return group;
  }

  void MovingSolid::set_velocity(const std::size_t group, const Vector3d &velocity)
  {
    body->nodes().participant().set_motion(group, std::vector<Vector3d>(held.members_of(group), velocity));
  }

  Vector3d MovingSolid::reaction(const std::size_t group) const
  {
    held.members_of(group);
    return body->nodes().participant().reaction(group, Vector3d::Zero()).force;
  }

  void MovingSolid::save()
  {
    body->nodes().participant().save();
    held.keep();
    taken_then = taken;
  }

  void MovingSolid::restore()
  {
    held.require_kept();
    body->nodes().participant().restore();
    taken = taken_then;
  }

  namespace
  {
    py::array_t<double> masses(const MovingSolid &moving)
    {
      const coupling::Participant &nodes = moving.solid().nodes().participant();
      std::vector<double>          found(nodes.carriers());
      for (std::size_t i = 0; i < found.size(); ++i)
        found[i] = nodes.mass(i);
      return array_of(found);
    }
  } // namespace

  void bind_moving_solid(py::module_ &module)
  {
    using Moving = MovingSolid;
    py::class_<Moving>(module, "MovingSolid")
      .def(py::init<const std::string &, const std::vector<std::string> &>())
      .def_property_readonly("time", [](const Moving &m) { return m.solid().time(); })
      .def_property_readonly("time_step", &Moving::time_step)
      .def_property_readonly("longest_step", [](const Moving &m) { return m.solid().longest_step(); })
      .def_property_readonly("steps", &Moving::steps)
      .def("set_time_step", &Moving::set_time_step)
      .def("places", [](const Moving &m) { return places_of(m.solid().nodes()); })
      .def("displacement", [](const Moving &m) { return displacements_of(m.solid().nodes()); })
      .def("velocity", [](const Moving &m) { return velocities_of(m.solid().nodes()); })
      .def("mass", &masses)
      .def("nodes_on", [](const Moving &m, const std::string &boundary) { return m.solid().nodes().on(boundary); })
      .def("values", [](const Moving &m) { return named_numbers(m.solid().columns(), m.solid().row()); })
      .def("advance",
           [](Moving &m, const std::int64_t steps) {
             return let_interrupt([&](const auto &stop) { return m.advance(steps, stop); });
           })
      .def("advance_to",
           [](Moving &m, const double time) {
             return let_interrupt([&](const auto &stop) { return m.advance_to(time, stop); });
           })
      .def("add_force", &Moving::add_force)
      .def("clear_forces", [](Moving &m) { m.solid().clear_forces(); })
      .def("apply_impulse", &Moving::apply_impulse)
      .def("hold", &Moving::hold)
      .def("set_velocity", &Moving::set_velocity)
      .def("reaction", &Moving::reaction)
      .def("save", &Moving::save)
      .def("restore", &Moving::restore);
  }
} // namespace python
