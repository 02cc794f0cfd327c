#include "dem/specimen/shared_work.h"

#include "dem/core/simd.h"
#include "dem/model/column_memory.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dem
{
  namespace
  {
    /** Numbers of a record that say something: three and three, and of a pose the radius. */
    constexpr std::size_t exchanged = 7;
    /** Of those that ranks have who know the radius. */
    constexpr std::size_t changing = 6;

    /** What records of some particles say, one after the other. */
    void put_records(const std::vector<base::Column *> &columns,
                     const std::vector<std::int32_t>   &of,
                     const std::size_t                  numbers_of_each,
                     double                            *numbers)
    {
      for (const std::int32_t i : of)
        for (const base::Column *column : columns)
          numbers = std::copy_n(&(*column)[record_size * static_cast<std::size_t>(i)], numbers_of_each, numbers);
    }

    void take_records(const std::vector<base::Column *> &columns,
                      const std::vector<std::int32_t>   &of,
                      const std::size_t                  numbers_of_each,
                      const double                      *numbers)
    {
      for (const std::int32_t i : of)
        for (base::Column *column : columns)
          {
            std::copy_n(numbers, numbers_of_each, &(*column)[record_size * static_cast<std::size_t>(i)]);
            numbers += numbers_of_each;
          }
    }

    /** Call use(numbers, count) for all that only those have who update a block: what it remembers, and does. */
    template <typename Use>
    void for_contents(LinkSet &links, const std::size_t block, const Use &use)
    {
      const LinkPart lines = links.part_of_block(block);
      each_column_of_state(links, [&](base::Column &column, const std::size_t numbers) {
        use(&column[numbers * lines.begin], numbers * (lines.end - lines.begin));
      });
    }

#ifdef BRECCIA_TRAP_FPE
    constexpr bool audits = true;
#else
    constexpr bool audits = false;
#endif
  } // namespace

  SharedWork::SharedWork(std::shared_ptr<Ranks> all, const std::int64_t every)
    : ranks(std::move(all))
    , move_every(every)
    , sent(ranks->size())
    , ghosts(ranks->size())
  {
  }

  // --- In a step ---

  void SharedWork::links_updated(const Particles &particles, LinkSet &bonds, LinkSet &contacts)
  {
    keep_own(bonds, of_bonds);
    keep_own(contacts, of_contacts);
    if (std::exchange(given_back, false))
      in_steps = static_cast<std::int64_t>(resident_bytes(particles, {&bonds, &contacts}));
    of_bonds.stale = of_contacts.stale = true;
    if (!audits && move_every == 0)
      return;
    compare_copies(bonds, of_bonds, particles);
    compare_copies(contacts, of_contacts, particles);
  }

  double SharedWork::largest(double number) const
  {
    ranks->largest(&number, 1);
    return number;
  }

  void SharedWork::share_events(Particles &particles, LinkSet &bonds, LinkSet &contacts)
  {
    const std::array<LinkSet *, 2> sets = {&bonds, &contacts};
    std::vector<std::int32_t>      mine; // block and set
    for (std::size_t s = 0; s < sets.size(); ++s)
      if (sets[s]->alive > 0)
        for (const LinkPart &part : sets[s]->parts)
          if (part.own && sets[s]->accounts[part.block].event)
            mine.insert(mine.end(), {static_cast<std::int32_t>(part.block), static_cast<std::int32_t>(s)});
    if (largest(static_cast<double>(mine.size())) == 0)
      return;
    const auto lists = ranks->deliver(std::vector<std::vector<std::int32_t>>(size(), mine));

    // Each rank's blocks, and the ends of their links, one after the other.
    std::vector<double>      all;
    std::vector<std::size_t> begin = {0};
    const auto               walk  = [&](const auto &use) {
      for (std::size_t r = 0; r < size(); ++r)
        {
          for (std::size_t at = 0; at < lists[r].size(); at += 2)
            {
              LinkSet   &links = *sets[static_cast<std::size_t>(lists[r][at + 1])];
              const auto block = static_cast<std::size_t>(lists[r][at]);
              for_contents(links, block, [&](double *numbers, const std::size_t count) { use(r, numbers, count); });
              for (const std::int32_t i : ends_of(links, {links.part_of_block(block)}, particles.count))
                for (base::Column *column : {&particles.pose, &particles.motion})
                  use(r, &(*column)[record_size * static_cast<std::size_t>(i)], exchanged);
            }
          if (begin.size() <= size())
            begin.push_back(sizeof(double) * all.size());
        }
    };
    walk([&](const std::size_t r, const double *numbers, const std::size_t count) {
      if (r == rank())
        all.insert(all.end(), numbers, numbers + count);
      else
        all.resize(all.size() + count);
    });
    gather(all.data(), begin);
    const double *next = all.data();
    walk([&](const std::size_t r, double *numbers, const std::size_t count) {
      if (r != rank())
        std::copy_n(next, count, numbers);
      next += count;
    });
    for (std::size_t r = 0; r < size(); ++r)
      for (std::size_t at = 0; at < lists[r].size(); at += 2)
        {
          const auto block = static_cast<std::size_t>(lists[r][at]), set = static_cast<std::size_t>(lists[r][at + 1]);
          sets[set]->accounts[block].event = true;
          if (r != rank())
            (set == 0 ? of_bonds : of_contacts).borrowed.push_back(block);
        }
  }

  void SharedWork::share_stress_moments(LinkSet &bonds, LinkSet &contacts)
  {
    if (bonds.alive > 0)
      gather_blocks(bonds.stress_moments.data(), stress_record * sizeof(double), of_bonds);
    if (contacts.alive > 0)
      gather_blocks(contacts.stress_moments.data(), stress_record * sizeof(double), of_contacts);
  }

  void SharedWork::share_motion(Particles                         &particles,
                                std::vector<ParticleBlockAccount> &accounts,
                                const std::vector<std::int32_t>   &by_all,
                                const std::vector<std::int32_t>   &moved_by_all)
  {
    places_stale = rates_stale = true;
    known.clear();
    keep_own(particles, by_all, moved_by_all);
    std::vector<std::size_t> begin;
    for (const std::size_t brick : brick_begin)
      begin.push_back(brick * sizeof(ParticleBlockAccount));
    gather(accounts.data(), begin);

    const std::vector<base::Column *> columns = {&particles.pose, &particles.motion};
    for (RankMessage &message : out)
      {
        put_records(columns, sent[message.rank], changing, message.numbers.data());
        bytes += static_cast<std::int64_t>(sizeof(double) * message.numbers.size());
        ++messages;
      }
    ranks->exchange(out, in);
    for (const RankMessage &message : in)
      take_records(columns, ghosts[message.rank], changing, message.numbers.data());
    if (!by_all.empty())
      gather_records({&particles.pose, &particles.motion}, by_all);
  }

  void SharedWork::share_forces(Particles &particles, const std::vector<std::int32_t> &of)
  {
    if (!of.empty())
      gather_records({&particles.force}, of);
  }

  void SharedWork::share_velocities(Particles &particles, const std::vector<std::int32_t> &of)
  {
    if (!of.empty())
      gather_records({&particles.velocity}, of);
  }

  void SharedWork::share_displacements(Particles &particles, const std::vector<std::int32_t> &of)
  {
    if (!of.empty())
      gather_records({&particles.motion}, of);
  }

  void SharedWork::share_states(Particles &particles, const std::vector<std::int32_t> &of)
  {
    if (!of.empty())
      gather_records({&particles.pose, &particles.motion, &particles.velocity, &particles.force}, of);
    known = of;
    if (!of.empty() && of != with_masses) // what prescribes their motion does not change
      gather_records({&particles.inverse_mass}, with_masses = of);
  }

  bool SharedWork::knows(const std::int32_t particle) const
  {
    return std::binary_search(known.begin(), known.end(), particle);
  }

  void SharedWork::gather_records(const std::vector<base::Column *> &columns, const std::vector<std::int32_t> &of)
  {
    std::vector<double>      all(exchanged * columns.size() * of.size());
    std::vector<std::size_t> begin;
    for (const std::int32_t particle : particle_begin)
      begin.push_back(static_cast<std::size_t>(std::lower_bound(of.begin(), of.end(), particle) - of.begin()) *
                      exchanged * columns.size() * sizeof(double));
    put_records(columns, of, exchanged, all.data());
    gather(all.data(), begin);
    take_records(columns, of, exchanged, all.data());
  }
} // namespace dem
