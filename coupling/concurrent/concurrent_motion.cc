#include "coupling/concurrent/concurrent_motion.h"

#include "base/errors.h"
#include "base/flat_state.h"
#include "coupling/contact/contact_motion.h"
#include "coupling/participants/window.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace coupling
{
  namespace
  {
    /** Of either side in one of the other. */
    bool takes_several(const WindowSteps &steps) { return std::max(steps.particles, steps.solid) > 1; }
  } // namespace

  template <int dim>
  ConcurrentMotion<dim>::ConcurrentMotion(dem::Specimen                  &specimen_,
                                          const fem::Solid<dim>          &solid_,
                                          fem::ExplicitSolver<dim>       &motion_,
                                          SolidParticipant<dim>          &participant_,
                                          std::function<void()>           drive_,
                                          const std::vector<std::string> &rigid)
    : specimen(specimen_)
    , solid(solid_)
    , motion(motion_)
    , participant(participant_)
    , particles(specimen_)
    , drive(std::move(drive_))
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
  const VolumeCoupling<dim> &ConcurrentMotion<dim>::add_volume(const VolumeCouplingParameters &parameters)
  {
    handshakes.push_back(std::make_unique<VolumeCoupling<dim>>(specimen, solid, motion, participant, parameters));
    const auto refuse_shared = [&](const char *what, const auto &of) {
      std::vector<std::size_t> sorted;
      for (const auto &h : handshakes)
        {
          const std::vector<std::size_t> some = of(*h);
          sorted.insert(sorted.end(), some.begin(), some.end());
        }
      std::sort(sorted.begin(), sorted.end());
      if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
        throw base::InputError("Handshakes/" + parameters.name + ": " + what + " " + std::to_string(*twice + 1) +
                               " takes part in another one already. Move them further apart.");
    };
    refuse_shared("particle", [](const VolumeCoupling<dim> &h) { return h.particles(); });
    // Each would undo what the other does to it.
    refuse_shared("node", [](const VolumeCoupling<dim> &h) { return h.node_carriers(); });
    return *handshakes.back();
  }

  template <int dim>
  double ConcurrentMotion<dim>::solid_step() const
  {
    double added = 0; // no node is of two handshakes
    for (const auto &h : handshakes)
      added = std::max(added, h->added_eigenvalue());
    return step_with_contacts(motion, stiffest + added + body_contacts.stiffest());
  }

  template <int dim>
  void ConcurrentMotion<dim>::check_windows(std::function<void(base::StateVisitor &)> state_of_drive)
  {
    checked     = true;
    drive_state = std::move(state_of_drive);
  }

  template <int dim>
  WindowSteps ConcurrentMotion<dim>::next_window(const double rest, const int ratio) const
  {
    constexpr double rounding = 1e-12;
    const double     of_solid = solid_step(), of_particles = particle_step();
    // Sub-cycled, a contact alone is stable up to lambda T^2 = 2 for the side that takes the long step
    // (doc/theory/surface-coupling.md, 2). Particles' own step has lambda T^2 <= 2 f^2, f their step factor.
    constexpr double calm_phase     = 1.2;
    const double     stable         = stiffest > 0 ? std::min(of_solid, calm_phase / std::sqrt(stiffest)) : of_solid;
    const double     calm           = std::min(stable, sub_cycling.longest_window(std::min(of_solid, of_particles)));
    const double     calm_particles = std::min(
          of_particles * std::min(1.0, calm_phase / (std::sqrt(2.0) * specimen.parameters().step_factor)),
      ratio > 1 && of_particles > of_solid ? sub_cycling.longest_window(of_solid, power_of_gliding()) : of_particles);
    const auto parts = [&](const double longer, const double step) {
      return static_cast<int>(std::clamp(std::floor(longer / step), 1.0, static_cast<double>(ratio)));
    };
    WindowSteps steps;
    steps.particles      = parts(calm, of_particles);
    steps.solid          = handshakes.empty() ? parts(calm_particles, of_solid) : 1;
    const double longest = steps.particles > 1 ? std::min(calm, steps.particles * of_particles) :
                           steps.solid > 1     ? std::min(calm_particles, steps.solid * of_solid) :
                                                 std::min(of_solid, of_particles);
    steps.window         = rest / std::max(1.0, std::ceil(rest / longest * (1 - rounding)));
    return steps;
  }

  template <int dim>
  WindowSteps ConcurrentMotion<dim>::advance(const double rest)
  {
    for (int ratio = largest_ratio;;)
      {
        const bool kept = checked && takes_several(next_window(rest, ratio)); // the update can only make it shorter
        if (kept)
          save();
        // Before the update, which puts vertices to where nodes are: that is work, too.
        const double before = largest_ratio > 1 ? spurious() : 0;
        update_couplings();
        const WindowSteps taken = take(next_window(rest, ratio));
        if (largest_ratio == 1)
          return taken;
        const double made_now = spurious() - before;
        if (!kept || !sub_cycling.loses_too_much(taken, made_now))
          {
            sub_cycling.note(taken, made_now);
            const fem::ExplicitEnergy &of_solid = motion.energy();
            sub_cycling.note_energy(
              std::max(specimen.kinetic_energy(), of_solid.kinetic + std::fabs(of_solid.internal)));
            return taken;
          }
        restore();
        sub_cycling.expect(taken, made_now);
        ++windows_taken_back;
        ratio = std::max(1, std::max(taken.particles, taken.solid) / 2);
      }
  }

  template <int dim>
  void ConcurrentMotion<dim>::save()
  {
    particles.save();
    participant.save();
    between.clear();
    base::FlatStateWriter writer(between);
    visit_state(writer);
    if (drive_state)
      drive_state(writer);
  }

  template <int dim>
  void ConcurrentMotion<dim>::restore()
  {
    particles.restore();
    participant.restore();
    base::FlatStateReader reader(between);
    visit_state(reader);
    if (drive_state)
      drive_state(reader);
  }

  template <int dim>
  WindowSteps ConcurrentMotion<dim>::take(const WindowSteps &steps)
  {
    if (!handshakes.empty())
      handshake(steps);
    else if (steps.particles > 1)
      sub_cycle_particles(steps);
    else if (steps.solid > 1 || after_glide())
      return sub_cycle_solid(steps);
    else
      move_together(steps);
    return steps;
  }

  template <int dim>
  double ConcurrentMotion<dim>::power_of_gliding() const
  {
    std::map<std::size_t, Eigen::Vector3d> forces; // in the order of particles
    for (const dem::WallContact &contact : specimen.surfaces().contacts())
      if (std::any_of(couplings.begin(), couplings.end(),
                      [&](const auto &coupling) { return coupling->surface() == contact.surface; }))
        forces.emplace(contact.particle, Eigen::Vector3d::Zero()).first->second += contact.force;
    double sum = 0;
    for (const auto &[particle, force] : forces)
      sum += 0.5 * force.squaredNorm() / specimen.mass(particle);
    return sum;
  }

  template <int dim>
  double ConcurrentMotion<dim>::spurious() const
  {
    double sum = 0;
    if (
      !handshakes
         .empty()) // constrained particles that move nodes within a window leave the solid with energy that no force has brought
      {
        const fem::ExplicitEnergy &e = motion.energy();
        sum                          = e.kinetic + e.internal + e.damped - e.external - e.start;
      }
    for (const auto &c : couplings)
      sum += c->balance().spurious();
    for (const auto &h : handshakes)
      if (!h->loses_by_itself())
        sum += h->balance().spurious();
    return sum;
  }

  template <int dim>
  void ConcurrentMotion<dim>::update_couplings()
  {
    double added = 0;
    for (const auto &c : couplings)
      c->kinematics_to_dem();
    specimen.partners().find_surface_forces();
    for (const auto &c : couplings)
      added += c->added_eigenvalue();
    stiffest = std::max(stiffest, added);
  }

  template <int dim>
  void ConcurrentMotion<dim>::sub_cycle_particles(const WindowSteps &steps)
  {
    // Nodes go on as they came: the solid then feels the forces of this very window, which at most takes energy. Those of the
    // window before, for which nothing would have to be guessed, feed whatever they act on.
    for (const auto &c : couplings)
      c->motion_to_dem_as_before(last_solid_step);
    move_particles(steps);
    move_solid(steps.window, 0);
  }

  template <int dim>
  WindowSteps ConcurrentMotion<dim>::sub_cycle_solid(WindowSteps steps)
  {
    // The same with sides exchanged: particles glide on as they came.
    const double step = steps.window / steps.solid;
    specimen.set_time_step(steps.window);
    if (drive)
      drive();
    specimen.partners().begin_glide();
    for (int taken = 0; taken < steps.solid; ++taken)
      {
        if (taken > 0)
          update_couplings();
        if (taken > 0 && (specimen.longest_step() < steps.window || solid_step() < step))
          steps.solid = taken; // a new contact needs shorter steps
        else
          {
            const double kick = kick_of(step, last_solid_step);
            move_solid(step, 1);
            for (const auto &c : couplings)
              c->motion_to_dem(step);
            specimen.partners().glide(step, kick);
            for (const auto &c : couplings)
              c->settle();
          }
      }
    specimen.partners().finish_glide();
    steps.window       = steps.solid * step;
    last_particle_step = steps.window;
    return steps;
  }

  template <int dim>
  void ConcurrentMotion<dim>::move_together(const WindowSteps &steps)
  {
    // Leapfrog: forces act over half the step before and half the step after. Both sides get the same impulse.
    move_solid(steps.window, kick_of(steps.window, last_particle_step) / kick_of(steps.window, last_solid_step));
    for (const auto &c : couplings)
      c->motion_to_dem(steps.window);
    move_particles(steps);
    for (const auto &c : couplings)
      c->settle();
  }

  template <int dim>
  void ConcurrentMotion<dim>::handshake(const WindowSteps &steps)
  {
    // Surfaces want to know where the solid goes before particles move on; in a window of one step that is known by then.
    bool solid_waits = true;
    if (steps.particles == 1)
      push_solid(steps.window, kick_of(steps.window, last_particle_step) / kick_of(steps.window, last_solid_step));
    else
      for (const auto &c : couplings)
        c->motion_to_dem_as_before(last_solid_step);
    for (const auto &h : handshakes)
      h->begin(steps.window);
    walk_window(particles, steps.window, steps.particles, [&](const double step) {
      specimen.set_time_step(step);
      if (drive)
        drive();
      corrected.clear();
      std::vector<std::size_t> first;
      for (const auto &h : handshakes)
        {
          first.push_back(corrected.size());
          const auto count = static_cast<std::ptrdiff_t>(h->corrected_in(kick_of(step, last_particle_step)));
          corrected.insert(corrected.end(), h->particles().begin(), h->particles().begin() + count);
        }
      specimen.partners().advance(corrected, [&](dem::StepCorrection &correction) {
        for (std::size_t h = 0; h < handshakes.size(); ++h)
          handshakes[h]->correct(correction, first[h]);
        if (step < steps.window)
          return;
        step_solid(steps.window);
        solid_waits = false;
        for (const auto &c : couplings)
          c->motion_to_dem(steps.window);
      });
      last_particle_step = step;
    });
    if (steps.particles > 1)
      push_solid(steps.window, 0);
    if (solid_waits)
      step_solid(steps.window);
    if (steps.particles == 1)
      for (const auto &c : couplings)
        c->settle();
  }

  template <int dim>
  void ConcurrentMotion<dim>::push_solid(const double step, const double share)
  {
    const double kick = kick_of(step, last_solid_step);
    for (const auto &c : couplings)
      c->forces_to_fem(kick, share);
    body_contacts.push(kick);
    if (drive_solid)
      drive_solid();
    rigid_bodies.drive(last_solid_step > 0 ? kick : 0.5 * step, step);
  }

  template <int dim>
  void ConcurrentMotion<dim>::step_solid(const double step)
  {
    for (const auto &h : handshakes)
      h->finish();
    participant.advance(step, 1);
    for (const auto &c : couplings)
      c->solid_has_moved();
    last_solid_step = step;
    body_contacts.find();
  }

  template <int dim>
  void ConcurrentMotion<dim>::move_solid(const double step, const double share)
  {
    push_solid(step, share);
    step_solid(step);
  }

  template <int dim>
  void ConcurrentMotion<dim>::move_particles(const WindowSteps &steps)
  {
    walk_window(particles, steps.window, steps.particles, [this](const double step) {
      specimen.set_time_step(step);
      if (drive)
        drive();
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
    visitor.scalar("windows_taken_back", windows_taken_back);
    sub_cycling.visit_state(visitor);
    for (const auto &c : couplings)
      c->visit_state(visitor);
    for (const auto &h : handshakes)
      h->visit_state(visitor);
    body_contacts.visit_state(visitor);
    rigid_bodies.visit_state(visitor);
  }

  template class ConcurrentMotion<2>;
  template class ConcurrentMotion<3>;
} // namespace coupling
