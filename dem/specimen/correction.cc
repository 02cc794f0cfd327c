// Corrections of a step from outside, before it is over (doc/theory/volume-coupling.md, 4).

#include "base/errors.h"
#include "dem/specimen/glide.h"
#include "dem/specimen/implementation.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    constexpr std::size_t axes = 6;

    /** Of one particle, one component. */
    struct CorrectedRate
    {
      double before = 0, moved = 0, now = 0; ///< before t_n; as the particle moved by itself; as it is to be

      double change() const { return now - moved; }
    };

    /** What the half step after t_n adds to the account of a block because the particle is faster in it. */
    void enter_in_account(const Particles                   &p,
                          const std::size_t                  i,
                          const std::size_t                  c,
                          const StepHalves                  &halves,
                          const CorrectedRate               &rate,
                          std::vector<ParticleBlockAccount> &accounts)
    {
      const std::size_t     at    = record_size * i + c;
      ParticleBlockAccount &block = accounts[i / particles_per_block];
      const double          mass = c < 3 ? p.mass[i] : p.inertia[i], ahead = halves.after * rate.change();
      const double          slowed =
        (rate.moved - rate.before) / (halves.before + halves.after) - p.force[at] * p.inverse_mass[at];
      block.kinetic += 0.5 * mass * rate.before * rate.change();
      block.damping_after += ahead * mass * slowed;
      if (!p.pushed.empty())
        block.pushing_after += ahead * p.pushed[at];
    }
  } // namespace

  base::Column Specimen::Implementation::velocities_of(const StepPartner &partner) const
  {
    base::Column rates;
    if (!partner.particles)
      return rates;
    rates.reserve(axes * partner.particles->size());
    for (const std::size_t number : *partner.particles)
      {
        const double *v = &particles.velocity[record_size * static_cast<std::size_t>(slot.at(number))];
        rates.insert(rates.end(), v, v + axes);
      }
    return rates;
  }

  bool Specimen::Implementation::set_held_rate(const std::size_t i,
                                               const std::size_t c,
                                               const double      before,
                                               const double      now)
  {
    if (led_by.empty())
      return false;
    const auto [grip, member] = led_by[i];
    if (grip < 0 || !grips[static_cast<std::size_t>(grip)].grip.prescribed[c])
      return false;
    HeldGrip &held                    = grips[static_cast<std::size_t>(grip)];
    held.own_rates[axes * member + c] = now;
    held.lost_velocity[axes * member + c] += before - now;
    const double added = 0.5 * (c < 3 ? particles.mass[i] : particles.inertia[i]) * (now * now - before * before);
    accounts[i / particles_per_block].kinetic += added;
    work_before += added;
    return true;
  }

  std::array<double, 2> Specimen::Implementation::let_correct(const StepHalves   &halves,
                                                              const StepPartner  &partner,
                                                              const base::Column &before)
  {
    StepCorrection correction{halves.before, halves.after, *partner.particles, {}, before, velocities_of(partner)};
    correction.force.reserve(before.size());
    for (const std::size_t number : correction.particles)
      {
        const double *f = &particles.force[record_size * static_cast<std::size_t>(slot[number])];
        correction.force.insert(correction.force.end(), f, f + axes);
      }
    (*partner.correct)(correction);

    std::array<double, 2> work{};
    for (std::size_t k = 0; k < correction.particles.size(); ++k)
      {
        const auto i = static_cast<std::size_t>(slot[correction.particles[k]]);
        double    *v = &particles.velocity[record_size * i], *motion = &particles.motion[record_size * i],
               *pose = &particles.pose[record_size * i];
        bool turned  = false;
        for (std::size_t c = 0; c < axes; ++c)
          {
            const CorrectedRate rate{before[axes * k + c], v[c], correction.velocity[axes * k + c]};
            if (rate.change() == 0)
              continue;
            if (particles.inverse_mass[record_size * i + c] > 0)
              {
                const double impulse =
                  (c < 3 ? particles.mass[i] : particles.inertia[i]) * rate.change() / (halves.before + halves.after);
                enter_in_account(particles, i, c, halves, rate, accounts);
                work[0] += halves.before * impulse * rate.before;
                work[1] += halves.after * impulse * rate.now;
              }
            else if (!set_held_rate(i, c, rate.before, rate.now))
              continue;
            turned               = turned || c >= 3;
            const double further = 2 * halves.after * rate.change();
            v[c]                 = rate.now;
            motion[c] += further;
            if (c < 3)
              pose[c] += further;
          }
        if (turned)
          set_arm_turn(pose, motion);
        double &fastest = accounts[i / particles_per_block].fastest;
        fastest         = std::max(fastest, Eigen::Vector3d(motion).squaredNorm());
      }
    return work;
  }

  void Specimen::advance(const std::vector<std::size_t>              &particles,
                         const std::function<void(StepCorrection &)> &correct)
  {
    if (self->parameters.physics.periodic)
      throw base::InputError("Corrections: a periodic cell has no place for somebody else's body.");
    if (self->step_count == 0)
      self->begin();
    self->step({&particles, &correct});
  }
} // namespace dem
