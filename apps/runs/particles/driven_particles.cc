#include "apps/runs/particles/driven_particles.h"

#include "base/flat_state.h"
#include "coupling/participants/window.h"

#include <stdexcept>

namespace apps
{
  DrivenParticles::DrivenParticles(ParticlesBody &particles)
    : coupling::ParticleParticipant(particles.specimen())
    , body(particles)
  {
  }

  void DrivenParticles::take(const double step)
  {
    dem::Specimen &specimen = body.specimen();
    dem::Partners  partners = specimen.partners();
    if (step != specimen.time_step())
      specimen.set_time_step(step);
    partners.clear_forces(); // the scene's are entered anew in every step
    body.drive_next_step();
    for (const auto &[carrier, push] : pushes)
      partners.add_force(carrier, push.force, push.couple);
    specimen.advance(1);
    partners.clear_forces();
  }

  void DrivenParticles::advance(const double window, const int steps)
  {
    coupling::walk_window(*this, window, steps, [this](const double step) { take(step); });
    let_go();
  }

  void DrivenParticles::add_force(const std::size_t carrier, const Eigen::Vector3d &force)
  {
    pushes[carrier].force += force;
  }

  void DrivenParticles::add_couple(const std::size_t carrier, const Eigen::Vector3d &couple)
  {
    pushes[carrier].couple += couple;
  }

  void DrivenParticles::save()
  {
    saved.clear();
    base::FlatStateWriter writer(saved);
    body.visit_state(writer);
  }

  void DrivenParticles::restore()
  {
    if (saved.empty())
      throw std::logic_error("participant: no state has been saved.");
    base::FlatStateReader reader(saved);
    body.visit_state(reader);
  }
} // namespace apps
