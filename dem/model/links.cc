#include "dem/model/links.h"

#include "dem/core/streaming.h"
#include "dem/model/materials.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    std::size_t round_up(const std::size_t n, const std::size_t unit) { return (n + unit - 1) / unit * unit; }
  } // namespace

  std::size_t LinkSet::bytes() const
  {
    std::size_t doubles = 0;
    for (const base::Column *column : {&reference_length, &area, &force, &moment, &stress_moments})
      doubles += column->capacity();
    for (const base::Column &column : history)
      doubles += column.capacity();
    std::size_t integers = 0;
    for (const auto *column : {&first, &second, &image, &pair, &noted, &own_begin, &other_begin, &others})
      integers += column->capacity();
    return doubles * sizeof(double) + integers * sizeof(std::int32_t) + accounts.capacity() * sizeof(LinkBlockAccount);
  }

  void LinkSet::shape_for(const LinkLaw &links_law, const bool in_cell, const bool several_materials)
  {
    periodic      = in_cell;
    several_pairs = several_materials;
    has_moment    = links_law.has_moment();
    logs_breaks   = links_law.breaks_in_place();
    quantities    = links_law.columns();
    history.resize(quantities.size());
  }

  LinkSet LinkSet::empty_like() const
  {
    LinkSet other;
    other.periodic      = periodic;
    other.several_pairs = several_pairs;
    other.has_moment    = has_moment;
    other.logs_breaks   = logs_breaks;
    other.quantities    = quantities;
    other.history.resize(quantities.size());
    return other;
  }

  void LinkSet::resize(const std::size_t n, const std::size_t particles)
  {
    count                   = n;
    const std::size_t lines = round_up(n, links_per_block);
    first.resize(lines);
    second.resize(lines);
    std::fill(first.begin() + n, first.end(), static_cast<std::int32_t>(particles));
    std::fill(second.begin() + n, second.end(), static_cast<std::int32_t>(particles + 1));
    if (periodic)
      {
        image.resize(lines);
        std::fill(image.begin() + n, image.end(), 0);
        stress_moments.assign(stress_record * std::max<std::size_t>(lines / links_per_block, 1), 0.0);
      }
    if (several_pairs)
      {
        pair.resize(lines);
        std::fill(pair.begin() + n, pair.end(), 0);
      }
    if (logs_breaks)
      {
        noted.resize(lines);
        std::fill(noted.begin() + n, noted.end(), 0);
      }
    reference_length.resize(lines);
    std::fill(reference_length.begin() + n, reference_length.end(), 1.0);
    area.resize(lines);
    std::fill(area.begin() + n, area.end(), 0.0);
    for (base::Column &column : history)
      {
        column.resize(lines);
        std::fill(column.begin() + n, column.end(), 0.0);
      }
    force.assign(record_size * lines, 0.0);
    if (has_moment)
      moment.assign(half_record_size * lines, 0.0);
    accounts.resize(std::max<std::size_t>(lines / links_per_block, 1));
    streams = sizeof(double) * force.size() > last_level_cache();
  }

  void LinkSet::tabulate(const std::size_t particles)
  {
    own_begin.assign(particles + 1, 0);
    other_begin.assign(particles + 1, 0);
    for (std::size_t l = 0; l < count; ++l)
      {
        ++own_begin[first[l] + 1];
        ++other_begin[second[l] + 1];
      }
    for (std::size_t i = 0; i < particles; ++i)
      {
        own_begin[i + 1] += own_begin[i];
        other_begin[i + 1] += other_begin[i];
      }
    others.resize(count);
    std::vector<std::int32_t> next(other_begin.begin(), other_begin.end() - 1);
    for (std::size_t l = 0; l < count; ++l)
      others[next[second[l]]++] = static_cast<std::int32_t>(l);
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
    for (std::size_t c = 0; c < history.size(); ++c)
      history[c][to] = source.history[c][from];
    std::copy_n(&source.force[record_size * from], record_size, &force[record_size * to]);
    if (has_moment)
      std::copy_n(&source.moment[half_record_size * from], half_record_size, &moment[half_record_size * to]);
  }

  void LinkSet::remove(const std::size_t link)
  {
    area[link] = 0.0;
    std::fill_n(&force[record_size * link], record_size, 0.0);
    if (has_moment)
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

  void LinkSet::compact(const std::size_t particles)
  {
    LinkSet kept = empty_like();
    kept.alive   = alive;
    kept.resize(alive, particles);
    std::size_t to = 0;
    for (std::size_t l = 0; l < count; ++l)
      if (is_alive(l))
        kept.copy_line(*this, l, to++);
    for (const auto &account : accounts)
      {
        kept.accounts[0].friction += account.friction;
        kept.accounts[0].damage += account.damage;
        kept.accounts[0].released += account.released;
      }
    kept.tabulate(particles);
    *this = std::move(kept);
  }

  Eigen::Vector3d branch_of(const Particles &particles, const LinkSet &links, const std::size_t link)
  {
    const Eigen::Vector3d branch = particles.position_of(links.second[link]) - particles.position_of(links.first[link]);
    return links.periodic ? Eigen::Vector3d(branch + particles.cell.offset_of(links.image[link])) : branch;
  }

  void make_links(LinkSet                          &links,
                  const std::vector<NeighbourPair> &pairs,
                  Particles                        &particles,
                  const ParticleShape              &shape,
                  const LinkLaw                    &law)
  {
    links.shape_for(law, particles.cell.repeats(), !particles.material.empty());
    links.alive = pairs.size();
    links.resize(pairs.size(), particles.count);
    std::vector<double> row(links.history.size());
    for (std::size_t l = 0; l < pairs.size(); ++l)
      {
        const auto [J, K, shift] = pairs[l];
        links.first[l]           = J;
        links.second[l]          = K;
        if (links.periodic)
          links.image[l] = particles.cell.enter(shift);
        if (links.several_pairs)
          links.pair[l] = material_pair(particles.material[J], particles.material[K]);
        NewLink fresh;
        fresh.distance      = branch_of(particles, links, l).norm();
        fresh.first_radius  = particles.radius_of(J);
        fresh.second_radius = particles.radius_of(K);
        fresh.area          = shape.link_area(fresh.first_radius, fresh.second_radius);
        fresh.thickness     = shape.dimension == 3 ? 0 : shape.thickness;
        fresh.first_number  = particles.number[J];
        fresh.second_number = particles.number[K];
        fresh.direction     = branch_of(particles, links, l).normalized();

        links.reference_length[l] = law.reference_length(fresh);
        links.area[l]             = fresh.area;
        std::fill(row.begin(), row.end(), 0.0);
        law.begin(links.pair_of(l), fresh, row.data());
        links.set_history(l, row);
      }
    links.tabulate(particles.count);
  }

  void LinkSet::visit_state(base::StateVisitor &visitor, const std::string &name, const std::size_t particles)
  {
    auto counted = static_cast<std::int64_t>(count), living = static_cast<std::int64_t>(alive);
    visitor.scalar(name + "/count", counted);
    visitor.scalar(name + "/alive", living);
    count = static_cast<std::size_t>(counted);
    alive = static_cast<std::size_t>(living);
    visitor.column(name + "/first", first);
    visitor.column(name + "/second", second);
    if (periodic)
      visitor.column(name + "/image", image);
    if (several_pairs)
      visitor.column(name + "/pair", pair);
    visitor.column(name + "/reference_length", reference_length);
    visitor.column(name + "/area", area);
    if (logs_breaks)
      visitor.column(name + "/noted", noted);
    for (std::size_t c = 0; c < history.size(); ++c)
      visitor.column(name + "/" + quantities[c].name, history[c]);
    visitor.column(name + "/force", force);
    if (has_moment)
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
    if (periodic)
      stress_moments.assign(stress_record * accounts.size(), 0.0); // of the step to come
    tabulate(particles);
  }
} // namespace dem
