#include "python/moving_particles.h"

#include "apps/scene/reader.h"
#include "apps/scene/scene_of.h"
#include "base/errors.h"
#include "base/flat_state.h"
#include "dem/specimen/particle_columns.h"
#include "python/signals.h"
#include "python/specimen_arrays.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <stdexcept>

namespace py = pybind11;

namespace python
{
  using Eigen::Vector3d;

  MovingParticles::MovingParticles(const std::string &file, const std::vector<std::string> &changes)
    : scene(apps::read_scene(file, changes))
  {
    const auto *particles = dynamic_cast<const apps::SceneOf<apps::ParticlesModel> *>(scene.scene.get());
    if (!particles)
      throw base::InputError(file + ": Kind = " + scene.kind +
                             ": only scenes of kind particles are moved step by step.");
    apps::with_places(*scene.root, [&] {
      packing = particles->model().packing();
      body    = std::make_unique<apps::ParticlesBody>(particles->model(), packing);
      body->start();
    });
  }

  std::int64_t MovingParticles::advance(const std::int64_t steps, const std::function<bool()> &stop)
  {
    dem::Partners partners = specimen().partners();
    std::int64_t  taken    = 0;
    for (; taken < steps && !stop(); ++taken)
      {
        partners.clear_forces(); // the scene's are entered anew in every step, and ours beside them
        body->drive_next_step();
        for (const auto &[particle, push] : pushes)
          partners.add_force(particle, push.force, push.couple);
        specimen().advance(1);
      }
    partners.clear_forces();
    return taken;
  }

  void MovingParticles::demand_particle(const std::size_t particle) const
  {
    if (particle >= packing.size())
      throw std::out_of_range("particle " + std::to_string(particle) + ": there are " + std::to_string(packing.size()) +
                              ", from 0.");
  }

  void MovingParticles::demand_group(const std::size_t group) const
  {
    if (std::find(held.begin(), held.end(), group) == held.end())
      throw std::out_of_range("group " + std::to_string(group) + ": hold() has made no such group.");
  }

  void MovingParticles::add_force(const std::size_t particle, const Vector3d &force, const Vector3d &couple)
  {
    demand_particle(particle);
    Push &push = pushes[particle];
    push.force += force;
    push.couple += couple;
  }

  void MovingParticles::apply_impulse(const std::size_t particle, const Vector3d &change, const Vector3d &spin)
  {
    demand_particle(particle);
    specimen().partners().apply_impulse(particle, change, spin);
  }

  std::size_t MovingParticles::hold(const std::vector<std::size_t> &particles, const std::array<bool, 6> &along)
  {
    for (const std::size_t particle : particles)
      demand_particle(particle);
    dem::Grip grip;
    grip.particles  = particles;
    grip.prescribed = along;
    held.push_back(specimen().grips().add(grip));
    return held.back();
  }

  void MovingParticles::set_velocity(const std::size_t group, const Vector3d &velocity, const Vector3d &spin)
  {
    demand_group(group);
    specimen().grips().set_velocity(group, velocity, spin);
  }

  Vector3d MovingParticles::reaction(const std::size_t group) const
  {
    demand_group(group);
    return specimen().grips().reaction(group);
  }

  void MovingParticles::save()
  {
    saved.clear();
    base::FlatStateWriter writer(saved);
    body->visit_state(writer);
    held_then = held.size();
  }

  void MovingParticles::restore()
  {
    if (saved.empty())
      throw std::logic_error("no state has been saved.");
    if (held.size() != held_then)
      throw std::logic_error("the saved state knows nothing of groups that are held since.");
    base::FlatStateReader reader(saved);
    body->visit_state(reader);
  }

  namespace
  {
    /** Three numbers of each particle's record, where they lie. */
    py::array_t<double> vectors_in(const py::object &owner, const base::Column &column, const std::size_t particles)
    {
      constexpr auto      size = static_cast<py::ssize_t>(sizeof(double));
      py::array_t<double> view({static_cast<py::ssize_t>(particles), py::ssize_t{3}}, {dem::record_size * size, size},
                               column.data(), owner);
      view.attr("flags").attr("writeable") = false;
      return view;
    }

    template <typename Value>
    py::array_t<Value>
    numbers_in(const py::object &owner, const Value *first, const std::size_t stride, const std::size_t n)
    {
      py::array_t<Value> view({static_cast<py::ssize_t>(n)}, {static_cast<py::ssize_t>(stride * sizeof(Value))}, first,
                              owner);
      view.attr("flags").attr("writeable") = false;
      return view;
    }

  } // namespace

  py::dict views_of(const py::object &owner, const dem::Specimen &specimen)
  {
    const dem::Particles &p = dem::particle_columns(specimen);
    py::dict              views;
    views["position"]     = vectors_in(owner, p.pose, p.count);
    views["velocity"]     = vectors_in(owner, p.velocity, p.count);
    views["force"]        = vectors_in(owner, p.force, p.count);
    views["radius"]       = numbers_in(owner, p.pose.data() + 6, dem::record_size, p.count);
    views["mass"]         = numbers_in(owner, p.mass.data(), 1, p.count);
    views["number"]       = numbers_in(owner, p.number.data(), 1, p.count);
    views["broken_links"] = numbers_in(owner, p.broken_links.data(), 1, p.count);
    return views;
  }

  namespace
  {

    std::int64_t advance(MovingParticles &moving, const std::int64_t steps)
    {
      return let_interrupt([&](const auto &stop) { return moving.advance(steps, stop); });
    }

    py::dict energies(const MovingParticles &moving)
    {
      const dem::EnergyAccount e = moving.specimen().energy();
      py::dict                 named;
      named["initial"]       = e.initial;
      named["external_work"] = e.external_work;
      named["gravity"]       = e.gravity;
      named["kinetic"]       = e.kinetic;
      named["elastic"]       = e.elastic;
      named["damage"]        = e.damage;
      named["friction"]      = e.friction;
      named["released"]      = e.released;
      named["damping"]       = e.damping;
      named["balance_error"] = e.balance_error();
      return named;
    }
  } // namespace

  void bind_moving_particles(py::module_ &module)
  {
    using Moving = MovingParticles;
    py::class_<Moving>(module, "MovingParticles")
      .def(py::init<const std::string &, const std::vector<std::string> &>())
      .def_property_readonly("time", [](const Moving &m) { return m.specimen().time(); })
      .def_property_readonly("time_step", [](const Moving &m) { return m.specimen().time_step(); })
      .def_property_readonly("longest_step", [](const Moving &m) { return m.specimen().longest_step(); })
      .def_property_readonly("steps", [](const Moving &m) { return m.specimen().steps(); })
      .def("set_time_step", [](Moving &m, const double step) { m.specimen().set_time_step(step); })
      .def("views", [](const py::object &owner) { return views_of(owner, owner.cast<const Moving &>().specimen()); })
      .def("links", [](const Moving &m) { return links_in(m.specimen()); })
      .def("advance", &advance)
      .def("energies", &energies)
      .def("add_force", &Moving::add_force)
      .def("clear_forces", &Moving::clear_forces)
      .def("apply_impulse", &Moving::apply_impulse)
      .def("hold", &Moving::hold)
      .def("set_velocity", &Moving::set_velocity)
      .def("reaction", &Moving::reaction)
      .def("save", &Moving::save)
      .def("restore", &Moving::restore);
  }
} // namespace python
