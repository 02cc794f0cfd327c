#include "dem/measures/link_measures.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace dem
{
  LinkLoad load_at(const Particles &particles, const LinkSet &links, const std::size_t link)
  {
    const std::size_t J = links.first[link], K = links.second[link];
    const LinkView    view = link_at(particles, links, link);
    const double      arm  = 0.5 * (view.length + particles.radius_of(J) - particles.radius_of(K));
    LinkLoad          load;
    load.first   = particles.position_of(J) - Eigen::Vector3d(&particles.motion[record_size * J]);
    load.branch  = view.length * view.direction;
    load.contact = load.first + arm * view.direction;
    load.force   = view.force;
    load.couple  = links.moment_of(link);
    return load;
  }

  void LinkReader::read(const std::size_t link, const Geometry at)
  {
    seen            = link_at(particles, links, link, at);
    place.strain    = seen.strain;
    place.length    = seen.length;
    place.reference = links.reference_length[link];
    place.area      = links.area[link];
    pair            = links.pair_of(link);
    links.get_history(link, row);
  }

  namespace
  {
    /** Work of a link's force and moment on the prescribed motion of its ends, with the sign of the work on the link. */
    double work_on(const Particles       &particles,
                   const LinkSet         &links,
                   const LinkView        &link,
                   const std::size_t      l,
                   const base::Column    &moves,
                   const Eigen::Vector3d &of_cell)
    {
      const std::int32_t J = links.first[l], K = links.second[l];
      const auto         moved = [&](const std::int32_t i, const int c) {
        return Eigen::Vector3d(&moves[record_size * static_cast<std::size_t>(i) + static_cast<std::size_t>(c)]);
      };
      const Eigen::Vector3d opening   = moved(K, 0) - moved(J, 0) + of_cell;
      const double          eccentric = particles.radius_of(J) - particles.radius_of(K);
      const Eigen::Vector3d arms =
        0.5 * ((link.length + eccentric) * moved(J, 3) + (link.length - eccentric) * moved(K, 3));
      double work = link.force.dot(opening) - link.direction.cross(link.force).dot(arms);
      if (links.has_moment)
        work += links.moment_of(l).dot(moved(K, 3) - moved(J, 3));
      return work;
    }

    /** Of the living among some lines, what value(reader, link) says of each, added in their order. */
    template <typename Value>
    void add_of_living(const Particles &particles,
                       const LinkSet   &links,
                       const LinkLaw   &law,
                       const LinkRange &lines,
                       double          &sum,
                       const Value     &value)
    {
      LinkReader reader(particles, links, law);
      each_living(links, lines, [&](const std::size_t l) {
        reader.read(l);
        sum += value(reader, l);
      });
    }
  } // namespace

  double work_not_taken_up(const Particles &particles, const LinkSet &links, const LinkView &link, const std::size_t l)
  {
    const Eigen::Vector3d of_cell =
      links.periodic ? particles.cell.motion_of(links.image[l]) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    return 0.5 * work_on(particles, links, link, l, particles.motion, of_cell);
  }

  double power_of_ends(const Particles &particles, const LinkSet &links)
  {
    double power = 0;
    for (std::size_t l = 0; l < links.count; ++l)
      if (links.is_alive(l))
        power +=
          work_on(particles, links, link_at(particles, links, l), l, particles.velocity, Eigen::Vector3d::Zero());
    return power;
  }

  double elastic_energy(const Particles &particles, const LinkSet &links, const LinkLaw &law)
  {
    double sum = 0;
    add_elastic_energy(particles, links, law, all_lines(links), sum);
    return sum;
  }

  void add_elastic_energy(
    const Particles &particles, const LinkSet &links, const LinkLaw &law, const LinkRange &lines, double &sum)
  {
    add_of_living(particles, links, law, lines, sum, [](LinkReader &reader, std::size_t) { return reader.stored(); });
  }

  double energy_of_strain(const Particles &particles, const LinkSet &links, const LinkLaw &law, const double strain)
  {
    double sum = 0;
    add_of_living(particles, links, law, all_lines(links), sum, [&](LinkReader &reader, const std::size_t l) {
      return 0.5 * links.area[l] * links.reference_length[l] * reader.closed_stiffness().normal * strain * strain;
    });
    return sum;
  }

  double summed_damage(const LinkSet &links)
  {
    double sum = 0;
    for (const auto &account : links.accounts)
      sum += account.damage;
    return sum;
  }

  void add_energies(
    const Particles &particles, const LinkSet &links, const LinkLaw &law, const LinkRange &lines, LinkEnergies &sums)
  {
    LinkReader reader(particles, links, law);
    each_living(links, lines, [&](const std::size_t l) {
      reader.read(l);
      sums[0] += reader.stored();
      sums[1] += reader.damage_dissipation();
    });
  }

  double plastic_dissipation(const LinkSet &links)
  {
    double sum = 0;
    for (const auto &account : links.accounts)
      sum += account.friction;
    return sum;
  }

  double viscous_dissipation(const LinkSet &links)
  {
    double sum = 0;
    for (const auto &account : links.accounts)
      sum += account.viscous;
    return sum;
  }

  double released_in_place(const LinkSet &links)
  {
    double sum = 0;
    for (const auto &account : links.accounts)
      sum += account.released;
    return sum;
  }
} // namespace dem
