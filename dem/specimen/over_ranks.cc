// What a specimen does otherwise where other ranks share its work (doc/theory/ranks.md, 3).

#include "dem/specimen/core.h"
#include "dem/specimen/few_lines.h"

#include <algorithm>
#include <limits>

namespace dem
{
  void SpecimenCore::gather()
  {
    if (!shared)
      return;
    gather_particles();
    gather_wall_contacts();
    if (shared->lacks_bonds())
      shared->gather_bonds(bonds);
    if (shared->lacks_contacts())
      shared->gather_contacts(contacts);
  }

  void SpecimenCore::gather_particles()
  {
    if (!shared || !shared->lacks_particles())
      return;
    gather_places();
    shared->gather_particles(particles);
  }

  void SpecimenCore::gather_wall_contacts()
  {
    if (surfaces.lacks_contacts())
      surfaces.gather(surfaces_with_others());
  }

  bool SpecimenCore::has_all(const LinkSet &links) const
  {
    return !shares() || !links.in_parts || !(&links == &bonds ? shared->lacks_bonds() : shared->lacks_contacts());
  }

  void SpecimenCore::walk(const LinkSet                                &links,
                          double                                       *numbers,
                          const std::size_t                             count,
                          const std::function<void(const LinkRange &)> &part)
  {
    if (has_all(links))
      {
        gather_places(); // they may have moved since
        return part(all_lines(links));
      }
    const auto use = [&](const std::size_t begin, const std::size_t end) { part({begin, end}); };
    if (&links == &bonds)
      shared->relay_bonds(bonds, use, numbers, count);
    else
      shared->relay_contacts(contacts, use, numbers, count);
  }

  void SpecimenCore::walk_without_order(const LinkSet                                &links,
                                        ExactSum                                     &sum,
                                        const std::function<void(const LinkRange &)> &part)
  {
    if (has_all(links))
      {
        gather_places();
        return part(all_lines(links));
      }
    for (const LinkPart &each : links.parts)
      if (each.own)
        part({each.begin, each.end});
    shared->add_up(sum);
  }

  void SpecimenCore::walk_particles(double                                              *numbers,
                                    const std::size_t                                    count,
                                    const std::function<void(std::size_t, std::size_t)> &part)
  {
    if (shares() && shared->lacks_particles())
      shared->relay_particles(part, numbers, count);
    else
      part(0, particles.count);
  }

  namespace
  {
    /** Where the first rank has all of it. */
    void tell_itself(const std::size_t count, const SharedWork::Tell &tell, const SharedWork::Take &take)
    {
      each_few_lines(0, count, [&](const std::size_t begin, const std::size_t end) {
        std::vector<double> numbers;
        tell(begin, end, numbers);
        take(numbers);
      });
    }
  } // namespace

  void SpecimenCore::tell_first(const LinkSet &links, const SharedWork::Tell &tell, const SharedWork::Take &take)
  {
    if (!has_all(links))
      return &links == &bonds ? shared->tell_first_of_bonds(bonds, tell, take) :
                                shared->tell_first_of_contacts(contacts, tell, take);
    gather_places(); // they may have moved since
    if (is_first())
      tell_itself(links.count, tell, take);
  }

  void SpecimenCore::tell_first_of_particles(const SharedWork::Tell &tell, const SharedWork::Take &take)
  {
    if (!has_all_links())
      return shared->tell_first_of_particles(tell, take);
    if (is_first())
      tell_itself(particles.count, tell, take);
  }

  SharedSearch SpecimenCore::search_with_others() { return shares() ? shared->search() : SharedSearch(); }

  void SpecimenCore::gather_accounts()
  {
    if (shares())
      shared->gather_accounts(bonds, contacts);
  }

  void SpecimenCore::gather_places()
  {
    if (!shared || !shared->lacks_places())
      return;
    shared->gather_places(particles);
    gather_glide();
  }

  /** What is remembered of particles on the way through a glide, and since one. */
  void SpecimenCore::gather_glide()
  {
    if (!shares())
      return;
    if (gliding.under_way)
      for (base::Column *column : {&gliding.pose, &gliding.motion, &gliding.velocity})
        shared->gather_column(*column);
    if (!unseen.empty())
      shared->gather_column(unseen);
  }

  void SpecimenCore::gather_particle(const std::int32_t particle)
  {
    if (shares() && !shared->knows(particle))
      gather_particles();
  }

  std::vector<std::int32_t> SpecimenCore::corrected_by(const StepPartner &partner) const
  {
    std::vector<std::int32_t> some;
    for (const std::size_t number : *partner.particles)
      some.push_back(slot.at(number));
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
    return some;
  }

  double SpecimenCore::largest_of_all(const double own) const { return shares() ? shared->largest(own) : own; }

  void SpecimenCore::shorten_step_for(const std::vector<std::int32_t> &some)
  {
    if (some.empty())
      return;
    const bool each_its_own = shares() && clumps.empty(); // a clump's depends on what touches any of its pebbles
    if (!each_its_own)
      gather();
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t i : some)
      if (!each_its_own || shared->owns(i))
        least = std::min(least, parameters.step_factor * stable(i));
    longest_step = std::min(longest_step, each_its_own ? shared->least(least) : least);
  }

  std::vector<std::int32_t> SpecimenCore::moved_by_all() const
  {
    std::vector<std::int32_t> all = held.members();
    all.insert(all.end(), clumps.pebbles().begin(), clumps.pebbles().end());
    return all;
  }

  void SpecimenCore::share_out()
  {
    const bool changes = shared->changes_ranges(step_count);
    if (changes || !bonds.in_parts) // others may move other particles from now on
      {
        gather();
        if (shares())
          shared->gather_search(search);
      }
    if (changes)
      shared->change_ranges(step_count, bonds, contacts);
    if (!bonds.in_parts || !contacts.in_parts)
      shared->plan(particles, bonds, contacts, search, read_by_surfaces(), moved_by_all(), cracks.ends_of_gone());
  }

  /** Ranks that share all else move all clumps each, which may lie across their bricks. */
  void SpecimenCore::move_clumps(const StepHalves &halves)
  {
    if (shares())
      {
        shared->share_forces(particles, clumps.pebbles());
        accounts.back() = {};
      }
    clumps.move(particles, halves, parameters.damping, parameters.gravity, accounts);
  }

  void SpecimenCore::gather_constants()
  {
    if (shares())
      shared->gather_constants(particles);
  }

  std::pair<std::size_t, std::size_t> SpecimenCore::own_particles() const
  {
    if (!shares())
      return {0, particles.count};
    return {static_cast<std::size_t>(shared->first()), static_cast<std::size_t>(shared->last())};
  }
} // namespace dem
