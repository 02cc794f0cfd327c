#include "dem/specimen/held_particles.h"

#include "base/errors.h"
#include "dem/specimen/velocity_kicks.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

namespace dem
{
  double HeldParticles::HeldGrip::rate(const std::size_t member, const int c) const
  {
    if (!own_rates.empty())
      return own_rates[6 * member + static_cast<std::size_t>(c)];
    return c < 3 ? grip.velocity[c] : grip.spin[c - 3];
  }

  std::array<double, 6> HeldParticles::HeldGrip::turning_rates(const std::size_t member) const
  {
    std::array<double, 6> all = face->rates(member);
    for (int c = 0; c < 3; ++c)
      {
        all[c] += grip.velocity[c];
        all[3 + c] += grip.spin[c];
      }
    return all;
  }

  double HeldParticles::HeldGrip::power() const
  {
    if (!own_rates.empty())
      return own_power;
    double sum = 0;
    for (int c = 0; c < 6; ++c)
      if (grip.prescribed[c])
        sum -= pull[c] * (c < 3 ? grip.velocity[c] : grip.spin[c - 3]);
    return sum;
  }

  void HeldParticles::HeldGrip::lose(const std::size_t member, const std::size_t c, const double velocity)
  {
    lost_velocity[6 * member + c] += velocity;
    may_have_lost = true;
  }

  double HeldParticles::HeldGrip::take_lost_power(const Particles &particles)
  {
    double sum = 0;
    for (std::size_t k = 0; k < members.size(); ++k)
      for (int c = 0; c < 6; ++c)
        sum -= force_without_push(particles, members[k], c) * lost_velocity[6 * k + c];
    std::fill(lost_velocity.begin(), lost_velocity.end(), 0.0);
    return sum;
  }

  namespace
  {
    std::vector<std::int32_t> united(const std::vector<std::int32_t> &first, const std::vector<std::int32_t> &second)
    {
      std::vector<std::int32_t> all;
      std::set_union(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(all));
      return all;
    }
  } // namespace

  std::size_t
  HeldParticles::add(const Grip &grip, const std::vector<std::int32_t> &slot, Particles &particles, const int dimension)
  {
    HeldGrip held;
    held.grip = grip;
    std::vector<std::pair<std::int32_t, std::size_t>> order;
    for (std::size_t k = 0; k < grip.particles.size(); ++k)
      order.emplace_back(slot.at(grip.particles[k]), k);
    std::sort(order.begin(), order.end());
    for (const auto &[member, given] : order)
      {
        held.members.push_back(member);
        held.given.push_back(given);
      }
    held.lost_velocity.assign(6 * held.members.size(), 0.0);
    for (const std::int32_t i : held.members)
      for (int c = 0; c < 6; ++c)
        if (grip.prescribed[c])
          particles.inverse_mass[record_size * static_cast<std::size_t>(i) + c] = 0.0;
    if (grip.turning_face)
      {
        held.face.emplace(grip, held.members, particles, dimension);
        all_turning = united(all_turning, held.members);
      }
    all_members = united(all_members, held.members);
    grips.push_back(std::move(held));
    if (grip.turning_face)
      leave_to_partner(grips.size() - 1, particles.count); // its own turn corrects it, as a partner does
    return grips.size() - 1;
  }

  void HeldParticles::leave_to_partner(const std::size_t grip, const std::size_t particles)
  {
    left.resize(particles, {-1, 0});
    for (std::size_t k = 0; k < grips.at(grip).members.size(); ++k)
      left[static_cast<std::size_t>(grips[grip].members[k])] = {static_cast<std::int32_t>(grip), k};
  }

  void
  HeldParticles::set_rate(HeldGrip &held, const std::size_t member, const int c, Particles &particles, EnergyFlow *work)
  {
    if (!held.grip.prescribed[c])
      return;
    const auto   i      = static_cast<std::size_t>(held.members[member]);
    double      &v      = particles.velocity[record_size * i + c];
    const double before = v, mass = c < 3 ? particles.mass[i] : particles.inertia[i];
    v = held.rate(member, c);
    if (!work)
      return;
    work->before += 0.5 * mass * (v * v - before * before);
    if (v != before)
      held.lose(member, static_cast<std::size_t>(c), before - v);
  }

  void HeldParticles::set_rates(const std::size_t      number,
                                const Eigen::Vector3d &velocity,
                                const Eigen::Vector3d &spin,
                                Particles             &particles,
                                EnergyFlow            *work)
  {
    HeldGrip &held     = grips.at(number);
    held.grip.velocity = velocity;
    held.grip.spin     = spin;
    held.own_rates.clear();
    if (held.face)
      {
        base::Column all;
        for (std::size_t k = 0; k < held.members.size(); ++k)
          for (const double rate : held.turning_rates(k))
            all.push_back(rate);
        held.own_rates = std::move(all);
      }
    for (std::size_t k = 0; k < held.members.size(); ++k)
      for (int c = 0; c < 6; ++c)
        set_rate(held, k, c, particles, work);
  }

  void HeldParticles::set_own_rates(const std::size_t                   number,
                                    const std::vector<Eigen::Vector3d> &velocity,
                                    const std::vector<Eigen::Vector3d> &spin,
                                    Particles                          &particles,
                                    EnergyFlow                         *work)
  {
    HeldGrip  &held  = grips.at(number);
    const auto count = held.members.size();
    if (held.face)
      throw base::InputError("Grip whose face turns: its particles have no rates of their own.");
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
          set_rate(held, k, c, particles, work);
      }
  }

  std::optional<double> HeldParticles::correct_rate(
    const Particles &particles, const std::size_t i, const std::size_t c, const double before, const double now)
  {
    if (left.empty())
      return std::nullopt;
    const auto [grip, member] = left[i];
    if (grip < 0 || !grips[static_cast<std::size_t>(grip)].grip.prescribed[c])
      return std::nullopt;
    HeldGrip &held                 = grips[static_cast<std::size_t>(grip)];
    held.own_rates[6 * member + c] = now;
    held.lose(member, c, before - now);
    return 0.5 * (c < 3 ? particles.mass[i] : particles.inertia[i]) * (now * now - before * before);
  }

  std::vector<std::pair<std::size_t, std::array<double, 6>>> HeldParticles::push_faces(const Particles &particles,
                                                                                       const double     time)
  {
    std::vector<std::pair<std::size_t, std::array<double, 6>>> rates;
    for (HeldGrip &held : grips)
      {
        if (!held.face)
          continue;
        held.face->push(held.members, particles, time);
        for (std::size_t k = 0; k < held.members.size(); ++k)
          {
            const auto            i   = static_cast<std::size_t>(held.members[k]);
            std::array<double, 6> now = held.turning_rates(k);
            for (int c = 0; c < 6; ++c)
              if (!held.grip.prescribed[c])
                now[c] = particles.velocity[record_size * i + c];
            rates.emplace_back(i, now);
          }
      }
    return rates;
  }

  void HeldParticles::sum_forces(const Particles &particles)
  {
    for (auto &held : grips)
      {
        held.pull = {};
        for (const std::int32_t i : held.members)
          for (int c = 0; c < 6; ++c)
            held.pull[c] += particles.force[record_size * static_cast<std::size_t>(i) + c];
        if (held.own_rates.empty())
          continue;
        held.own_power = 0;
        for (std::size_t k = 0; k < held.members.size(); ++k)
          for (int c = 0; c < 6; ++c)
            if (held.grip.prescribed[c])
              held.own_power -=
                particles.force[record_size * static_cast<std::size_t>(held.members[k]) + c] * held.rate(k, c);
      }
  }

  void HeldParticles::add_work(const Particles &particles, const StepHalves &halves, EnergyFlow &work)
  {
    for (auto &held : grips)
      {
        // Mostly none has: then the forces, which lie all over the memory, need not be fetched.
        const double lost = std::exchange(held.may_have_lost, false) ? held.take_lost_power(particles) : 0.0;
        work.now += halves.before * (held.power() + lost);
        work.after += halves.after * held.power();
      }
  }

  Eigen::Vector3d HeldParticles::reaction(const std::size_t grip) const
  {
    const auto &pull = grips.at(grip).pull;
    return {-pull[0], -pull[1], -pull[2]};
  }

  Eigen::Vector3d HeldParticles::reaction_moment(const std::size_t grip) const
  {
    const auto &pull = grips.at(grip).pull;
    return {-pull[3], -pull[4], -pull[5]};
  }

  Eigen::Vector3d HeldParticles::reaction_moment(const Particles       &particles,
                                                 const std::size_t      number,
                                                 const Eigen::Vector3d &about) const
  {
    const HeldGrip &held = grips.at(number);
    Eigen::Vector3d sum  = Eigen::Vector3d::Zero();
    for (const std::int32_t member : held.members)
      {
        const auto      at = record_size * static_cast<std::size_t>(member);
        Eigen::Vector3d force, couple;
        for (int c = 0; c < 3; ++c)
          {
            force[c]  = held.grip.prescribed[c] ? -particles.force[at + c] : 0.0;
            couple[c] = held.grip.prescribed[3 + c] ? -particles.force[at + 3 + c] : 0.0;
          }
        const Eigen::Vector3d there =
          Eigen::Vector3d(&particles.pose[at]) - Eigen::Vector3d(&particles.motion[at]); // at t_n
        sum += (there - about).cross(force) + couple;
      }
    return sum;
  }

  void HeldParticles::visit_state(base::StateVisitor &visitor)
  {
    for (std::size_t g = 0; g < grips.size(); ++g)
      {
        HeldGrip         &held = grips[g];
        const std::string name = "grips/" + std::to_string(g);
        for (int c = 0; c < 6; ++c)
          visitor.scalar(name + "/pull_" + std::to_string(c), held.pull[c]);
        for (int c = 0; c < 3; ++c)
          {
            visitor.scalar(name + "/velocity_" + std::to_string(c), held.grip.velocity[c]);
            visitor.scalar(name + "/spin_" + std::to_string(c), held.grip.spin[c]);
          }
        visitor.column(name + "/lost_velocity", held.lost_velocity);
        held.may_have_lost = true;
        visitor.column(name + "/own_rates", held.own_rates);
        for (int c = 0; held.face && c < 2; ++c)
          visitor.scalar(name + "/slope_rate_" + std::to_string(c), held.face->slope_rate[c]);
      }
  }
} // namespace dem
