#include "base/errors.h"
#include "dem/core/memory_pages.h"
#include "dem/measures/link_measures.h"
#include "dem/specimen/core.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace dem
{
  namespace
  {
    /** How often the state is checked for NaN. */
    constexpr std::int64_t steps_between_checks = 100;
    /** Deleted links stay as idle lines until they are this part of all. */
    constexpr double idle_lines_allowed = 0.05;
  } // namespace

  void SpecimenCore::step(const StepPartner &partner)
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

  void SpecimenCore::find_link_forces()
  {
    const double per_second = last_step > 0 ? 1 / last_step : 0.0;
    if (shared)
      share_out();
    bonds.per_second    = bond_law->viscous() ? per_second : 0.0;
    contacts.per_second = contact_law->viscous() ? per_second : 0.0;
    bond_pass(bonds, particles, *bond_law, bonds.whole());
    if (contacts.alive > 0)
      contact_pass(contacts, particles, *contact_law, contacts.whole());
    if (shared)
      {
        shared->links_updated(particles, bonds, contacts);
        if (parameters.physics.periodic)
          shared->share_stress_moments(bonds, contacts);
        shared->share_events(particles, bonds, contacts);
      }
    if (parameters.physics.periodic)
      sum_stress();
    settle_events(bonds, *bond_law);
    settle_events(contacts, *contact_law);
    if (!emission.listens())
      return;
    if (emission.hears(cracks.events()))
      gather();
    emission.listen(particles, bonds, contacts, cracks.events(), time);
  }

  void SpecimenCore::move_particles(const StepHalves   &halves,
                                    const base::Column &of_surfaces,
                                    const bool          touched,
                                    const StepPartner  &partner)
  {
    if (touched && particles.pushed.empty())
      assign_zeros(particles.pushed, record_size * particles.count);
    std::vector<std::int32_t> corrected_ones;
    if (partner.particles && shares())
      shared->share_velocities(particles, corrected_ones = corrected_by(partner));
    if (partner.particles)
      enter_velocities(partner, before_step);
    select_particle_pass(contacts.alive > 0, parameters.damping > 0, equal_radii, moments(), surroundings(touched))(
      particles, bonds, &contacts, of_surfaces, halves, parameters.damping, parameters.gravity, own_blocks(), accounts);
    if (!clumps.empty())
      move_clumps(halves);
    if (shared)
      shared->share_motion(particles, accounts, read_by_surfaces(), moved_by_all());
    if (!held.turning_members().empty())
      turn_grips(halves);
    if (!partner.particles)
      return account(halves);
    if (shared)
      shared->share_states(particles, corrected_ones);
    const auto work = let_correct(halves, partner);
    account(halves);
    book.work.now += work[0];
    book.work.after += work[1];
  }

  void SpecimenCore::end_step()
  {
    if (parameters.physics.periodic)
      particles.cell.advance(time_step);
    ++step_count;
    time += time_step;
    last_step = time_step;
    if (parameters.physics.contacts)
      {
        const double largest = largest_displacement();
        refuse_too_fast(largest, 0);
        const OverlapWatch::Frame now{parameters.physics.largest_overlap, smallest_radius, step_count, time};
        if (overlaps.looks_after(largest, now))
          overlaps.measured(deepest_overlap(), now, particles);
        else
          overlaps.moved(largest);
        if (contact_law->stiffens())
          watch_stiffening();
        make_contacts();
      }
    if (step_count % steps_between_checks != 0)
      return;
    check_numbers();
    watch_turns();
  }

  /** doc/theory/periodic-cell.md, 2. */
  void SpecimenCore::sum_stress()
  {
    stress_moment.setZero();
    for (const LinkSet *links : {&bonds, &contacts})
      if (links->alive > 0)
        for (std::size_t b = 0; b < links->blocks(); ++b)
          stress_moment +=
            Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&links->stress_moments[stress_record * b]);
  }

  void SpecimenCore::account(const StepHalves &halves)
  {
    book.damped.next_step();
    book.work.next_step();
    for (const auto &block : accounts)
      {
        book.damped.now -= block.damping_before;
        book.damped.after -= block.damping_after;
        book.work.now += block.pushing_before;
        book.work.after += block.pushing_after;
      }
    if (shared)
      {
        shared->share_forces(particles, held.members());
        shared->share_forces(particles, kicks.particles());
      }
    book.work.now += kicks.work(particles, halves.before);
    kicks.clear();
    held.sum_forces(particles);
    held.add_work(particles, halves, book.work);
    if (parameters.physics.periodic)
      {
        const auto work = [&](const Eigen::Matrix3d &increment) {
          return 0.5 * stress_moment.transpose().cwiseProduct(increment).sum(); // V sigma^T : G dt/2
        };
        book.work.now += work(particles.cell.last_increment());
        book.work.after += work(time_step * particles.cell.gradient());
      }
  }

  void SpecimenCore::settle_events(LinkSet &links, const LinkLaw &law)
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
                cracks.log(particles, links, reader, l, time, step_count);
              if (phase == LinkPhase::whole)
                continue;
              if (law.bonds() && !noted)
                cracks.note(particles, links, reader, l);
              if (phase == LinkPhase::gone)
                delete_link(links, reader, l);
              else if (links.logs_breaks)
                links.noted[l] = 1;
            }
        }
    if (law.bonds() && static_cast<double>(links.deleted()) > idle_lines_allowed * static_cast<double>(links.count))
      {
        if (shared) // others may get other parts of what is left
          gather();
        links.compact(particles.count);
      }
  }

  void SpecimenCore::delete_link(LinkSet &links, const LinkReader &link, const std::size_t l)
  {
    const std::int32_t    J = links.first[l], K = links.second[l];
    const Eigen::Vector3d branch = branch_of(particles, links, l);
    if (links.periodic)
      stress_moment -= branch * Eigen::RowVector3d(&links.force[record_size * l]);
    // Below zero where one step closed and opened it: energy that the step made, not the link. The balance shows it.
    book.released += std::max(link.stored() - work_not_taken_up(particles, links, link.view(), l), 0.0);
    links.remove(l);
    if (parameters.physics.contacts)
      search.watch(particles, {J, K, links.periodic ? links.image[l] : 0});
  }

  double SpecimenCore::largest_displacement() const
  {
    double fastest = 0;
    for (const auto &block : accounts)
      fastest = std::max(fastest, block.fastest);
    return std::sqrt(fastest);
  }

  void SpecimenCore::make_contacts(const SharedSearch &with_others)
  {
    if (!search.moved(largest_displacement(), (time_step * particles.cell.gradient()).norm()))
      return;
    gather_places();
    const auto searches = search.searches();
    const auto born     = search.find_contacts(particles, bonds, contacts, with_others);
    if (contact_law->waits() && search.searches() != searches)
      drop_distant_contacts();
    if (born.empty())
      return;
    if (shared)
      shared->gather_contacts(contacts);
    add_contacts(contacts, born, particles, shape, *contact_law);
    // Links only soften, but contacts stiffen the particles they join: keep the factor on the present bound.
    std::vector<std::int32_t> joined;
    for (const auto &pair : born)
      joined.insert(joined.end(), {pair.first, pair.second});
    shorten_step_for(joined);
    time_step = std::min(time_step, longest_step);
  }

  void SpecimenCore::drop_distant_contacts()
  {
    for (std::size_t l = 0; l < contacts.count; ++l)
      if (contacts.is_alive(l) && !search.is_near(particles, {contacts.first[l], contacts.second[l],
                                                              contacts.periodic ? contacts.image[l] : 0}))
        contacts.remove(l);
  }

  namespace
  {
    /** Whether some in a row are finite, several at a time: what is not, is not zero times zero either. */
    bool all_finite(const base::Column &records, std::size_t at, const std::size_t end)
    {
      std::array<double, 4 * record_size> sums{};
      for (; at + sums.size() <= end; at += sums.size())
        for (std::size_t c = 0; c < sums.size(); ++c)
          sums[c] += 0 * records[at + c];
      double sum = 0;
      for (; at < end; ++at)
        sum += 0 * records[at];
      for (const double each : sums)
        sum += each;
      return std::isfinite(sum);
    }
  } // namespace

  void SpecimenCore::watch_turns()
  {
    double fastest           = 0; // squared
    const auto [first, last] = own_particles();
    for (std::size_t i = first; i < last; ++i)
      fastest = std::max(fastest, Eigen::Vector3d(&particles.velocity[record_size * i + 3]).squaredNorm());
    if (shares())
      fastest = shared->largest(fastest);
    largest_turn = std::max(largest_turn, time_step * std::sqrt(fastest));
  }

  void SpecimenCore::check_numbers() const
  {
    const auto [first, last] = own_particles();
    std::size_t found        = particles.count;
    if (!all_finite(particles.velocity, record_size * first, record_size * last))
      for (std::size_t i = first; i < last && found == particles.count; ++i)
        for (int c = 0; c < 6; ++c)
          if (!std::isfinite(particles.velocity[record_size * i + c]))
            found = i;
    if (shares()) // all stop, by the same words
      found = static_cast<std::size_t>(shared->least(static_cast<double>(found)));
    if (found == particles.count)
      return;
    std::ostringstream message;
    message << "step " << step_count << ", time " << time << " s: particle " << particles.number[found] + 1
            << " no longer has a finite velocity. Lower Time/Step factor (" << parameters.step_factor
            << ") or the loading rate, and check the material.";
    throw base::NumericalError(message.str());
  }
} // namespace dem
