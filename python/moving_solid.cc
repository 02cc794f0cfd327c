#include "python/moving_solid.h"

#include "apps/process/mpi_session.h"
#include "apps/scene/reader.h"
#include "apps/scene/scene_of.h"
#include "base/errors.h"
#include "base/number_text.h"
#include "python/arrays.h"
#include "python/signals.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <stdexcept>

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
    const std::size_t count = body->nodes().participant().carriers();
    if (node >= count)
      throw std::out_of_range("node " + std::to_string(node) + ": there are " + std::to_string(count) + ", from 0.");
  }

  void MovingSolid::demand_group(const std::size_t group) const
  {
    if (group >= sizes.size())
      throw std::out_of_range("group " + std::to_string(group) + ": hold() has made no such group.");
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
    sizes.push_back(nodes.size());
    return group;
  }

  void MovingSolid::set_velocity(const std::size_t group, const Vector3d &velocity)
  {
    demand_group(group);
    body->nodes().participant().set_motion(group, std::vector<Vector3d>(sizes[group], velocity));
  }

  Vector3d MovingSolid::reaction(const std::size_t group) const
  {
    demand_group(group);
    return body->nodes().participant().reaction(group, Vector3d::Zero()).force;
  }

  void MovingSolid::save()
  {
    body->nodes().participant().save();
    held_then  = sizes.size();
    taken_then = taken;
  }

  void MovingSolid::restore()
  {
    if (sizes.size() != held_then)
      throw std::logic_error("the saved state knows nothing of groups that are held since.");
    body->nodes().participant().restore();
    taken = taken_then;
  }

  namespace
  {
    template <typename VectorOfNode>
    py::array_t<double> of_nodes(const MovingSolid &moving, const VectorOfNode &vector_of)
    {
      const apps::SolidNodes &nodes = moving.solid().nodes();
      return array_of_vectors(nodes.participant().carriers(), [&](const std::size_t i) { return vector_of(nodes, i); });
    }

    py::array_t<double> masses(const MovingSolid &moving)
    {
      const coupling::Participant &nodes = moving.solid().nodes().participant();
      std::vector<double>          found(nodes.carriers());
      for (std::size_t i = 0; i < found.size(); ++i)
        found[i] = nodes.mass(i);
      return array_of(found);
    }

    py::list values(const MovingSolid &moving)
    {
      py::list                  found;
      const std::vector<double> row = moving.solid().row();
      std::size_t               c   = 0;
      for (const auto &column : moving.solid().columns())
        found.append(py::make_tuple(column.name, column.unit, row.at(c++)));
      return found;
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
      .def("places",
           [](const Moving &m) {
             return of_nodes(m, [](const auto &nodes, const std::size_t i) { return nodes.place(i); });
           })
      .def("displacement",
           [](const Moving &m) {
             return of_nodes(m, [](const auto &nodes, const std::size_t i) { return nodes.displacement(i); });
           })
      .def("velocity",
           [](const Moving &m) {
             return of_nodes(m, [](const auto &nodes, const std::size_t i) { return nodes.participant().velocity(i); });
           })
      .def("mass", &masses)
      .def("nodes_on", [](const Moving &m, const std::string &boundary) { return m.solid().nodes().on(boundary); })
      .def("values", &values)
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
