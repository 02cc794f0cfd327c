#include "coupling/concurrent/concurrent_motion.h"

#include "coupling/contact/contact_motion.h"
#include "coupling/participants/window.h"

#include <algorithm>
#include <cmath>

namespace coupling
{
  template <int dim>
  ConcurrentMotion<dim>::ConcurrentMotion(dem::Specimen                  &specimen_,
                                          const fem::Solid<dim>          &solid_,
                                          fem::ExplicitSolver<dim>       &motion_,
                                          SolidParticipant<dim>          &participant_,
                                          std::function<void()>           lead_,
                                          const std::vector<std::string> &rigid)
    : specimen(specimen_)
    , solid(solid_)
    , motion(motion_)
    , participant(participant_)
    , particles(specimen_)
    , lead(std::move(lead_))
    , body_contacts(solid_, participant_)
    , rigid_bodies(solid_, motion_, participant_, rigid)
  {
  }

  template <int dim>
  const SurfaceCoupling<dim> &ConcurrentMotion<dim>::add_surface(const SurfaceCouplingParameters &parameters)
  {
    couplings.push_back(std::make_unique<SurfaceCoupling<dim>>(specimen, solid, participant, parameters));
    return *couplings.back();
  }

  template <int dim>
  double ConcurrentMotion<dim>::solid_step() const
  {
    return step_with_contacts(motion, stiffest + body_contacts.stiffest());
  }

  template <int dim>
  WindowSteps ConcurrentMotion<dim>::next_window(const double rest) const
  {
    constexpr double rounding = 1e-12;
    const double     of_solid = solid_step(), of_particles = particle_step();
    // Sub-cycled, a contact alone is stable up to lambda T^2 = 2 (doc/theory/surface-coupling.md, 2).
    const double calm    = stiffest > 0 ? std::min(of_solid, 1.2 / std::sqrt(stiffest)) : of_solid;
    const double most    = std::clamp(std::floor(calm / of_particles), 1.0, static_cast<double>(largest_ratio));
    const double longest = most > 1 ? std::min(calm, most * of_particles) : std::min(of_solid, of_particles);
    WindowSteps  steps;
    steps.particles = static_cast<int>(most);
    steps.window    = rest / std::max(1.0, std::ceil(rest / longest * (1 - rounding)));
    return steps;
  }

  template <int dim>
  WindowSteps ConcurrentMotion<dim>::advance(const double rest)
  {
    double added = 0;
    for (const auto &c : couplings)
      c->kinematics_to_dem();
    specimen.find_surface_forces();
    for (const auto &c : couplings)
      added += c->added_eigenvalue();
    stiffest                = std::max(stiffest, added);
    const WindowSteps steps = next_window(rest);
    if (steps.particles > 1)
      {
        // Nodes go on as they came: the solid then feels the forces of this very window, which at most takes energy. Those of the
        // window before, for which nothing would have to be guessed, feed whatever they act on.
        for (const auto &c : couplings)
          c->motion_to_dem_as_before(last_solid_step);
        move_particles(steps);
        move_solid(steps);
      }
    else
      {
        move_solid(steps);
        for (const auto &c : couplings)
          c->motion_to_dem(steps.window);
        move_particles(steps);
        for (const auto &c : couplings)
          c->settle();
      }
    body_contacts.find();
    return steps;
  }

  template <int dim>
  void ConcurrentMotion<dim>::move_solid(const WindowSteps &steps)
  {
    // Leapfrog: forces act over half the step before and half the step after. Both sides get the same impulse.
    const double of_particles = kick_of(steps.window, last_particle_step),
                 of_solid     = kick_of(steps.window, last_solid_step);
    for (const auto &c : couplings)
      c->forces_to_fem(of_solid, steps.particles > 1 ? 0.0 : of_particles / of_solid);
    body_contacts.push(of_solid);
    rigid_bodies.lead(last_solid_step > 0 ? of_solid : 0.5 * steps.window, steps.window);
    participant.advance(steps.window, 1);
    for (const auto &c : couplings)
      c->solid_has_moved();
    last_solid_step = steps.window;
  }

  template <int dim>
  void ConcurrentMotion<dim>::move_particles(const WindowSteps &steps)
  {
    walk_window(particles, steps.window, steps.particles, [this](const double step) {
      specimen.set_time_step(step);
      if (lead)
        lead();
      specimen.advance(1);
      last_particle_step = step;
    });
  }

  template <int dim>
  void ConcurrentMotion<dim>::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("stiffest_contacts", stiffest);
    visitor.scalar("last_particle_step", last_particle_step);
    visitor.scalar("last_solid_step", last_solid_step);
    for (const auto &c : couplings)
      c->visit_state(visitor);
    body_contacts.visit_state(visitor);
    rigid_bodies.visit_state(visitor);
  }

  template class ConcurrentMotion<2>;
  template class ConcurrentMotion<3>;
} // namespace coupling
