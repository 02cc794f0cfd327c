#include "coupling/participants/peridynamic_participant.h"

#include "base/errors.h"
#include "coupling/participants/window.h"

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>
#include <string>

namespace coupling
{
  namespace pd = dem::peridynamics;
  using Eigen::Vector3d;

  PeridynamicParticipant::PeridynamicParticipant(pd::Bonds       &bonds,
                                                 const pd::Loads &loads,
                                                 const Setup     &setup,
                                                 const pd::Field &velocity)
    : body(bonds)
    , kinematics(setup.kinematics)
    , own(loads)
    , all(loads)
    , longest_step(setup.step_factor * pd::Motion::stable_step(bonds, setup.repulsion))
    , pushed(bonds.grid().field())
  {
    all.forces = [this](const double at, const pd::Field *const u, pd::Field &forces) {
      own.forces(at, u, forces);
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < forces.c[c].size(); ++i)
          forces.c[c][i] += pushed.c[c][i];
    };
    all.displacements = [this](const double at, pd::Field &u) { drive(at, u); };
    moving.emplace(body, all, setup.kinematics, velocity, longest_step);
    if (setup.repulsion > 0)
      moving->repel(body, setup.repulsion);
  }

  void PeridynamicParticipant::drive(const double at, pd::Field &u) const
  {
    own.displacements(at, u);
    if (!moving) // at the start nothing from outside moves it
      return;
    // What others prescribe goes on from where it is: the motion takes the next place before a step, and keeps it after.
    const double ahead = at - moving->time();
    for (const Group &group : groups)
      for (std::size_t k = 0; k < group.carriers.size(); ++k)
        for (std::size_t c = 0; c < 3; ++c)
          if (group.along[c] && !u.c[c].empty())
            u.c[c][place(group.carriers[k])] += ahead * group.velocity[k][static_cast<Eigen::Index>(c)];
  }

  std::size_t PeridynamicParticipant::carriers() const { return body.grid().nodes().size(); }

  Vector3d PeridynamicParticipant::position(const std::size_t carrier) const
  {
    return body.grid().position(place(carrier)) + moving->displacement().at(place(carrier));
  }

  Vector3d PeridynamicParticipant::velocity(const std::size_t carrier) const
  {
    return moving->velocity().at(place(carrier));
  }

  double PeridynamicParticipant::mass(const std::size_t carrier) const { return moving->mass_of(place(carrier)); }

  double PeridynamicParticipant::time() const { return moving->time(); }

  ParticipantEnergy PeridynamicParticipant::energy() const
  {
    pd::Motion         now     = *moving; // energies are found with work space of its own
    const pd::Energies e       = now.energies(body);
    const double       largest = e.largest();
    return {e.initial, e.external, e.kinetic, e.strain + e.repulsion + e.released,
            largest > 0 ? std::abs(e.residual()) / largest : 0.0};
  }

  void PeridynamicParticipant::advance(const double window, const int steps)
  {
    walk_window(*this, window, steps, [&](const double step) {
      update_loads(step);
      moving->step(body, all);
      for (const std::size_t i : body.grid().nodes())
        if (!std::isfinite(moving->displacement().at(i).sum()))
          throw base::NumericalError("peridynamics: the motion has left the real numbers at " +
                                     std::to_string(moving->time()) + " s.");
    });
    pushed = body.grid().field();
    stale  = true;
  }

  void PeridynamicParticipant::update_loads(const double step)
  {
    if (!stale && step == moving->step_length())
      return;
    moving->set_step(step);
    moving->update_loads(all);
    stale = false;
  }

  void PeridynamicParticipant::add_force(const std::size_t carrier, const Vector3d &force)
  {
    pushed.add(place(carrier), force);
    stale = true;
  }

  void PeridynamicParticipant::add_couple(std::size_t, const Vector3d &)
  {
    throw std::logic_error("participant: a node of a peridynamic body cannot turn, and takes no couple.");
  }

  void PeridynamicParticipant::apply_impulse(const std::size_t carrier, const Vector3d &change)
  {
    moving->change_velocity(place(carrier), change, all);
  }

  std::size_t PeridynamicParticipant::prescribe(const std::vector<std::size_t> &which, const std::array<bool, 3> &along)
  {
    for (const std::size_t carrier : which)
      for (int c = 0; c < body.grid().dimension(); ++c)
        if (along[static_cast<std::size_t>(c)])
          {
            if (is_held(carrier, c))
              throw base::InputError("participant: the motion of node " + std::to_string(carrier + 1) +
                                     " is prescribed already.");
            all.held[place(carrier)] |= static_cast<std::uint8_t>(1u << c);
          }
    groups.push_back({which, along, std::vector<Vector3d>(which.size(), Vector3d::Zero())});
    stale = true;
    return groups.size() - 1;
  }

  void PeridynamicParticipant::set_motion(const std::size_t group, const std::vector<Vector3d> &velocity)
  {
    Group &g = groups.at(group);
    if (velocity.size() != g.carriers.size())
      throw base::InputError("participant: a group of " + std::to_string(g.carriers.size()) + " nodes was given " +
                             std::to_string(velocity.size()) + " velocities.");
    g.velocity = velocity;
    stale      = true;
  }

  Reaction PeridynamicParticipant::reaction(const std::size_t group, const Vector3d &about) const
  {
    pd::Field acting = body.grid().field();
    all.forces(moving->time(), kinematics == pd::Kinematics::nonlinear ? &moving->displacement() : nullptr, acting);
    Reaction sum;
    for (const std::size_t carrier : groups.at(group).carriers)
      {
        const std::size_t i     = place(carrier);
        Vector3d          force = -(moving->forces().at(i) + acting.at(i));
        for (int c = 0; c < 3; ++c)
          if (!groups[group].along[static_cast<std::size_t>(c)])
            force[c] = 0;
        sum.force += force;
        sum.moment += (position(carrier) - about).cross(force);
      }
    return sum;
  }

  void PeridynamicParticipant::save() { saved.emplace(Saved{*moving, body.stiffness(), pushed, groups, all.held}); }

  void PeridynamicParticipant::restore()
  {
    if (!saved)
      throw std::logic_error("participant: no state has been saved.");
    *moving          = saved->motion;
    body.stiffness() = saved->stiffness;
    pushed           = saved->pushed;
    groups           = saved->groups;
    all.held         = saved->held;
    stale            = true;
  }

  Vector3d PeridynamicParticipant::velocity_ahead(const std::size_t carrier, const double step)
  {
    update_loads(step);
    return moving->velocity_ahead(place(carrier));
  }

  bool PeridynamicParticipant::is_held(const std::size_t carrier, const int axis) const
  {
    return (all.held[place(carrier)] >> axis & 1) != 0;
  }

  Vector3d PeridynamicParticipant::force_on_held() const
  {
    Vector3d sum = Vector3d::Zero();
    for (const std::size_t i : body.grid().nodes())
      for (int c = 0; c < 3; ++c)
        if ((own.held[i] >> c & 1) != 0)
          sum[c] += moving->pushes().at(i)[c];
    return sum;
  }

  void PeridynamicParticipant::visit_state(base::StateVisitor &visitor)
  {
    body.visit_state(visitor);
    moving->visit_state(visitor);
  }
} // namespace coupling
