// Surfaces take several steps in one of the particles, which glide on meanwhile and take the impulses all at once.

#include "dem/specimen/glide.h"

#include "base/errors.h"
#include "dem/specimen/core.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  void SpecimenCore::begin_glide()
  {
    if (surfaces.viscous())
      throw base::InputError(
        "Surfaces take no steps of their own within those of particles where their contacts have a "
        "restitution below 1. Let both sides take the same steps.");
    if (step_count == 0)
      begin();
    gather_wall_contacts();
    before_glide      = surfaces.energies(shape, particles);
    gliding           = {};
    gliding.under_way = true;
    if (shares())
      {
        const std::vector<std::int32_t> read = read_by_surfaces();
        shared->share_velocities(particles, read);
        shared->share_displacements(particles, read);
      }
    gliding.pose     = particles.pose;
    gliding.motion   = particles.motion;
    gliding.velocity = particles.velocity;
    if (step_count > 0)
      return gliding.pushes.add_work_before(surfaces, unseen.empty() ? particles.motion : unseen);
    base::Column led_here = particles.velocity; // as the account's begin() has it
    for (double &rate : led_here)
      rate *= time_step;
    gliding.pushes.add_work_before(surfaces, led_here);
  }

  /** Put particles to where they have glided since they began [s]. @return their largest displacement on the way from where they were [m] */
  double SpecimenCore::place_gliding(const double since)
  {
    const double step    = since - gliding.glided;
    const auto   own     = own_particles();
    double       largest = 0;
#pragma omp parallel for schedule(static) reduction(max : largest)
    for (std::size_t i = 0; i < particles.count; ++i)
      {
        const double *start = &gliding.pose[record_size * i], *rate = &gliding.velocity[record_size * i];
        double       *pose = &particles.pose[record_size * i], *motion = &particles.motion[record_size * i];
        for (int c = 0; c < 3; ++c)
          pose[c] = start[c] + since * rate[c];
        for (int c = 0; c < 6; ++c)
          motion[c] = step * rate[c];
        set_arm_turn(pose, motion);
        if (i >= own.first && i < own.second)
          largest = std::max(largest, Eigen::Vector3d(motion).squaredNorm());
      }
    if (shares())
      shared->places_changed();
    return std::sqrt(largest_of_all(largest));
  }

  void SpecimenCore::glide(const double step, const double kick)
  {
    gather_wall_contacts();
    surfaces.collect_impulses(kick);
    gliding.pushes.add_impulses(surfaces, kick, gliding.glided, gliding.velocity);
    (gliding.glided > 0 ? gliding.work_after : gliding.work_now) += surfaces.add_work_of_last_motion();
    const double of_vertices = surfaces.advance(step);
    gliding.work_after += surfaces.add_work_of_last_motion();
    const double of_particles = place_gliding(gliding.glided + step);
    gliding.glided += step;
    refuse_too_fast(of_particles, of_vertices);
    surfaces.moved(of_particles, of_vertices);
  }

  /** What surfaces do not know yet of the particles' motion, now that they have taken their own step from where they began. */
  void SpecimenCore::keep_unseen()
  {
    unseen             = particles.motion;
    const auto own     = own_particles();
    double     largest = 0;
    for (std::size_t i = 0; i < particles.count; ++i)
      {
        const std::size_t at = record_size * i;
        for (std::size_t c = 0; c < 6; ++c)
          unseen[at + c] -= gliding.seen * gliding.velocity[at + c];
        const Eigen::Vector3d here(&particles.pose[at]), glided_to(&gliding.pose[at]);
        if (i >= own.first && i < own.second)
          largest = std::max(largest, (here - glided_to).squaredNorm());
      }
    surfaces.particles_moved(std::sqrt(largest_of_all(largest)));
  }

  void SpecimenCore::finish_glide()
  {
    if (gliding.seen ==
        gliding.glided) // surfaces are updated at the end already, and stand still until their next update
      {
        gliding.work_after += surfaces.add_work_of_last_motion();
        surfaces.rest();
      }
    std::swap(particles.pose, gliding.pose);
    std::swap(particles.motion, gliding.motion);
    time_step = gliding.glided;
    find_link_forces();
    const StepHalves halves = next_halves();
    move_particles(halves, gliding.pushes.mean(particles.count, halves.before + halves.after), !gliding.pushes.empty());
    if (shares())
      shared->share_velocities(particles, read_by_surfaces());
    keep_unseen();
    gliding.pushes.add_work(surfaces, unseen);
    const auto made =
      gliding.pushes.enter_difference(surfaces, {&gliding.velocity, &particles.velocity, halves.before, halves.after});
    book.work.now += gliding.work_now + made[0];
    book.work.after += gliding.work_after + made[1];
    gliding = {};
    end_step();
  }

  void SpecimenCore::visit_glide(base::StateVisitor &visitor)
  {
    visitor.column("glide/unseen_motion", unseen);
    visitor.scalar("glide/stored", before_glide.stored);
    visitor.scalar("glide/friction", before_glide.friction);
    visitor.scalar("glide/damage", before_glide.damage);
    visitor.scalar("glide/released", before_glide.released);
  }
} // namespace dem
