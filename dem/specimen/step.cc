#include "base/errors.h"
#include "dem/measures/link_measures.h"
#include "dem/specimen/implementation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace dem
{
  namespace
  {
    /** How often the state is looked at for NaN. */
    constexpr std::int64_t steps_between_checks = 100;
    /** For how many of them the stable step of contacts that stiffen is found in advance. */
    constexpr double steps_ahead = 50;
    /** Deleted links stay as idle lines until they are this part of all. */
    constexpr double idle_lines_allowed = 0.05;
  } // namespace

  void Specimen::Implementation::step(const StepPartner &partner)
  {
    find_link_forces();
    if (!surfaces.empty())
      find_surface_forces();
    const StepHalves halves = next_halves();
    move_particles(halves, surfaces.on_particles(), surfaces.touching(), partner);
    if (!surfaces.empty())
      advance_surfaces(halves);
    unseen.clear();
    end_step();
  }

  void Specimen::Implementation::find_link_forces()
  {
    contacts.per_second = contact_law->viscous() && last_step > 0 ? 1 / last_step : 0.0;
    bond_pass(bonds, particles, *bond_law, bonds.whole());
    if (contacts.alive > 0)
      contact_pass(contacts, particles, *contact_law, contacts.whole());
    if (parameters.physics.periodic)
      sum_stress();
    settle_events(bonds, *bond_law);
    settle_events(contacts, *contact_law);
  }

  void Specimen::Implementation::move_particles(const StepHalves   &halves,
                                                const base::Column &of_surfaces,
                                                const bool          touched,
                                                const StepPartner  &partner)
  {
    if (touched && particles.pushed.empty())
      particles.pushed.assign(record_size * particles.count, 0.0);
    if (partner.particles)
      enter_velocities(partner, before_step);
    select_particle_pass(contacts.alive > 0, parameters.damping > 0, equal_radii, moments(), surroundings(touched))(
      particles, bonds, &contacts, of_surfaces, halves, parameters.damping, parameters.gravity, accounts);
    if (!clumps.empty())
      clumps.move(particles, halves, parameters.damping, parameters.gravity, accounts);
    if (!partner.particles)
      return account(halves);
    const auto work = let_correct(halves, partner);
    account(halves);
    work_now += work[0];
    work_after += work[1];
  }

  void Specimen::Implementation::end_step()
  {
    if (parameters.physics.periodic)
      particles.cell.advance(time_step);
    ++step_count;
    time += time_step;
    last_step = time_step;
    if (parameters.physics.contacts)
      {
        watch_overlaps();
        if (contact_law->stiffens())
          watch_stiffening();
        make_contacts();
      }
    if (step_count % steps_between_checks != 0)
      return;
    check_numbers();
    watch_turns();
  }

  void Specimen::Implementation::sum_stress()
  {
    stress_moment.setZero();
    for (const LinkSet *links : {&bonds, &contacts})
      if (links->alive > 0)
        for (std::size_t b = 0; b < links->blocks(); ++b)
          stress_moment +=
            Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&links->stress_moments[stress_record * b]);
  }

  void Specimen::Implementation::sum_pulls()
  {
    for (auto &grip : grips)
      {
        grip.pull = {};
        for (const std::int32_t i : grip.members)
          for (int c = 0; c < 6; ++c)
            grip.pull[c] += particles.force[record_size * static_cast<std::size_t>(i) + c];
        if (grip.own_rates.empty())
          continue;
        grip.own_power = 0;
        for (std::size_t k = 0; k < grip.members.size(); ++k)
          for (int c = 0; c < 6; ++c)
            if (grip.grip.prescribed[c])
              grip.own_power -=
                particles.force[record_size * static_cast<std::size_t>(grip.members[k]) + c] * grip.rate(k, c);
      }
  }

  double Specimen::Implementation::force_less_push(const std::int32_t i, const int c) const
  {
    const std::size_t at = record_size * static_cast<std::size_t>(i) + static_cast<std::size_t>(c);
    return particles.pushed.empty() ? particles.force[at] : particles.force[at] - particles.pushed[at];
  }

  double Specimen::Implementation::work_of_kicks(const double half) const
  {
    double work = 0;
    for (const VelocityKick &kick : kicks)
      for (int c = 0; c < 6; ++c)
        work += force_less_push(kick.particle, c) * kick.change[c];
    return half * work;
  }

  void Specimen::Implementation::account(const StepHalves &halves)
  {
    damped_before += damped_now + damped_after;
    work_before += work_now + work_after;
    damped_now = damped_after = work_now = work_after = 0;
    for (const auto &block : accounts)
      {
        damped_now -= block.damping_before;
        damped_after -= block.damping_after;
        work_now += block.pushing_before;
        work_after += block.pushing_after;
      }
    work_now += work_of_kicks(halves.before);
    kicks.clear();
    sum_pulls();
    for (auto &grip : grips)
      {
        double lost_power = 0; // in the half step before t_n members had the velocities of before the last change
        for (std::size_t k = 0; k < grip.members.size(); ++k)
          for (int c = 0; c < 6; ++c)
            lost_power -= force_less_push(grip.members[k], c) * grip.lost_velocity[6 * k + c];
        std::fill(grip.lost_velocity.begin(), grip.lost_velocity.end(), 0.0);
        work_now += halves.before * (grip.power() + lost_power);
        work_after += halves.after * grip.power();
      }
    if (parameters.physics.periodic)
      {
        const auto work = [&](const Eigen::Matrix3d &increment) {
          return 0.5 * stress_moment.transpose().cwiseProduct(increment).sum(); // V sigma^T : G dt/2
        };
        work_now += work(particles.cell.last_increment());
        work_after += work(time_step * particles.cell.gradient());
      }
  }

  void Specimen::Implementation::settle_events(LinkSet &links, const LinkLaw &law)
  {
    if (links.alive == 0)
      return;
    LinkReader reader(particles, links, law);
    for (std::size_t b = 0; b < links.blocks(); ++b)
      if (links.accounts[b].event)
        {
          links.accounts[b].event = false;
          const std::size_t end   = std::min((b + 1) * links_per_block, links.count);
          for (std::size_t l = b * links_per_block; l < end; ++l)
            {
              if (!links.is_alive(l))
                continue;
              reader.read(l, Geometry::present);
              const LinkPhase phase = reader.phase();
              const bool      noted = links.logs_breaks && links.noted[l] != 0;
              if (law.bonds() && !noted)
                log_breaks(reader, l);
              if (phase == LinkPhase::whole)
                continue;
              if (law.bonds() && !noted)
                note_crack(reader, l);
              if (phase == LinkPhase::gone)
                delete_link(links, reader, l);
              else if (links.logs_breaks)
                links.noted[l] = 1;
            }
        }
    if (law.bonds() && static_cast<double>(links.deleted()) > idle_lines_allowed * static_cast<double>(links.count))
      links.compact(particles.count);
  }

  void Specimen::Implementation::log_breaks(const LinkReader &link, const std::size_t l)
  {
    const std::int32_t J = bonds.first[l], K = bonds.second[l];
    const LinkView    &seen  = link.view();
    const double       arm   = 0.5 * (seen.length + particles.radius_of(J) - particles.radius_of(K));
    const auto         image = bonds.periodic ? bonds.image[l] : 0;
    for (const BrokenElement &broken : link.broken_elements())
      {
        Break event;
        event.time    = time;
        event.step    = step_count;
        event.ends    = {J, K};
        event.image   = image;
        event.pair    = static_cast<std::int32_t>(bonds.pair_of(l));
        event.element = broken.element;
        event.mode    = broken.mode;
        event.place   = particles.position_of(J) + arm * seen.direction + broken.offset;
        event.normal  = seen.direction;
        event.area    = bonds.area[l] * broken.share;
        if (!breaks.knows(event))
          breaks.add(event);
      }
  }

  void Specimen::Implementation::note_crack(const LinkReader &link, const std::size_t l)
  {
    const std::int32_t    J = bonds.first[l], K = bonds.second[l];
    const Eigen::Vector3d branch     = branch_of(particles, bonds, l);
    const double          dissipated = link.damage_dissipation(), length = branch.norm();
    const double          arm     = 0.5 * (length + particles.radius_of(J) - particles.radius_of(K));
    const Eigen::Vector3d contact = particles.position_of(J) + arm / length * branch;
    broken_damage += dissipated;
    crack_geometry.insert(crack_geometry.end(), branch.data(), branch.data() + 3);
    crack_geometry.insert(crack_geometry.end(), contact.data(), contact.data() + 3);
    crack_geometry.insert(crack_geometry.end(), {dissipated, 0.0});
    ++particles.broken_links[J];
    ++particles.broken_links[K];
    crack_log.push_back(J);
    crack_log.push_back(K);
  }

  void Specimen::Implementation::delete_link(LinkSet &links, const LinkReader &link, const std::size_t l)
  {
    const std::int32_t    J = links.first[l], K = links.second[l];
    const Eigen::Vector3d branch = branch_of(particles, links, l);
    if (links.periodic)
      stress_moment -= branch * Eigen::RowVector3d(&links.force[record_size * l]);
    // Below zero where one step closed and opened it: energy that the step made, not the link. The balance shows it.
    released += std::max(link.stored() - work_not_taken_up(particles, links, link.view(), l), 0.0);
    links.remove(l);
    if (parameters.physics.contacts)
      search.watch(particles, {J, K, links.periodic ? links.image[l] : 0});
  }

  double Specimen::Implementation::largest_displacement() const
  {
    double fastest = 0;
    for (const auto &block : accounts)
      fastest = std::max(fastest, block.fastest);
    return std::sqrt(fastest);
  }

  double Specimen::Implementation::stable() const
  {
    double smallest =
      dem::stable_step(particles, all_links(), parameters.physics.rotations,
                       surfaces.stiffness_seen(particles, shape, parameters.physics.rotations), overlap_ahead);
    for (std::size_t clump = 0; clump < clumps.size(); ++clump)
      smallest = std::min(smallest, stable_of_clump(clump));
    return smallest;
  }

  double Specimen::Implementation::stable_of_clump(const std::size_t clump) const
  {
    return clumps.stable_step(particles, clump, [this](const std::int32_t pebble) {
      const bool rotations = parameters.physics.rotations;
      return dem::stiffness_around(particles, all_links(), rotations, pebble,
                                   surfaces.stiffness_seen(particles, shape, rotations, pebble), overlap_ahead);
    });
  }

  double Specimen::Implementation::stable(const std::int32_t particle) const
  {
    if (const std::int32_t clump = particles.clump_of(static_cast<std::size_t>(particle)); clump >= 0)
      return stable_of_clump(static_cast<std::size_t>(clump));
    const bool rotations = parameters.physics.rotations;
    return stable_step_of(particles, all_links(), rotations, particle,
                          surfaces.stiffness_seen(particles, shape, rotations, particle), overlap_ahead);
  }

  void Specimen::Implementation::watch_overlaps()
  {
    const double largest = largest_displacement();
    refuse_too_fast(largest, 0);
    path_unlooked += largest;
    const double limit = parameters.physics.largest_overlap;
    if (path_unlooked < limit / 5 * smallest_radius) // two of them come two fifths of the limit nearer meanwhile
      return;
    path_unlooked                = 0;
    const DeepestOverlap overlap = deepest();
    deepest_seen                 = std::max(deepest_seen, overlap.depth);
    if (overlap.depth < limit)
      return;
    std::ostringstream message;
    message << "step " << step_count << ", time " << time << " s: particles " << particles.number[overlap.first] + 1
            << " and " << particles.number[overlap.second] + 1 << " are pressed into each other by " << overlap.depth
            << " radii of the smaller one";
    if (overlap.depth < DeepestOverlap::gone_through)
      message << ", above Physics/Largest overlap = " << limit;
    else
      message << " and would pass through";
    message << ": their contact is too soft for what it has to stop. Make it stiffer or what meets slower.";
    throw base::NumericalError(message.str());
  }

  void Specimen::Implementation::watch_stiffening()
  {
    const double largest = largest_displacement();
    path_since_step += largest;
    if (2 * (path_since_step + largest) <= overlap_ahead) // two of them come nearer by twice the path
      return;
    overlap_ahead   = std::max(overlap_ahead_of_all(), 2 * steps_ahead * largest);
    path_since_step = 0;
    longest_step    = std::min(longest_step, parameters.step_factor * stable());
    time_step       = std::min(time_step, longest_step);
  }

  void Specimen::Implementation::make_contacts()
  {
    if (!search.moved(largest_displacement(), (time_step * particles.cell.gradient()).norm()))
      return;
    const auto searches = search.searches();
    const auto born     = search.look(particles, bonds, contacts);
    if (contact_law->waits() && search.searches() != searches)
      drop_distant_contacts();
    if (born.empty())
      return;
    add_contacts(contacts, born, particles, shape, *contact_law);
    // Links only soften, but contacts stiffen the particles they join: keep the factor on the present bound.
    for (const auto &pair : born)
      for (const std::int32_t i : {pair.first, pair.second})
        longest_step = std::min(longest_step, parameters.step_factor * stable(i));
    time_step = std::min(time_step, longest_step);
  }

  void Specimen::Implementation::drop_distant_contacts()
  {
    for (std::size_t l = 0; l < contacts.count; ++l)
      if (contacts.is_alive(l) && !search.is_near(particles, {contacts.first[l], contacts.second[l],
                                                              contacts.periodic ? contacts.image[l] : 0}))
        contacts.remove(l);
  }

  namespace
  {
    /** Whether all are finite, several at a time: what is not, is not zero times zero either. */
    bool all_finite(const base::Column &records)
    {
      std::array<double, 4 * record_size> sums{};
      std::size_t                         at = 0;
      for (; at + sums.size() <= records.size(); at += sums.size())
        for (std::size_t c = 0; c < sums.size(); ++c)
          sums[c] += 0 * records[at + c];
      double sum = 0;
      for (; at < records.size(); ++at)
        sum += 0 * records[at];
      for (const double each : sums)
        sum += each;
      return std::isfinite(sum);
    }
  } // namespace

  void Specimen::Implementation::watch_turns()
  {
    double fastest = 0; // squared
    for (std::size_t i = 0; i < particles.count; ++i)
      fastest = std::max(fastest, Eigen::Vector3d(&particles.velocity[record_size * i + 3]).squaredNorm());
    largest_turn = std::max(largest_turn, time_step * std::sqrt(fastest));
  }

  void Specimen::Implementation::check_numbers() const
  {
    if (all_finite(particles.velocity))
      return;
    for (std::size_t i = 0; i < particles.count; ++i)
      for (int c = 0; c < 6; ++c)
        if (!std::isfinite(particles.velocity[record_size * i + c]))
          {
            std::ostringstream message;
            message << "step " << step_count << ", time " << time << " s: particle " << particles.number[i] + 1
                    << " no longer has a finite velocity. Lower Time/Step factor (" << parameters.step_factor
                    << ") or the loading rate, and check the material.";
            throw base::NumericalError(message.str());
          }
  }
} // namespace dem
