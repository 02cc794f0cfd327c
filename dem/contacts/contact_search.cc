#include "dem/contacts/contact_search.h"

#include "dem/contacts/particle_pairs.h"
#include "dem/neighbours/tie.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>
#include <limits>
#include <tuple>

namespace dem
{
  double gap(const Particles &particles, const std::array<std::int32_t, 3> &pair)
  {
    const auto [first, second, image] = pair;
    Eigen::Vector3d branch            = particles.position_of(second) - particles.position_of(first);
    if (image != 0)
      branch += particles.cell.offset_of(image);
    return branch.norm() - particles.radius_of(first) - particles.radius_of(second);
  }

  bool joined(const LinkSet &links, const std::array<std::int32_t, 3> &pair)
  {
    if (links.count == 0)
      return false;
    const auto [first, second, image] = pair;
    for (std::int32_t o = links.own_begin[first]; o < links.own_begin[first + 1]; ++o)
      if (const std::size_t l = links.own(o);
          links.second[l] == second && (!links.periodic || links.image[l] == image) && links.is_alive(l))
        return true;
    return false;
  }

  ContactSearch::ContactSearch(const Particles &particles, const double start_margin, const bool waits)
    : contacts_wait(waits)
    , reference(particles.reference)
    , margin(start_margin)
    , list_margin(0)
    , largest_diameter(0)
    , next_update(0.5 * start_margin)
  {
    for (std::size_t i = 0; i < particles.count; ++i)
      largest_diameter = std::max(largest_diameter, 2 * particles.radius_of(i));
    if (particles.cell.repeats())
      reference_base.assign(particles.cell.base().data(), particles.cell.base().data() + 9);
    // Lists that reach a quarter of the mean radius are short, and last for many steps of a body that breaks. Contacts that wait cost
    // time in every step.
    const double part = contacts_wait ? 0.18 : 0.25;
    for (std::size_t i = 0; i < particles.count; ++i)
      list_margin += part * particles.radius_of(i) / static_cast<double>(particles.count);
  }

  bool ContactSearch::moved(const double largest, const double strain)
  {
    const double closer = largest + 0.5 * strain * reach();
    path += closer;
    path_of_list += closer;
    return path >= next_update;
  }

  void ContactSearch::watch(const Particles &particles, const std::array<std::int32_t, 3> &pair)
  {
    watched.insert(watched.end(), pair.begin(), pair.end());
    next_update = std::min(next_update, contacts_wait ? path : path + 0.5 * watched_gap(particles, pair));
  }

  bool ContactSearch::is_near(const Particles &particles, const std::array<std::int32_t, 3> &pair) const
  {
    return gap(particles, pair) < list_margin + 2 * tie * (largest_diameter + list_margin);
  }

  /** A wider gap first has to close to what `reach` allows for; only a cell's strain cares. */
  double ContactSearch::watched_gap(const Particles &particles, const std::array<std::int32_t, 3> &pair) const
  {
    const double distance = gap(particles, pair);
    return particles.cell.repeats() ? std::min(distance, std::max(margin, list_margin)) : distance;
  }

  double ContactSearch::largest_displacement(const Particles &particles, const SharedSearch &search) const
  {
    double          squared = 0, by_strain = 0;
    Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();
    if (particles.cell.repeats())
      {
        const Eigen::Matrix3d before = Eigen::Map<const Eigen::Matrix3d>(reference_base.data());
        stretch                      = particles.cell.base() * before.inverse();
        const double shrinkage       = 1.0 - Eigen::JacobiSVD<Eigen::Matrix3d>(stretch).singularValues()[2];
        by_strain                    = 0.5 * std::max(shrinkage, 0.0) * reach();
      }
    for (auto i = static_cast<std::size_t>(kept.begin); i < known_end(particles); ++i)
      squared =
        std::max(squared, (particles.position_of(i) - stretch * Eigen::Vector3d(&reference[3 * i])).squaredNorm());
    return std::sqrt(search.largest(squared)) + by_strain;
  }

  namespace
  {
    /** Let the cell know the images that pairs reach to, in the order in which one rank comes upon them. */
    void enter_images(Cell &cell, const std::vector<NeighbourPair> &pairs, const SharedSearch &search)
    {
      std::vector<NeighbourPair> found; // each image once
      for (const NeighbourPair &pair : pairs)
        if (std::none_of(found.begin(), found.end(),
                         [&](const NeighbourPair &other) { return other.shift == pair.shift; }))
          found.push_back({0, 0, pair.shift});
      for (const NeighbourPair &image : search.of_all(std::move(found)))
        cell.enter(image.shift);
    }
  } // namespace

  void ContactSearch::rebuild(Particles          &particles,
                              const LinkSet      &bonds,
                              const LinkSet      &contacts,
                              const SharedSearch &search)
  {
    for (auto i = static_cast<std::size_t>(kept.begin); i < known_end(particles); ++i)
      std::copy_n(particles.pose_of(i), 3, &reference[3 * i]);
    if (particles.cell.repeats())
      reference_base.assign(particles.cell.base().data(), particles.cell.base().data() + 9);
    std::vector<NeighbourPair> pairs = particle_pairs(particles, 1.0, list_margin, search.own());
    search.drop_others(pairs);
    if (particles.cell.repeats())
      enter_images(particles.cell, pairs, search);
    const auto flat = [&](const NeighbourPair &pair) -> std::array<std::int32_t, 3> {
      return {pair.first, pair.second, particles.cell.repeats() ? particles.cell.enter(pair.shift) : 0};
    };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [&](const NeighbourPair &pair) {
                                 return particles.in_one_body(pair.first, pair.second) ||
                                        particles.cut_between(pair.first, pair.second) != nullptr ||
                                        joined(bonds, flat(pair)) || joined(contacts, flat(pair));
                               }),
                pairs.end());
    watched.clear();
    for (const NeighbourPair &pair : search.of_all(std::move(pairs)))
      {
        const std::array<std::int32_t, 3> numbers = flat(pair);
        watched.insert(watched.end(), numbers.begin(), numbers.end());
      }
    margin       = list_margin - tie * (largest_diameter + list_margin); // nearer than that, none is left out
    path_of_list = 0;
    ++neighbour_searches;
  }

  std::vector<NeighbourPair> ContactSearch::find_contacts(Particles          &particles,
                                                          const LinkSet      &bonds,
                                                          const LinkSet      &contacts,
                                                          const SharedSearch &search)
  {
    if (2 * path_of_list >= margin)
      {
        // The sum of largest steps overrates displacement (different particles, there and back): measure it before searching.
        path_of_list = largest_displacement(particles, search);
        if (2 * path_of_list >= 0.8 * margin)
          rebuild(particles, bonds, contacts, search);
      }
    std::vector<NeighbourPair> born;
    std::vector<std::int32_t>  apart;
    double                     smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < watched.size(); i += 3)
      {
        const std::array<std::int32_t, 3> pair = {watched[i], watched[i + 1], watched[i + 2]};
        if (particles.in_one_body(pair[0], pair[1])) // since it was watched for
          continue;
        const double distance = watched_gap(particles, pair);
        if (distance < 0 || contacts_wait)
          born.push_back({pair[0], pair[1], pair[2] == 0 ? CellShift{{0, 0, 0}} : particles.cell.shift_of(pair[2])});
        else
          {
            apart.insert(apart.end(), pair.begin(), pair.end());
            smallest = std::min(smallest, distance);
          }
      }
    watched     = std::move(apart);
    next_update = path + std::min(0.5 * smallest, 0.5 * margin - path_of_list);
    std::sort(born.begin(), born.end());
    born.erase(std::unique(born.begin(), born.end()), born.end());
    return born;
  }

  void ContactSearch::visit_state(base::StateVisitor &visitor)
  {
    visitor.column("contact_search/watched", watched);
    visitor.column("contact_search/reference", reference);
    if (!reference_base.empty())
      visitor.column("contact_search/reference_base", reference_base);
    visitor.scalar("contact_search/margin", margin);
    visitor.scalar("contact_search/path", path);
    visitor.scalar("contact_search/path_of_list", path_of_list);
    visitor.scalar("contact_search/next_look", next_update);
    visitor.scalar("contact_search/searches", neighbour_searches);
  }

  void add_contacts(LinkSet                          &contacts,
                    const std::vector<NeighbourPair> &born,
                    Particles                        &particles,
                    const ParticleShape              &shape,
                    const LinkLaw                    &law)
  {
    LinkSet fresh;
    make_links(fresh, born, particles, shape, law);
    LinkSet merged = fresh.empty_like();
    merged.alive   = contacts.alive + born.size();

    std::vector<std::size_t> links_of_law = fresh.alive_by_law();
    for (std::size_t l = 0; l < contacts.count; ++l)
      if (contacts.is_alive(l))
        ++links_of_law[contacts.kind_of_line(l)];
    std::vector<std::size_t> to = merged.resize_by_law(links_of_law, particles.count);
    for (const auto &account : contacts.accounts)
      {
        merged.accounts[0].friction += account.friction;
        merged.accounts[0].viscous += account.viscous;
      }

    const auto before = [](const LinkSet &a, const std::size_t i, const LinkSet &b, const std::size_t j) {
      return std::make_tuple(a.kind_of_line(i), a.first[i], a.second[i]) <
             std::make_tuple(b.kind_of_line(j), b.first[j], b.second[j]);
    };
    const auto take = [&](const LinkSet &source, const std::size_t line) {
      if (source.is_alive(line))
        merged.copy_line(source, line, to[source.kind_of_line(line)]++);
    };
    std::size_t next = 0;
    for (std::size_t old = 0; old < contacts.count; ++old)
      if (contacts.is_alive(old))
        {
          while (next < fresh.count && (!fresh.is_alive(next) || before(fresh, next, contacts, old)))
            take(fresh, next++);
          take(contacts, old);
        }
    while (next < fresh.count)
      take(fresh, next++);
    merged.tabulate(particles.count);
    contacts = std::move(merged);
  }
} // namespace dem
