#include "dem/contacts/contact_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
  double gap(const Particles &particles, const std::int32_t first, const std::int32_t second)
  {
    return (particles.position_of(second) - particles.position_of(first)).norm() - particles.radius_of(first) -
           particles.radius_of(second);
  }

  bool joined(const LinkSet &links, const std::int32_t first, const std::int32_t second)
  {
    if (links.count == 0)
      return false;
    for (std::int32_t l = links.own_begin[first]; l < links.own_begin[first + 1]; ++l)
      if (links.second[l] == second && links.is_alive(l))
        return true;
    return false;
  }

  ContactSearch::ContactSearch(const Particles &particles, const double start_margin)
    : reference(particles.reference)
    , margin(start_margin)
    , list_margin(0)
    , next_look(0.5 * start_margin)
  {
    // Lists that reach a quarter of the mean radius are short, and last for many steps of a body that breaks.
    for (std::size_t i = 0; i < particles.count; ++i)
      list_margin += 0.25 * particles.radius_of(i) / static_cast<double>(particles.count);
  }

  bool ContactSearch::moved(const double largest)
  {
    path += largest;
    path_of_list += largest;
    return path >= next_look;
  }

  void ContactSearch::watch(const Particles &particles, const std::int32_t first, const std::int32_t second)
  {
    watched.push_back(first);
    watched.push_back(second);
    next_look = std::min(next_look, path + 0.5 * gap(particles, first, second));
  }

  double ContactSearch::largest_displacement(const Particles &particles) const
  {
    double squared = 0;
    for (std::size_t i = 0; i < particles.count; ++i)
      squared = std::max(squared, (particles.position_of(i) - Eigen::Vector3d(&reference[3 * i])).squaredNorm());
    return std::sqrt(squared);
  }

  void ContactSearch::rebuild(const Particles &particles, const LinkSet &bonds, const LinkSet &contacts)
  {
    std::vector<Eigen::Vector3d> centre(particles.count);
    std::vector<double>          radius(particles.count);
    for (std::size_t i = 0; i < particles.count; ++i)
      {
        centre[i] = particles.position_of(i);
        radius[i] = particles.radius_of(i);
        std::copy_n(centre[i].data(), 3, &reference[3 * i]);
      }
    watched.clear();
    for (const auto &pair : find_pairs(centre, radius, 1.0, list_margin, std::nullopt))
      if (!joined(bonds, pair.first, pair.second) && !joined(contacts, pair.first, pair.second))
        {
          watched.push_back(pair.first);
          watched.push_back(pair.second);
        }
    margin       = list_margin;
    path_of_list = 0;
    ++neighbour_searches;
  }

  std::vector<NeighbourPair>
  ContactSearch::look(const Particles &particles, const LinkSet &bonds, const LinkSet &contacts)
  {
    if (2 * path_of_list >= margin)
      {
        // The sum of largest steps overrates displacement (different particles, there and back): measure it before searching.
        path_of_list = largest_displacement(particles);
        if (2 * path_of_list >= 0.8 * margin)
          rebuild(particles, bonds, contacts);
      }
    std::vector<NeighbourPair> born;
    std::vector<std::int32_t>  apart;
    double                     smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < watched.size(); i += 2)
      {
        const std::int32_t J = watched[i], K = watched[i + 1];
        const double       distance = gap(particles, J, K);
        if (distance < 0)
          born.push_back({J, K, {0, 0, 0}});
        else
          {
            apart.insert(apart.end(), {J, K});
            smallest = std::min(smallest, distance);
          }
      }
    watched   = std::move(apart);
    next_look = path + std::min(0.5 * smallest, 0.5 * margin - path_of_list);
    std::sort(born.begin(), born.end());
    born.erase(std::unique(born.begin(), born.end()), born.end());
    return born;
  }

  void ContactSearch::visit_state(StateVisitor &visitor)
  {
    visitor.column("contact_search/watched", watched);
    visitor.column("contact_search/reference", reference);
    visitor.scalar("contact_search/margin", margin);
    visitor.scalar("contact_search/path", path);
    visitor.scalar("contact_search/path_of_list", path_of_list);
    visitor.scalar("contact_search/next_look", next_look);
    visitor.scalar("contact_search/searches", neighbour_searches);
  }

  void add_contacts(LinkSet                          &contacts,
                    const std::vector<NeighbourPair> &born,
                    const Particles                  &particles,
                    const ParticleShape              &shape)
  {
    LinkSet fresh;
    make_links(fresh, born, particles, shape, false);
    LinkSet merged;
    merged.shear_components = contacts.shear_components;
    merged.alive            = contacts.alive + born.size();
    merged.resize(merged.alive, particles.count, false);
    for (const auto &account : contacts.accounts)
      merged.accounts[0].plastic_work += account.plastic_work;

    const auto before = [](const LinkSet &a, const std::size_t i, const LinkSet &b, const std::size_t j) {
      return a.first[i] != b.first[j] ? a.first[i] < b.first[j] : a.second[i] < b.second[j];
    };
    std::size_t to = 0, next = 0;
    for (std::size_t old = 0; old < contacts.count; ++old)
      if (contacts.is_alive(old))
        {
          while (next < fresh.count && before(fresh, next, contacts, old))
            merged.copy_line(fresh, next++, to++);
          merged.copy_line(contacts, old, to++);
        }
    while (next < fresh.count)
      merged.copy_line(fresh, next++, to++);
    std::fill_n(merged.damage.begin(), merged.count, 1.0);
    merged.tabulate(particles.count);
    contacts = std::move(merged);
  }
} // namespace dem
