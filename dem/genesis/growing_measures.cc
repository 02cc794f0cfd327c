// Measures of a growing assembly, and its energy account.

#include "dem/genesis/block_sums.h"
#include "dem/genesis/growing_assembly.h"
#include "dem/specimen/shared_work.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dem
{
  using Eigen::Vector3d;

  void ContactSums::add(const double stiffness, const double overlap, const double arms, const double smaller_radius)
  {
    stored += 0.5 * stiffness * overlap * overlap;
    virial += stiffness * overlap * arms;
    stiffening += stiffness * arms * arms;
    largest_overlap = std::max(largest_overlap, overlap / smaller_radius);
    ++touching;
  }

  void ContactSums::join(const ContactSums &other)
  {
    stored += other.stored;
    virial += other.virial;
    stiffening += other.stiffening;
    largest_overlap = std::max(largest_overlap, other.largest_overlap);
    touching += other.touching;
  }

  void MotionSums::join(const MotionSums &other)
  {
    unbalanced += other.unbalanced;
    pushing += other.pushing;
    kinetic += other.kinetic;
    damped += other.damped;
  }

  ContactSums GrowingAssembly::sum_links(const std::size_t begin, const std::size_t end) const
  {
    ContactSums sums;
    for (std::size_t l = begin; l < end; ++l)
      {
        const double length = branch_of(particles, contacts, l).norm(), arms = contacts.reference_length[l],
                     overlap = arms - length;
        if (!contacts.is_alive(l) || !(overlap > 0))
          continue;
        const double stiffness = contacts.area[l] * constants.normal / arms;
        sums.add(stiffness, overlap, arms,
                 std::min(particles.radius_of(static_cast<std::size_t>(contacts.first[l])),
                          particles.radius_of(static_cast<std::size_t>(contacts.second[l]))));
        for (const base::Column &shear : contacts.history)
          sums.stored += 0.5 * contacts.area[l] * arms * constants.shear * shear[l] * shear[l];
      }
    return sums;
  }

  void GrowingAssembly::add_walls(ContactSums &all, const std::size_t begin, const std::size_t end) const
  {
    for (auto at = std::lower_bound(near_wall.begin(), near_wall.end(), static_cast<std::int32_t>(begin));
         at != near_wall.end() && static_cast<std::size_t>(*at) < end; ++at)
      {
        const auto   i = static_cast<std::size_t>(*at);
        const double r = particles.radius_of(i);
        for (const WallTouch &wall : vessel.near(particles.position_of(i), r, 0.0))
          all.add(wall_stiffness(r), -wall.gap, r, r);
      }
  }

  ContactSums GrowingAssembly::sum_contacts()
  {
    const bool apart = lacks_contacts();
    if (!apart)
      gather_places();
    const auto [begin, end] = known_contacts();
    const auto of_blocks    = sums_of_blocks<ContactSums>(
      begin, end, links_per_block, [&](const std::size_t from, const std::size_t to) { return sum_links(from, to); });
    const auto join_links = [&](ContactSums &to) {
      for (const ContactSums &each : of_blocks)
        to.join(each);
    };
    ContactSums all;
    if (!apart)
      {
        join_links(all);
        add_walls(all, 0, particles.count);
        return all;
      }
    hand_on(
      all,
      [&](double *numbers, const std::size_t count, const auto &go_on) {
        shared->relay_contacts(
          contacts, [&](std::size_t, std::size_t) { go_on(); }, numbers, count);
      },
      join_links);
    hand_on(
      all,
      [&](double *numbers, const std::size_t count, const auto &go_on) {
        shared->relay_particles([&](std::size_t, std::size_t) { go_on(); }, numbers, count);
      },
      [&](ContactSums &to) {
        add_walls(to, static_cast<std::size_t>(shared->first()), static_cast<std::size_t>(shared->last()));
      });
    return all;
  }

  double GrowingAssembly::net_force(const std::size_t i, double *force) const
  {
    std::fill_n(force, 6, 0.0);
    double     pushing = 0;
    const auto add     = [&](const std::int32_t link, const double sign) {
      const double *f = &contacts.force[record_size * static_cast<std::size_t>(link)];
      for (int c = 0; c < 3; ++c)
        {
          force[c] += sign * f[c];
          force[3 + c] += (1 + sign * f[6]) * f[3 + c]; // arms of the two ends
        }
      pushing += std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    };
    for (std::int32_t l = contacts.own_begin[i]; l < contacts.own_begin[i + 1]; ++l)
      add(l, 1);
    for (std::int32_t o = contacts.other_begin[i]; o < contacts.other_begin[i + 1]; ++o)
      add(contacts.others[static_cast<std::size_t>(o)], -1);
    const Vector3d wall(&particles.pushed[record_size * i]);
    for (int c = 0; c < 3; ++c)
      force[c] += wall[c];
    return pushing + wall.lpNorm<1>(); // walls at right angles each push on their own
  }

  MotionSums GrowingAssembly::sum_particles(const std::size_t begin, const std::size_t end) const
  {
    MotionSums sums;
    double     force[6];
    for (std::size_t i = begin; i < end; ++i)
      {
        const double  pushing = net_force(i, force);
        const double *v = &particles.velocity[record_size * i], *inverse = &particles.inverse_mass[record_size * i];
        if (inverse[0] > 0)
          {
            sums.unbalanced += std::sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
            sums.pushing += pushing;
          }
        for (int c = 0; c < 6; ++c)
          if (inverse[c] > 0)
            {
              const double free = force[c] * inverse[c], ahead = free * (v[c] + 0.5 * free),
                           sign   = ahead > 0 ? 1.0 :
                                    ahead < 0 ? -1.0 :
                                                0.0,
                           slowed = -material.damping * sign * free;
              sums.kinetic += 0.5 / inverse[c] * v[c] * (v[c] + free + slowed);
              sums.damped -= 0.5 / inverse[c] * slowed * v[c];
            }
      }
    return sums;
  }

  MotionSums GrowingAssembly::sum_motion()
  {
    const auto [begin, end] = known_particles();
    const auto of_blocks =
      sums_of_blocks<MotionSums>(begin, end, particles_per_block,
                                 [&](const std::size_t from, const std::size_t to) { return sum_particles(from, to); });
    const auto join = [&](MotionSums &to) {
      for (const MotionSums &each : of_blocks)
        to.join(each);
    };
    MotionSums all;
    if (lacks_motion())
      hand_on(
        all,
        [&](double *numbers, const std::size_t count, const auto &go_on) {
          shared->relay_particles([&](std::size_t, std::size_t) { go_on(); }, numbers, count);
        },
        join);
    else
      join(all);
    return all;
  }

  GrowthMeasures GrowingAssembly::measure()
  {
    find_forces();
    const ContactSums contact = sum_contacts();
    const MotionSums  motion  = sum_motion();
    const double      space   = vessel.dimension * vessel.space() * (vessel.dimension == 2 ? material.thickness : 1.0);
    GrowthMeasures    found;
    found.ratio            = motion.pushing > 0 ? motion.unbalanced / motion.pushing : 1.0;
    found.stress           = -contact.virial / space;
    found.stress_by_growth = contact.stiffening / space;
    found.largest_overlap  = contact.largest_overlap;
    found.touching         = static_cast<std::int64_t>(contact.touching);
    found.stored           = contact.stored;
    found.kinetic          = motion.kinetic;
    return found;
  }

  GrowthEnergies GrowingAssembly::energies()
  {
    find_forces();
    const MotionSums motion = sum_motion();
    GrowthEnergies   account;
    account.growth  = growth;
    account.stored  = sum_contacts().stored;
    account.kinetic = motion.kinetic;
    account.damped  = damped + motion.damped;
    account.stopped = stopped;
    if (shared)
      shared->gather_accounts(none, contacts);
    for (const LinkBlockAccount &block : contacts.accounts)
      account.friction += block.friction;
    return account;
  }

  void GrowingAssembly::stop()
  {
    find_forces();
    const MotionSums motion = sum_motion();
    stopped += motion.kinetic;
    damped += motion.damped;
    std::fill(particles.velocity.begin(), particles.velocity.end(), 0.0);
  }

  void GrowingAssembly::set_radii(const std::vector<double> &radius, const std::vector<Eigen::Vector3d> &centre)
  {
    stop();
    const double before = sum_contacts().stored;
    gather();
    for (std::size_t i = 0; i < particles.count; ++i)
      {
        const auto number                   = static_cast<std::size_t>(particles.number[i]);
        particles.pose[record_size * i + 6] = radius.at(number);
        if (!centre.empty())
          std::copy_n(centre.at(number).data(), 3, &particles.pose[record_size * i]);
      }
    std::fill(particles.motion.begin(), particles.motion.end(), 0.0); // forces were found after it
    take_radii_of_poses();
    fit_to_radii();
    growth += sum_contacts().stored - before;
    forces_known  = false;
    none.in_parts = contacts.in_parts = false; // they may have come to lie elsewhere along the curve
  }

  void GrowingAssembly::scale_radii(const double factor)
  {
    find_forces();
    const double before = sum_contacts().stored;
    gather_places();
    double largest = 0;
    for (std::size_t i = 0; i < particles.count; ++i)
      {
        double &r = particles.pose[record_size * i + 6];
        largest   = std::max(largest, r);
        r *= factor;
      }
    std::fill(particles.motion.begin(), particles.motion.end(), 0.0);
    take_radii_of_poses();
    fit_contacts();
    const double closer = std::max(factor - 1, 0.0) * largest; // as if each had moved towards the other
    if (search.moved(closer, 0))
      look_for_contacts();
    wall_path += closer;
    if (wall_path >= wall_margin)
      look_for_walls();
    growth += sum_contacts().stored - before;
    forces_known = false;
  }

  std::vector<int> GrowingAssembly::contact_numbers()
  {
    gather();
    std::vector<int> found(particles.count, 0);
    const auto       count = [&](const std::int32_t i) {
      ++found[static_cast<std::size_t>(particles.number[static_cast<std::size_t>(i)])];
    };
    for (std::size_t l = 0; l < contacts.count; ++l)
      if (contacts.is_alive(l) && branch_of(particles, contacts, l).norm() < contacts.reference_length[l])
        {
          count(contacts.first[l]);
          count(contacts.second[l]);
        }
    for (const std::int32_t i : near_wall)
      for (const WallTouch &wall : vessel.near(particles.position_of(static_cast<std::size_t>(i)),
                                               particles.radius_of(static_cast<std::size_t>(i)), 0.0))
        if (wall.gap < 0)
          count(i);
    return found;
  }

  std::vector<double> GrowingAssembly::overlap_sums()
  {
    gather();
    std::vector<double> found(particles.count, 0.0);
    const auto          add = [&](const std::int32_t i, const double overlap) {
      found[static_cast<std::size_t>(particles.number[static_cast<std::size_t>(i)])] += std::max(overlap, 0.0);
    };
    for (std::size_t l = 0; l < contacts.count; ++l)
      if (contacts.is_alive(l))
        {
          const double overlap = contacts.reference_length[l] - branch_of(particles, contacts, l).norm();
          add(contacts.first[l], overlap);
          add(contacts.second[l], overlap);
        }
    for (const std::int32_t i : near_wall)
      for (const WallTouch &wall : vessel.near(particles.position_of(static_cast<std::size_t>(i)),
                                               particles.radius_of(static_cast<std::size_t>(i)), 0.0))
        add(i, -wall.gap);
    return found;
  }

  Packing GrowingAssembly::packing()
  {
    gather_places();
    Packing now;
    now.centre.resize(particles.count);
    now.radius.resize(particles.count);
    for (std::size_t i = 0; i < particles.count; ++i)
      {
        const auto number  = static_cast<std::size_t>(particles.number[i]);
        now.centre[number] = particles.position_of(i);
        now.radius[number] = particles.radius_of(i);
      }
    return now;
  }

  void GrowingAssembly::visit_state(base::StateVisitor &visitor)
  {
    gather();
    const std::int64_t before = fits;
    visitor.scalar("growing/fits", fits);
    if (fits != before && shared && shared->planned())
      throw std::logic_error("growing assembly: a state is taken up before the first step where ranks share its work");
    particles.visit_state(visitor);
    visitor.column("growing/mass", particles.mass); // of the radii that were set last, not of those scaled since
    visitor.column("growing/inertia", particles.inertia);
    visitor.column("growing/walls", particles.pushed);
    visitor.column("growing/near_wall", near_wall);
    contacts.visit_state(visitor, "growing/contacts", particles.count);
    if (fits != before) // a reader: lengths of the search follow from the radii
      search = ContactSearch(particles, 0.0, true);
    search.visit_state(visitor);
    std::int64_t known = forces_known;
    visitor.scalar("growing/forces_known", known);
    forces_known = known != 0;
    visitor.scalar("growing/steps", step_count);
    visitor.scalar("growing/wall_margin", wall_margin);
    visitor.scalar("growing/wall_path", wall_path);
    visitor.scalar("growing/growth", growth);
    visitor.scalar("growing/damped", damped);
    visitor.scalar("growing/stopped", stopped);
    double friction = material.contact.friction_coefficient;
    visitor.scalar("growing/friction", friction);
    take_friction(friction);
  }
} // namespace dem
