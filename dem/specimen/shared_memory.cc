// Who has what of a specimen among ranks, and how the others come to read it (doc/theory/ranks.md, 3).

#include "dem/core/memory_pages.h"
#include "dem/model/column_memory.h"
#include "dem/ranks/from_one.h"
#include "dem/ranks/in_turn.h"
#include "dem/specimen/few_lines.h"
#include "dem/specimen/shared_work.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace dem
{
  namespace
  {
    /** Call use(begin, end) for what lies between the parts of a set, among some of its lines. */
    template <typename Use>
    void each_gap(const LinkSet &links, const LinkPart &among, const Use &use)
    {
      auto        part = std::lower_bound(links.parts.begin(), links.parts.end(), among.begin,
                                          [](const LinkPart &each, const std::size_t line) { return each.end <= line; });
      std::size_t at   = among.begin;
      for (; part != links.parts.end() && part->begin < among.end; ++part)
        {
          if (part->begin > at)
            use(at, part->begin);
          at = part->end;
        }
      if (at < among.end)
        use(at, among.end);
    }
  } // namespace

  // --- What others have takes no memory ---

  void SharedWork::drop(base::Column &column, const std::size_t begin, const std::size_t end) const
  {
    if (move_every > 0)
      std::fill(column.begin() + static_cast<std::ptrdiff_t>(begin), column.begin() + static_cast<std::ptrdiff_t>(end),
                std::numeric_limits<double>::quiet_NaN());
    else
      give_back(column, begin, end);
  }

  void SharedWork::drop_lines(base::Column     &column,
                              const std::size_t numbers_of_line,
                              const LinkSet    &links,
                              const LinkPart   &among) const
  {
    each_gap(links, among, [&](const std::size_t begin, const std::size_t end) {
      drop(column, numbers_of_line * begin, numbers_of_line * end);
    });
  }

  void SharedWork::take_small_pages_of_others(LinkSet &links, const SetShare &share) const
  {
    each_column_of_state(links, [&](base::Column &column, const std::size_t numbers) {
      for (const auto &begin : share.block_begin)
        {
          const auto number = [&](const std::size_t block) {
            return numbers * std::min(block * links_per_block, links.first.size());
          };
          take_small_pages(column, number(begin.front()), number(begin[rank()]));
          take_small_pages(column, number(begin[rank() + 1]), number(begin.back()));
        }
    });
  }

  void SharedWork::take_small_pages_of_others(Particles &particles) const
  {
    for (base::Column *column : records_of_state(particles))
      {
        take_small_pages(*column, 0, record_size * static_cast<std::size_t>(first()));
        take_small_pages(*column, record_size * static_cast<std::size_t>(last()), record_size * particles.count);
      }
  }

  bool SharedWork::may_go(std::int64_t &since) const { return since++ >= steps_between_readings || move_every > 0; }

  void SharedWork::keep_own(LinkSet &links, SetShare &share)
  {
    for (const std::size_t block : std::exchange(share.borrowed, {}))
      if (share.lean)
        each_column_of_state(links, [&](base::Column &column, const std::size_t numbers) {
          drop_lines(column, numbers, links, links.part_of_block(block));
        });
    if (share.lean || !may_go(share.since_read))
      return;
    hold_own(links, share);
    given_back = true;
  }

  void SharedWork::hold_own(LinkSet &links, SetShare &share)
  {
    drop_others(links);
    share.lean = share.stale = true;
  }

  void SharedWork::drop_others(LinkSet &links)
  {
    each_column_of_state(links, [&](base::Column &column, const std::size_t numbers) {
      drop_lines(column, numbers, links, {0, links.first.size(), 0, true});
    });
    links.keep_others_of(first(), last());
  }

  void SharedWork::keep_own(Particles                       &particles,
                            const std::vector<std::int32_t> &by_all,
                            const std::vector<std::int32_t> &moved_by_all)
  {
    given_back = std::exchange(planned_anew, false) || given_back;
    if (lean || !may_go(since_read))
      return;
    hold_own(particles, by_all, moved_by_all);
    given_back = true;
  }

  void SharedWork::hold_own(Particles                       &particles,
                            const std::vector<std::int32_t> &by_all,
                            const std::vector<std::int32_t> &moved_by_all)
  {
    if (particles.radii.empty())
      particles.keep_radii();
    std::vector<std::int32_t> kept = moved_by_all;
    std::sort(kept.begin(), kept.end());
    for (base::Column *column : records_of_motion(particles))
      drop_particles(*column, record_size, kept);
    kept.insert(kept.end(), by_all.begin(), by_all.end());
    for (const std::vector<std::int32_t> &of : ghosts)
      kept.insert(kept.end(), of.begin(), of.end());
    std::sort(kept.begin(), kept.end());
    for (base::Column *column : records_of_places(particles))
      drop_particles(*column, record_size, kept);
    drop_particles(particles.reference, 3, kept);
    lean = places_stale = rates_stale = constants_absent = true;
    with_masses.clear();
  }

  void SharedWork::hold_own(ContactSearch &search) const
  {
    drop_particles(search.places(), 3, {});
    search.know({first(), last()});
  }

  void SharedWork::drop_particles(base::Column                    &column,
                                  const std::size_t                numbers_of_each,
                                  const std::vector<std::int32_t> &kept) const
  {
    const auto drop_between = [&](std::int32_t at, const std::int32_t end) {
      const auto number = [&](const std::int32_t i) { return numbers_of_each * static_cast<std::size_t>(i); };
      for (auto next = std::lower_bound(kept.begin(), kept.end(), at); next != kept.end() && *next < end; ++next)
        {
          if (*next > at)
            drop(column, number(at), number(*next));
          at = *next + 1;
        }
      if (at < end)
        drop(column, number(at), number(end));
    };
    drop_between(0, first());
    drop_between(last(), particle_begin.back());
  }

  // --- To read all of it ---

  void SharedWork::gather(void *array, const std::vector<std::size_t> &begin)
  {
    bytes += static_cast<std::int64_t>(begin[rank() + 1] - begin[rank()]);
    ++messages;
    ranks->gather(array, begin);
  }

  SharedSearch SharedWork::search()
  {
    return {rank(), particle_begin,
            [this](void *array, const std::vector<std::size_t> &begin) { gather(array, begin); }};
  }

  void SharedWork::gather_numbers(double *all, const std::size_t of_each)
  {
    std::vector<std::size_t> begin;
    for (const std::int32_t particle : particle_begin)
      begin.push_back(static_cast<std::size_t>(particle) * of_each * sizeof(double));
    gather(all, begin);
  }

  void SharedWork::gather_places(Particles &particles)
  {
    since_read = 0;
    if (!std::exchange(places_stale, false))
      return;
    gather_column(particles.pose);
    gather_column(particles.motion);
    lean = false;
  }

  void SharedWork::gather_particles(Particles &particles)
  {
    gather_places(particles);
    if (std::exchange(rates_stale, false))
      {
        gather_column(particles.velocity);
        gather_column(particles.force);
      }
    gather_constants(particles);
    lean = false;
  }

  void SharedWork::gather_constants(Particles &particles)
  {
    if (!std::exchange(constants_absent, false))
      return;
    gather_column(particles.inverse_mass);
    gather_numbers(particles.reference.data(), 3);
    lean = false;
  }

  void SharedWork::gather_search(ContactSearch &search)
  {
    if (search.known().end > last() || search.known().begin < first()) // all have all of it
      return;
    gather_numbers(search.places().data(), 3);
    search.know({});
  }

  void SharedWork::gather_blocks(void *column, const std::size_t bytes_of_block, const SetShare &share)
  {
    auto *bytes_of_column = static_cast<char *>(column);
    for (const std::vector<std::size_t> &blocks : share.block_begin)
      {
        std::vector<std::size_t> begin;
        for (const std::size_t block : blocks)
          begin.push_back((block - blocks.front()) * bytes_of_block);
        if (begin.back() > 0)
          gather(bytes_of_column + blocks.front() * bytes_of_block, begin);
      }
  }

  void SharedWork::gather_column(base::Column &column, const std::size_t numbers_of_line, const SetShare &share)
  {
    gather_blocks(column.data(), numbers_of_line * sizeof(double) * links_per_block, share);
  }

  void SharedWork::gather_links(LinkSet &links, SetShare &share)
  {
    share.since_read = 0;
    if (!std::exchange(share.stale, false) || links.count == 0)
      return;
    each_column_of_state(
      links, [&](base::Column &column, const std::size_t numbers) { gather_column(column, numbers, share); });
    gather_blocks(links.accounts.data(), sizeof(LinkBlockAccount), share);
    if (std::exchange(share.lean, false))
      links.list_others();
  }

  void SharedWork::gather_accounts(LinkSet &bonds, LinkSet &contacts)
  {
    for (const auto &[links, share] : {std::pair(&bonds, &of_bonds), std::pair(&contacts, &of_contacts)})
      if (links->in_parts && share->stale && links->count > 0)
        gather_blocks(links->accounts.data(), sizeof(LinkBlockAccount), *share);
  }

  // --- One after the other ---

  void
  SharedWork::relay(const std::vector<std::size_t> &begin, const OfLines &use, double *numbers, const std::size_t count)
  {
    pass_along(*ranks, numbers, count, [&] {
      if (begin[rank() + 1] > begin[rank()])
        use(begin[rank()], begin[rank() + 1]);
    });
    std::vector<std::size_t> of_last(size() + 1, 0);
    of_last.back() = count * sizeof(double);
    gather(numbers, of_last);
  }

  void SharedWork::relay_lines(
    const LinkSet &links, const SetShare &share, const OfLines &use, double *numbers, const std::size_t count)
  {
    if (links.count == 0)
      return;
    if (!links.in_parts)
      return use(0, links.count); // all have all of it
    for (const std::vector<std::size_t> &begin : lines_of_ranks(links, share))
      relay(begin, use, numbers, count);
  }

  std::vector<std::vector<std::size_t>> SharedWork::lines_of_ranks(const LinkSet &links, const SetShare &share)
  {
    std::vector<std::vector<std::size_t>> all;
    for (const std::vector<std::size_t> &blocks : share.block_begin)
      {
        std::vector<std::size_t> &begin = all.emplace_back();
        for (const std::size_t block : blocks)
          begin.push_back(std::min(block * links_per_block, links.count));
      }
    return all;
  }

  void SharedWork::relay_bonds(const LinkSet &bonds, const OfLines &use, double *numbers, const std::size_t count)
  {
    relay_lines(bonds, of_bonds, use, numbers, count);
  }

  void SharedWork::relay_contacts(const LinkSet &contacts, const OfLines &use, double *numbers, const std::size_t count)
  {
    relay_lines(contacts, of_contacts, use, numbers, count);
  }

  void SharedWork::relay_particles(const OfLines &use, double *numbers, const std::size_t count)
  {
    relay({particle_begin.begin(), particle_begin.end()}, use, numbers, count);
  }

  void SharedWork::add_up(ExactSum &sum)
  {
    std::vector<ExactSum>    of(size());
    std::vector<std::size_t> begin;
    for (std::size_t r = 0; r <= size(); ++r)
      begin.push_back(r * sizeof(ExactSum));
    of[rank()] = sum;
    gather(of.data(), begin);
    sum = {};
    for (const ExactSum &each : of)
      sum.add(each);
  }

  // --- Part by part, for the first rank ---

  void SharedWork::send_to_first(const std::size_t from, std::vector<double> &numbers)
  {
    if (from == 0)
      return;
    const auto send = [&](std::vector<double> &part) {
      std::vector<RankMessage> from_here, at_first;
      if (rank() == from)
        {
          bytes += static_cast<std::int64_t>(sizeof(double) * part.size());
          ++messages;
          from_here.push_back({0, std::move(part)});
        }
      if (rank() == 0)
        at_first.push_back({from, std::move(part)});
      ranks->exchange(from_here, at_first);
      if (rank() == 0)
        part = std::move(at_first.front().numbers);
    };
    std::vector<double> length = {static_cast<double>(numbers.size())};
    send(length);
    if (rank() == 0)
      numbers.resize(static_cast<std::size_t>(length.front()));
    send(numbers);
  }

  void SharedWork::tell_first(const std::vector<std::size_t> &begin, const Tell &tell, const Take &take)
  {
    for (std::size_t r = 0; r < size(); ++r)
      each_few_lines(begin[r], begin[r + 1], [&](const std::size_t from, const std::size_t to) {
        std::vector<double> numbers;
        if (rank() == r)
          tell(from, to, numbers);
        send_to_first(r, numbers);
        if (is_first())
          take(numbers);
      });
  }

  void SharedWork::tell_first_of_lines(const LinkSet &links, const SetShare &share, const Tell &tell, const Take &take)
  {
    if (links.count > 0)
      for (const std::vector<std::size_t> &begin : lines_of_ranks(links, share))
        tell_first(begin, tell, take);
  }

  void SharedWork::tell_first_of_bonds(const LinkSet &bonds, const Tell &tell, const Take &take)
  {
    tell_first_of_lines(bonds, of_bonds, tell, take);
  }

  void SharedWork::tell_first_of_contacts(const LinkSet &contacts, const Tell &tell, const Take &take)
  {
    tell_first_of_lines(contacts, of_contacts, tell, take);
  }

  void SharedWork::tell_first_of_particles(const Tell &tell, const Take &take)
  {
    tell_first({particle_begin.begin(), particle_begin.end()}, tell, take);
  }

  // --- One column of it ---

  void SharedWork::tell_column(const base::Column                          &column,
                               const std::size_t                            numbers_of_line,
                               const std::vector<std::vector<std::size_t>> &lines,
                               const TakePart                              &take)
  {
    std::size_t told = 0;
    for (const std::vector<std::size_t> &begin : lines)
      for (std::size_t r = 0; r < size(); ++r)
        each_few_lines(begin[r], begin[r + 1], [&](const std::size_t from, const std::size_t to) {
          if (from != told)
            throw std::logic_error("ranks: a column has lines of nobody");
          told = to;
          std::vector<double> part(numbers_of_line * (to - from));
          if (rank() == r)
            {
              std::copy_n(&column[numbers_of_line * from], part.size(), part.data());
              bytes += static_cast<std::int64_t>(sizeof(double) * part.size());
              ++messages;
            }
          take_from(*ranks, r, part.data(), part.size());
          take(part.data(), part.size());
        });
    if (const std::size_t at = numbers_of_line * told; at < column.size()) // filled up, without meaning
      take(&column[at], column.size() - at);
  }

  void
  SharedWork::tell_column(const base::Column &column, const LinkSet &links, const SetShare &share, const TakePart &take)
  {
    if (!links.in_parts || !share.stale || links.count == 0)
      return take(column.data(), column.size());
    const std::size_t                     all   = links.first.size();
    std::vector<std::vector<std::size_t>> lines = share.block_begin;
    for (std::vector<std::size_t> &begin : lines)
      for (std::size_t &at : begin)
        at = std::min(at * links_per_block, all);
    tell_column(column, column.size() / all, lines, take);
  }

  void SharedWork::tell_column_of_bonds(const base::Column &column, const LinkSet &bonds, const TakePart &take)
  {
    tell_column(column, bonds, of_bonds, take);
  }

  void SharedWork::tell_column_of_contacts(const base::Column &column, const LinkSet &contacts, const TakePart &take)
  {
    tell_column(column, contacts, of_contacts, take);
  }

  void SharedWork::tell_records(const base::Column &column, const TakePart &take)
  {
    if (lacks_particles())
      tell_column(column, record_size, {{particle_begin.begin(), particle_begin.end()}}, take);
    else
      take(column.data(), column.size());
  }

  void SharedWork::tell_places(ContactSearch &search, const TakePart &take)
  {
    tell_column(search.places(), 3, {{particle_begin.begin(), particle_begin.end()}}, take);
  }
} // namespace dem
