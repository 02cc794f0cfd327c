#include "coupling/participants/particle_participant.h"

#include "coupling/participants/window.h"

#include <stdexcept>

namespace coupling
{
  using Eigen::Vector3d;

  ParticleParticipant::ParticleParticipant(dem::Specimen &specimen_)
    : specimen(specimen_)
  {
  }

  std::size_t ParticleParticipant::carriers() const { return specimen.counts().particles; }

  Vector3d ParticleParticipant::position(const std::size_t carrier) const
  {
    return specimen.particle(carrier).position;
  }

  Vector3d ParticleParticipant::velocity(const std::size_t carrier) const
  {
    return specimen.particle(carrier).velocity;
  }

  double ParticleParticipant::mass(const std::size_t carrier) const { return specimen.mass(carrier); }

  double ParticleParticipant::time() const { return specimen.time(); }

  double ParticleParticipant::stable_step() const { return specimen.longest_step(); }

  ParticipantEnergy ParticleParticipant::energy() const
  {
    const dem::EnergyAccount e = specimen.energy();
    return {e.initial + e.gravity, e.external_work, e.kinetic,
            e.elastic + e.damage + e.friction + e.released + e.damping, e.balance_error()};
  }

  void ParticleParticipant::advance(const double window, const int steps)
  {
    walk_window(*this, window, steps, [&](const double step) {
      specimen.set_time_step(step);
      specimen.advance(1);
    });
    specimen.partners().clear_forces();
  }

  void ParticleParticipant::add_force(const std::size_t carrier, const Vector3d &force)
  {
    specimen.partners().add_force(carrier, force, Vector3d::Zero());
  }

  void ParticleParticipant::add_couple(const std::size_t carrier, const Vector3d &couple)
  {
    specimen.partners().add_force(carrier, Vector3d::Zero(), couple);
  }

  void ParticleParticipant::apply_impulse(const std::size_t carrier, const Vector3d &change)
  {
    specimen.partners().apply_impulse(carrier, change, Vector3d::Zero());
  }

  std::size_t ParticleParticipant::prescribe(const std::vector<std::size_t> &carriers, const std::array<bool, 3> &along)
  {
    dem::Grip grip;
    grip.particles  = carriers;
    grip.prescribed = {along[0], along[1], along[2]};
    return specimen.grips().add(grip);
  }

  void ParticleParticipant::set_motion(const std::size_t group, const std::vector<Vector3d> &velocity)
  {
    specimen.grips().set_velocities(group, velocity, std::vector<Vector3d>(velocity.size(), Vector3d::Zero()));
  }

  Reaction ParticleParticipant::reaction(const std::size_t group, const Vector3d &about) const
  {
    return {specimen.grips().reaction(group), specimen.grips().reaction_moment(group, about)};
  }

  void ParticleParticipant::save() { saved = specimen; }

  void ParticleParticipant::restore()
  {
    if (!saved)
      throw std::logic_error("participant: no state has been saved.");
    specimen = *saved;
  }
} // namespace coupling
