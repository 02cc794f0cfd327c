#include "dem/links.h"

#include "dem/laws/cpm_table.h"

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
    for (const Column *column : {&reference_length, &area, &kappa, &damage, &force, &stress_moments})
      doubles += column->capacity();
    for (int i = 0; i < 3; ++i)
      doubles += elastic_shear[i].capacity() + total_shear[i].capacity();
    std::size_t integers = 0;
    for (const auto *column : {&first, &second, &image, &law, &own_begin, &other_begin, &others})
      integers += column->capacity();
    return doubles * sizeof(double) + integers * sizeof(std::int32_t) + accounts.capacity() * sizeof(LinkBlockAccount);
  }

  void LinkSet::resize(const std::size_t n, const std::size_t particles, const bool with_total_shear)
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
    if (several_laws)
      {
        law.resize(lines);
        std::fill(law.begin() + n, law.end(), 0);
      }
    reference_length.resize(lines);
    std::fill(reference_length.begin() + n, reference_length.end(), 1.0);
    for (Column *column : {&area, &kappa, &damage})
      {
        column->resize(lines);
        std::fill(column->begin() + n, column->end(), 0.0);
      }
    for (int i = 0; i < shear_components; ++i)
      {
        elastic_shear[i].resize(lines);
        std::fill(elastic_shear[i].begin() + n, elastic_shear[i].end(), 0.0);
        if (with_total_shear)
          {
            total_shear[i].resize(lines);
            std::fill(total_shear[i].begin() + n, total_shear[i].end(), 0.0);
          }
      }
    force.assign(record_size * lines, 0.0);
    accounts.resize(std::max<std::size_t>(lines / links_per_block, 1));
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
    if (several_laws)
      law[to] = source.law[from];
    reference_length[to] = source.reference_length[from];
    area[to]             = source.area[from];
    kappa[to]            = source.kappa[from];
    damage[to]           = source.damage[from];
    for (int i = 0; i < shear_components; ++i)
      {
        elastic_shear[i][to] = source.elastic_shear[i][from];
        if (!total_shear[i].empty())
          total_shear[i][to] = source.total_shear[i][from];
      }
    std::copy_n(&source.force[record_size * from], record_size, &force[record_size * to]);
  }

  void LinkSet::remove(const std::size_t link)
  {
    area[link] = 0.0;
    std::fill_n(&force[record_size * link], record_size, 0.0);
    --alive;
  }

  void LinkSet::compact(const std::size_t particles)
  {
    LinkSet kept;
    kept.shear_components = shear_components;
    kept.periodic         = periodic;
    kept.several_laws     = several_laws;
    kept.alive            = alive;
    kept.resize(alive, particles, !total_shear[0].empty());
    std::size_t to = 0;
    for (std::size_t l = 0; l < count; ++l)
      if (is_alive(l))
        kept.copy_line(*this, l, to++);
    for (const auto &account : accounts)
      {
        kept.accounts[0].plastic_work += account.plastic_work;
        kept.accounts[0].damage_work += account.damage_work;
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
                  const bool                        with_total_shear)
  {
    links.shear_components = shape.dimension == 3 ? 3 : 1;
    links.periodic         = particles.cell.repeats();
    links.several_laws     = !particles.material.empty();
    links.alive            = pairs.size();
    links.resize(pairs.size(), particles.count, with_total_shear);
    for (std::size_t l = 0; l < pairs.size(); ++l)
      {
        const auto [J, K, shift] = pairs[l];
        links.first[l]           = J;
        links.second[l]          = K;
        if (links.periodic)
          links.image[l] = particles.cell.enter(shift);
        if (links.several_laws)
          links.law[l] = CpmTable::pair(particles.material[J], particles.material[K]);
        links.reference_length[l] = branch_of(particles, links, l).norm();
        links.area[l]             = shape.link_area(particles.radius_of(J), particles.radius_of(K));
      }
    links.tabulate(particles.count);
  }

  void LinkSet::visit_state(StateVisitor &visitor, const std::string &name, const std::size_t particles)
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
    if (several_laws)
      visitor.column(name + "/law", law);
    visitor.column(name + "/reference_length", reference_length);
    visitor.column(name + "/area", area);
    visitor.column(name + "/kappa", kappa);
    visitor.column(name + "/damage", damage);
    for (int i = 0; i < shear_components; ++i)
      {
        visitor.column(name + "/elastic_shear_" + std::to_string(i), elastic_shear[i]);
        if (!total_shear[i].empty())
          visitor.column(name + "/total_shear_" + std::to_string(i), total_shear[i]);
      }
    visitor.column(name + "/force", force);

    Column sums(2 * accounts.size());
    for (std::size_t b = 0; b < accounts.size(); ++b)
      {
        sums[2 * b]     = accounts[b].plastic_work;
        sums[2 * b + 1] = accounts[b].damage_work;
      }
    visitor.column(name + "/sums", sums);
    accounts.resize(sums.size() / 2);
    for (std::size_t b = 0; b < accounts.size(); ++b)
      {
        accounts[b].plastic_work = sums[2 * b];
        accounts[b].damage_work  = sums[2 * b + 1];
      }
    if (periodic)
      stress_moments.assign(stress_record * accounts.size(), 0.0); // of the step to come
    tabulate(particles);
  }
} // namespace dem
