// Corrections of a step from outside, before it is over (doc/theory/volume-coupling.md, 4).

#include "base/errors.h"
#include "dem/specimen/core.h"
#include "dem/specimen/glide.h"
#include "dem/specimen/partners.h"

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
                          const bool                         damped,
                          std::vector<ParticleBlockAccount> &accounts)
    {
      const std::size_t     at    = record_size * i + c;
      ParticleBlockAccount &block = accounts[i / particles_per_block];
      const double          mass = c < 3 ? p.mass[i] : p.inertia[i], ahead = halves.after * rate.change();
      block.kinetic += 0.5 * mass * rate.before * rate.change();
      if (damped)
        {
          const double slowed =
            (rate.moved - rate.before) / (halves.before + halves.after) - p.force[at] * p.inverse_mass[at];
          block.damping_after += ahead * mass * slowed;
        }
      if (!p.pushed.empty())
        block.pushing_after += ahead * p.pushed[at];
    }
  } // namespace

  void SpecimenCore::enter_velocities(const StepPartner &partner, base::Column &rates) const
  {
    const std::vector<std::size_t> &watched = *partner.particles;
    rates.resize(axes * watched.size());
    for (std::size_t k = 0; k < watched.size(); ++k)
      std::copy_n(&particles.velocity[record_size * static_cast<std::size_t>(slot.at(watched[k]))], axes,
                  &rates[axes * k]);
  }

  std::array<double, 2> SpecimenCore::let_correct(const StepHalves &halves, const StepPartner &partner)
  {
    enter_velocities(partner, corrected);
    const std::vector<std::size_t> &watched = *partner.particles;
    const auto                      force   = [&](const std::size_t k) {
      return &particles.force[record_size * static_cast<std::size_t>(slot[watched[k]])];
    };
    StepCorrection correction{halves.before, halves.after, watched, force, before_step, corrected};
    (*partner.correct)(correction);

    std::array<double, 2> work{};
    for (std::size_t k = 0; k < watched.size(); ++k)
      {
        const auto    i   = static_cast<std::size_t>(slot[watched[k]]);
        const double *now = &corrected[axes * k], *moved = &particles.velocity[record_size * i];
        if (!std::equal(now, now + axes, moved))
          take_corrected(i, halves, &before_step[axes * k], now, work);
      }
    return work;
  }

  void SpecimenCore::turn_grips(const StepHalves &halves)
  {
    if (shared)
      shared->share_states(particles, held.turning_members());
    std::array<double, 2> none{}; // work of what moves freely; grips enter theirs themselves
    for (const auto &[i, now] : held.push_faces(particles, halves.before + halves.after))
      {
        std::array<double, axes> before{};
        std::copy_n(&particles.velocity[record_size * i], axes, before.begin());
        take_corrected(i, halves, before.data(), now.data(), none);
      }
  }

  void SpecimenCore::take_corrected(
    const std::size_t i, const StepHalves &halves, const double *before, const double *now, std::array<double, 2> &work)
  {
    double *v = &particles.velocity[record_size * i], *motion = &particles.motion[record_size * i],
           *pose = &particles.pose[record_size * i];
    bool turned  = false;
    for (std::size_t c = 0; c < axes; ++c)
      {
        const CorrectedRate rate{before[c], v[c], now[c]};
        if (rate.change() == 0)
          continue;
        if (particles.inverse_mass[record_size * i + c] > 0)
          {
            const double impulse =
              (c < 3 ? particles.mass[i] : particles.inertia[i]) * rate.change() / (halves.before + halves.after);
            enter_in_account(particles, i, c, halves, rate, parameters.damping > 0, accounts);
            work[0] += halves.before * impulse * rate.before;
            work[1] += halves.after * impulse * rate.now;
          }
        else if (const auto added = held.correct_rate(particles, i, c, rate.before, rate.now))
          {
            accounts[i / particles_per_block].kinetic += *added;
            book.work.before += *added;
          }
        else
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
} // namespace dem
