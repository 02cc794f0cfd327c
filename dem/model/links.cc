#include "dem/model/links.h"

#include "dem/core/memory_pages.h"
#include "dem/core/streaming.h"
#include "dem/model/materials.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dem
{
  namespace
  {
    std::size_t round_up(const std::size_t n, const std::size_t unit) { return (n + unit - 1) / unit * unit; }

    /** What a step goes through for a link, with its share of its particles, over its force record: 190 to 370 bytes over 64. */
    constexpr std::size_t held_over_forces = 5;
  } // namespace

  std::size_t LinkSet::bytes() const
  {
    std::size_t doubles = 0;
    for (const base::Column *column : {&reference_length, &area, &force, &moment, &stress_moments})
      doubles += column->capacity();
    for (const base::Column &column : history)
      doubles += column.capacity();
    std::size_t integers = 0;
    for (const auto *column :
         {&first, &second, &image, &pair, &noted, &kinds, &first_block, &own_begin, &owned, &other_begin, &others})
      integers += column->capacity();
    return doubles * sizeof(double) + integers * sizeof(std::int32_t) + living.capacity() +
           accounts.capacity() * sizeof(LinkBlockAccount);
  }

  void LinkSet::shape_for(const LinkLaw &links_law, const bool in_cell, const bool several_materials)
  {
    periodic      = in_cell;
    several_pairs = several_materials;
    has_moment    = links_law.has_moment();
    moments_apart = has_moment && !links_law.planar();
    logs_breaks   = links_law.breaks_in_place();
    quantities    = links_law.columns();
    kinds         = links_law.kinds();
    viscous       = links_law.viscous();
    history.resize(quantities.size());
  }

  LinkSet LinkSet::empty_like() const
  {
    LinkSet other;
    other.periodic      = periodic;
    other.several_pairs = several_pairs;
    other.has_moment    = has_moment;
    other.moments_apart = moments_apart;
    other.logs_breaks   = logs_breaks;
    other.quantities    = quantities;
    other.kinds         = kinds;
    other.viscous       = viscous;
    other.history.resize(quantities.size());
    return other;
  }

  Eigen::Vector3d LinkSet::moment_of(const std::size_t link) const
  {
    if (!has_moment)
      return Eigen::Vector3d::Zero();
    if (moments_apart)
      return Eigen::Vector3d(&moment[half_record_size * link]);
    return {0, 0, force[record_size * link + 7]};
  }

  std::size_t LinkSet::laws() const
  {
    return kinds.empty() ? 1 : static_cast<std::size_t>(*std::max_element(kinds.begin(), kinds.end())) + 1;
  }

  std::vector<std::size_t> LinkSet::resize_by_law(const std::vector<std::size_t> &links_of_law,
                                                  const std::size_t               particles)
  {
    if (kinds.empty())
      {
        resize(links_of_law.front(), particles);
        return {0};
      }
    std::vector<std::size_t> first_line;
    std::size_t              end = 0;
    first_block.clear();
    padding = 0;
    for (const std::size_t n : links_of_law)
      {
        padding += round_up(end, links_per_block) - end;
        end = round_up(end, links_per_block);
        first_line.push_back(end);
        first_block.push_back(static_cast<std::int32_t>(end / links_per_block));
        end += n;
      }
    first_block.push_back(static_cast<std::int32_t>(round_up(end, links_per_block) / links_per_block));
    resize(end, particles);
    pad(0, particles);
    return first_line;
  }

  void LinkSet::pad(const std::size_t from, const std::size_t particles)
  {
    const auto begin = static_cast<std::ptrdiff_t>(from);
    std::fill(first.begin() + begin, first.end(), static_cast<std::int32_t>(particles));
    std::fill(second.begin() + begin, second.end(), static_cast<std::int32_t>(particles + 1));
    for (auto *column : {&image, &pair, &noted})
      if (!column->empty())
        std::fill(column->begin() + begin, column->end(), 0);
    std::fill(reference_length.begin() + begin, reference_length.end(), 1.0);
    std::fill(area.begin() + begin, area.end(), 0.0);
    std::fill(living.begin() + begin, living.end(), std::uint8_t{0});
    for (base::Column &column : history)
      std::fill(column.begin() + begin, column.end(), 0.0);
  }

  void LinkSet::find_living()
  {
    living.resize(area.size());
    for (std::size_t l = 0; l < area.size(); ++l)
      living[l] = area[l] > 0;
  }

  void LinkSet::resize(const std::size_t n, const std::size_t particles)
  {
    count                   = n;
    const std::size_t lines = round_up(n, links_per_block);
    first.resize(lines);
    second.resize(lines);
    if (periodic)
      {
        image.resize(lines);
        stress_moments.assign(stress_record * std::max<std::size_t>(lines / links_per_block, 1), 0.0);
      }
    if (several_pairs)
      pair.resize(lines);
    if (logs_breaks)
      noted.resize(lines);
    living.resize(lines);
    for (base::Column *column : {&reference_length, &area})
      assign_zeros(*column, lines);
    for (base::Column &column : history)
      assign_zeros(column, lines);
    pad(n, particles);
    assign_zeros(force, record_size * lines);
    if (moments_apart)
      assign_zeros(moment, half_record_size * lines);
    accounts.resize(std::max<std::size_t>(lines / links_per_block, 1));
    const std::size_t forces = sizeof(double) * force.size();
    streams                  = forces > last_level_cache();
    fetches_ahead            = held_over_forces * forces > last_level_cache();
  }

  std::pair<std::ptrdiff_t, std::ptrdiff_t> LinkSet::parts_between(const LinkLines &lines) const
  {
    if (!in_parts)
      return {static_cast<std::ptrdiff_t>(lines.first_block), static_cast<std::ptrdiff_t>(lines.end_block)};
    const auto at = [&](const std::size_t block) {
      return std::lower_bound(parts.begin(), parts.end(), block,
                              [](const LinkPart &part, const std::size_t b) { return part.block < b; }) -
             parts.begin();
    };
    return {at(lines.first_block), at(lines.end_block)};
  }

  void LinkSet::tabulate(const std::size_t particles)
  {
    in_parts  = false;
    own_begin = begins_of(first, particles);
    if (!kinds.empty())
      owned = listed_by(first, own_begin);
    list_others();
  }

  void LinkSet::list_others()
  {
    other_begin = begins_of(second, own_begin.size() - 1);
    others      = listed_by(second, other_begin);
  }

  void LinkSet::keep_others_of(const std::int32_t from, const std::int32_t to)
  {
    const std::int32_t begin = other_begin[static_cast<std::size_t>(from)],
                       end   = other_begin[static_cast<std::size_t>(to)];
    others = std::vector<std::int32_t>(others.begin() + begin, others.begin() + end); // the memory of the rest goes
    for (std::int32_t &at : other_begin)
      at = std::clamp(at, begin, end) - begin;
  }

  /** Where the links of each particle begin in a list of them by one of their ends. */
  std::vector<std::int32_t> LinkSet::begins_of(const std::vector<std::int32_t> &ends, const std::size_t particles) const
  {
    std::vector<std::int32_t> begin(particles + 1, 0);
    for (std::size_t l = 0; l < count; ++l)
      if (!is_padding(l, particles))
        ++begin[static_cast<std::size_t>(ends[l]) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    return begin;
  }

  std::vector<std::int32_t> LinkSet::listed_by(const std::vector<std::int32_t> &ends,
                                               const std::vector<std::int32_t> &begin) const
  {
    std::vector<std::int32_t> links(count - padding), next(begin.begin(), begin.end() - 1);
    for (std::size_t l = 0; l < count; ++l)
      if (!is_padding(l, next.size()))
        links[static_cast<std::size_t>(next[static_cast<std::size_t>(ends[l])]++)] = static_cast<std::int32_t>(l);
    return links;
  }

  void LinkSet::copy_line(const LinkSet &source, const std::size_t from, const std::size_t to)
  {
    first[to]  = source.first[from];
    second[to] = source.second[from];
    if (periodic)
      image[to] = source.image[from];
    if (several_pairs)
      pair[to] = source.pair[from];
    if (logs_breaks)
      noted[to] = source.noted[from];
    reference_length[to] = source.reference_length[from];
    area[to]             = source.area[from];
    living[to]           = source.living[from];
    for (std::size_t c = 0; c < history.size(); ++c)
      history[c][to] = source.history[c][from];
    std::copy_n(&source.force[record_size * from], record_size, &force[record_size * to]);
    if (moments_apart)
      std::copy_n(&source.moment[half_record_size * from], half_record_size, &moment[half_record_size * to]);
  }

  void LinkSet::remove(const std::size_t link)
  {
    area[link]   = 0.0;
    living[link] = 0;
    std::fill_n(&force[record_size * link], record_size, 0.0);
    if (moments_apart)
      std::fill_n(&moment[half_record_size * link], half_record_size, 0.0);
    --alive;
  }

  std::size_t LinkSet::broken() const
  {
    std::size_t found = 0;
    for (std::size_t l = 0; logs_breaks && l < count; ++l)
      found += is_alive(l) && is_broken(l);
    return found;
  }

  void LinkSet::get_history(const std::size_t link, std::vector<double> &row) const
  {
    row.resize(history.size());
    for (std::size_t c = 0; c < history.size(); ++c)
      row[c] = history[c][link];
  }

  void LinkSet::set_history(const std::size_t link, const std::vector<double> &row)
  {
    for (std::size_t c = 0; c < history.size(); ++c)
      history[c][link] = row[c];
  }

  std::vector<std::size_t> LinkSet::alive_by_law() const
  {
    std::vector<std::size_t> found(laws(), 0);
    for (std::size_t l = 0; l < count; ++l)
      if (is_alive(l))
        ++found[kind_of_line(l)];
    return found;
  }

  void LinkSet::compact(const std::size_t particles)
  {
    LinkSet kept                = empty_like();
    kept.alive                  = alive;
    std::vector<std::size_t> to = kept.resize_by_law(alive_by_law(), particles);
    for (std::size_t l = 0; l < count; ++l)
      if (is_alive(l))
        kept.copy_line(*this, l, to[kind_of_line(l)]++);
    for (const auto &account : accounts)
      {
        kept.accounts[0].friction += account.friction;
        kept.accounts[0].damage += account.damage;
        kept.accounts[0].released += account.released;
        kept.accounts[0].viscous += account.viscous;
      }
    kept.tabulate(particles);
    *this = std::move(kept);
  }

  std::vector<std::int32_t>
  ends_of(const LinkSet &links, const std::vector<LinkPart> &parts, const std::size_t particles)
  {
    std::vector<std::int32_t> ends;
    for (const LinkPart &part : parts)
      for (std::size_t l = part.begin; l < part.end; ++l)
        for (const std::int32_t end : {links.first[l], links.second[l]})
          if (static_cast<std::size_t>(end) < particles)
            ends.push_back(end);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
  }

  void make_links(LinkSet                   &links,
                  std::vector<NeighbourPair> pairs,
                  Particles                 &particles,
                  const ParticleShape       &shape,
                  const LinkLaw             &law)
  {
    constexpr std::size_t at_once = std::size_t(1) << 18; // as many are read before their memory goes
    links.shape_for(law, particles.cell.repeats(), !particles.material.empty());
    links.alive                  = pairs.size();
    const auto pair_of_materials = [&](const NeighbourPair &each) {
      return links.several_pairs ? particles.pair_of(each.first, each.second) : 0;
    };
    std::vector<std::size_t> links_of_law(links.laws(), 0);
    for (const NeighbourPair &each : pairs)
      ++links_of_law[links.kind_of(pair_of_materials(each))];
    std::vector<std::size_t> next = links.resize_by_law(links_of_law, particles.count);
    std::vector<double>      row(links.history.size());
    std::size_t              read = 0;
    for (NeighbourPair &each : pairs)
      {
        const auto [J, K, shift] = each;
        const std::size_t l      = next[links.kind_of(pair_of_materials(each))]++;
        links.first[l]           = J;
        links.second[l]          = K;
        if (links.periodic)
          links.image[l] = particles.cell.enter(shift);
        if (links.several_pairs)
          links.pair[l] = pair_of_materials(each);
        NewLink fresh;
        fresh.distance      = branch_of(particles, links, l).norm();
        fresh.first_radius  = particles.radius_of(J);
        fresh.second_radius = particles.radius_of(K);
        const JointCut *cut = particles.cut_between(J, K);
        fresh.area          = cut != nullptr ? cut->area : shape.link_area(fresh.first_radius, fresh.second_radius);
        fresh.thickness     = shape.dimension == 3 ? 0 : shape.thickness;
        const auto mass     = [&](const std::int32_t i, const double radius) {
          return shape.denser(particles, static_cast<std::size_t>(i)) * shape.mass(radius);
        };
        const double first_mass = mass(J, fresh.first_radius), second_mass = mass(K, fresh.second_radius);
        fresh.effective_mass = first_mass * second_mass / (first_mass + second_mass);
        fresh.first_number   = particles.number[J];
        fresh.second_number  = particles.number[K];
        fresh.direction      = branch_of(particles, links, l).normalized();

        links.reference_length[l] = law.reference_length(links.pair_of(l), fresh);
        links.area[l]             = fresh.area;
        links.living[l]           = fresh.area > 0;
        std::fill(row.begin(), row.end(), 0.0);
        law.begin(links.pair_of(l), fresh, row.data());
        for (std::size_t c = 0; c < row.size(); ++c)
          if (row[c] != 0 ||
              std::signbit(row[c])) // zeros are there already, and take no memory as long as none is written
            links.history[c][l] = row[c];
        if (++read % at_once == 0)
          give_back(&each + 1 - at_once, &each + 1);
      }
    pairs = {};
    links.tabulate(particles.count);
  }

  void LinkSet::visit_state(base::StateVisitor &visitor, const std::string &name, const std::size_t particles)
  {
    auto counted = static_cast<std::int64_t>(count), alive_now = static_cast<std::int64_t>(alive);
    visitor.scalar(name + "/count", counted);
    visitor.scalar(name + "/alive", alive_now);
    count = static_cast<std::size_t>(counted);
    alive = static_cast<std::size_t>(alive_now);
    if (!kinds.empty())
      visitor.column(name + "/first_block", first_block);
    visitor.column(name + "/first", first);
    visitor.column(name + "/second", second);
    if (periodic)
      visitor.column(name + "/image", image);
    if (several_pairs)
      visitor.column(name + "/pair", pair);
    visitor.column(name + "/reference_length", reference_length);
    visitor.column(name + "/area", area);
    if (!in_parts)
      find_living();
    if (logs_breaks)
      visitor.column(name + "/noted", noted);
    for (std::size_t c = 0; c < history.size(); ++c)
      visitor.column(name + "/" + quantities[c].name, history[c]);
    visitor.column(name + "/force", force);
    if (moments_apart)
      visitor.column(name + "/moment", moment);

    base::Column sums(3 * accounts.size());
    for (std::size_t b = 0; b < accounts.size(); ++b)
      {
        sums[3 * b]     = accounts[b].friction;
        sums[3 * b + 1] = accounts[b].damage;
        sums[3 * b + 2] = accounts[b].released;
      }
    visitor.column(name + "/sums", sums);
    accounts.resize(sums.size() / 3);
    for (std::size_t b = 0; b < accounts.size(); ++b)
      {
        accounts[b].friction = sums[3 * b];
        accounts[b].damage   = sums[3 * b + 1];
        accounts[b].released = sums[3 * b + 2];
      }
    if (viscous)
      {
        base::Column lost;
        for (const LinkBlockAccount &account : accounts)
          lost.push_back(account.viscous);
        visitor.column(name + "/viscous", lost);
        for (std::size_t b = 0; b < accounts.size(); ++b)
          accounts[b].viscous = lost.at(b);
      }
    if (periodic)
      stress_moments.assign(stress_record * accounts.size(), 0.0); // of the step to come
    if (in_parts)
      return; // states of parts are only written
    padding = static_cast<std::size_t>(std::count(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(count),
                                                  static_cast<std::int32_t>(particles)));
    tabulate(particles);
  }
} // namespace dem
