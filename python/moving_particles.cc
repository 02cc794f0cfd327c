#include "python/moving_particles.h"

#include "apps/scene/reader.h"
#include "apps/scene/scene_of.h"
#include "base/entry_path.h"
#include "base/errors.h"
#include "python/signals.h"
#include "python/specimen_arrays.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

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
      if (particles->model().precice.given())
        throw base::EntryError({"preCICE"}, "Participant",
                               "particles moved step by step are coupled by the program that moves them.");
      packing = particles->model().packing();
      body    = std::make_unique<apps::ParticlesBody>(particles->model(), packing);
      body->start();
      driven = std::make_unique<apps::DrivenParticles>(*body);
    });
  }

  std::int64_t MovingParticles::advance(const std::int64_t steps, const std::function<bool()> &stop)
  {
    std::int64_t taken = 0;
    for (; taken < steps && !stop(); ++taken)
      driven->take(specimen().time_step());
    return taken;
  }

  void MovingParticles::demand_particle(const std::size_t particle) const
  {
    demand_one_of("particle", particle, packing.size());
  }

  void MovingParticles::add_force(const std::size_t particle, const Vector3d &force, const Vector3d &couple)
  {
    demand_particle(particle);
    driven->add_force(particle, force);
    driven->add_couple(particle, couple);
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
    grip.particles          = particles;
    grip.prescribed         = along;
    const std::size_t group = specimen().grips().add(grip);
    held.add(group, particles.size());
    return group;
  }

  void MovingParticles::set_velocity(const std::size_t group, const Vector3d &velocity, const Vector3d &spin)
  {
    held.members_of(group);
    specimen().grips().set_velocity(group, velocity, spin);
  }

  Vector3d MovingParticles::reaction(const std::size_t group) const
  {
    held.members_of(group);
    return specimen().grips().reaction(group);
  }

  void MovingParticles::save()
  {
    driven->save();
    held.keep();
  }

  void MovingParticles::restore()
  {
    held.require_kept();
    driven->restore();
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
