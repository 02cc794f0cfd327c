// What others may do to a specimen: lengths of steps, forces, impulses and prescribed motion from outside.

#include "base/errors.h"
#include "dem/specimen/implementation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dem
{
  namespace
  {
    std::array<bool, 6> held_axes(const double *inverse_mass)
    {
      std::array<bool, 6> held{};
      for (std::size_t c = 0; c < held.size(); ++c)
        held[c] = !(inverse_mass[c] > 0);
      return held;
    }
  } // namespace

  double Specimen::longest_step() const { return self->longest_step; }

  void Specimen::set_time_step(const double step)
  {
    constexpr double rounding = 1e-12;
    if (step > 0 && step <= (1 + rounding) * self->longest_step)
      {
        self->time_step = std::min(step, self->longest_step);
        return;
      }
    std::ostringstream message;
    message << "step of " << step << " s: must be above 0 and at most " << self->longest_step
            << " s, the stable one of the particles with the step factor.";
    throw base::InputError(message.str());
  }

  ParticleState Specimen::particle(const std::size_t number) const
  {
    const Particles &p = self->particles;
    const auto       i = static_cast<std::size_t>(self->slot.at(number));
    const double    *v = &p.velocity[record_size * i];
    return {p.position_of(i),   Eigen::Vector3d(&p.motion[record_size * i]),
            Eigen::Vector3d(v), Eigen::Vector3d(v + 3),
            p.radius_of(i),     self->mass_of(i),
            p.inertia[i],       held_axes(&p.inverse_mass[record_size * i])};
  }

  double Specimen::stiffness_around(const std::size_t number) const
  {
    return dem::stiffness_around(self->particles, self->all_links(), self->parameters.physics.rotations,
                                 self->slot.at(number), 0, self->overlap_ahead);
  }

  void Specimen::add_force(const std::size_t particle, const Eigen::Vector3d &force, const Eigen::Vector3d &couple)
  {
    if (self->parameters.physics.periodic)
      throw base::InputError("Forces: a periodic cell has nothing that could hold against them.");
    Particles &p = self->particles;
    if (p.pushed.empty())
      p.pushed.assign(record_size * p.count, 0.0);
    double *push = &p.pushed[record_size * static_cast<std::size_t>(self->slot.at(particle))];
    for (int c = 0; c < 3; ++c)
      {
        push[c] += force[c];
        push[3 + c] += couple[c];
      }
  }

  void Specimen::clear_forces() { self->particles.pushed.clear(); }

  void Specimen::apply_impulse(const std::size_t number, const Eigen::Vector3d &change, const Eigen::Vector3d &spin)
  {
    Particles   &p    = self->particles;
    const auto   slot = self->slot.at(number);
    const auto   at   = record_size * static_cast<std::size_t>(slot);
    VelocityKick kick{slot, {}};
    for (int c = 0; c < 6; ++c)
      if (p.inverse_mass[at + c] > 0) // what is prescribed stays so
        {
          double      &v    = p.velocity[at + c];
          const double mass = c < 3 ? p.mass[slot] : p.inertia[slot];
          kick.change[c]    = c < 3 ? change[c] : spin[c - 3];
          if (self->step_count > 0)
            self->work_before += mass * kick.change[c] * (v + 0.5 * kick.change[c]);
          v += kick.change[c];
        }
    if (self->step_count > 0)
      self->kicks.push_back(kick);
  }

  void Specimen::Implementation::set_rate(HeldGrip &held, const std::size_t member, const int c)
  {
    if (!held.grip.prescribed[c])
      return;
    const auto   i      = static_cast<std::size_t>(held.members[member]);
    double      &v      = particles.velocity[record_size * i + c];
    const double before = v, mass = c < 3 ? particles.mass[i] : particles.inertia[i];
    v = held.rate(member, c);
    // A sudden change is an impulse; before the first step it belongs to the initial energy.
    if (step_count == 0)
      return;
    work_before += 0.5 * mass * (v * v - before * before);
    held.lost_velocity[6 * member + c] += before - v;
  }

  void Specimen::set_grip_velocities(const std::size_t                   number,
                                     const std::vector<Eigen::Vector3d> &velocity,
                                     const std::vector<Eigen::Vector3d> &spin)
  {
    HeldGrip  &held  = self->grips.at(number);
    const auto count = held.members.size();
    if (velocity.size() != count || spin.size() != count)
      throw base::InputError("Grip of " + std::to_string(count) + " particles: velocities of " +
                             std::to_string(velocity.size()) + " and spins of " + std::to_string(spin.size()) +
                             " were given.");
    held.own_rates.resize(6 * count);
    for (std::size_t k = 0; k < count; ++k)
      {
        const std::size_t given = held.given[k];
        std::copy_n(velocity[given].data(), 3, &held.own_rates[6 * k]);
        std::copy_n(spin[given].data(), 3, &held.own_rates[6 * k + 3]);
        for (int c = 0; c < 6; ++c)
          self->set_rate(held, k, c);
      }
  }

  Eigen::Vector3d Specimen::reaction_moment(const std::size_t number, const Eigen::Vector3d &about) const
  {
    const HeldGrip  &held = self->grips.at(number);
    const Particles &p    = self->particles;
    Eigen::Vector3d  sum  = Eigen::Vector3d::Zero();
    for (const std::int32_t member : held.members)
      {
        const auto      at = record_size * static_cast<std::size_t>(member);
        Eigen::Vector3d force, couple;
        for (int c = 0; c < 3; ++c)
          {
            force[c]  = held.grip.prescribed[c] ? -p.force[at + c] : 0.0;
            couple[c] = held.grip.prescribed[3 + c] ? -p.force[at + 3 + c] : 0.0;
          }
        const Eigen::Vector3d there = Eigen::Vector3d(&p.pose[at]) - Eigen::Vector3d(&p.motion[at]); // at t_n
        sum += (there - about).cross(force) + couple;
      }
    return sum;
  }
} // namespace dem
