#include "dem/measures/link_measures.h"

#include <algorithm>

namespace dem
{
  LinkView link_at(const Particles &particles, const LinkSet &links, const std::size_t link, const Geometry geometry)
  {
    const std::size_t J = links.first[link], K = links.second[link];
    const auto        moved = [&](const std::size_t i) { return Eigen::Vector3d(&particles.motion[record_size * i]); };
    LinkView          view;
    view.direction = branch_of(particles, links, link);
    if (geometry == Geometry::before_motion)
      {
        view.direction -= moved(K) - moved(J);
        if (links.periodic)
          view.direction -= particles.cell.motion_of(links.image[link]);
      }
    view.length = view.direction.norm();
    view.direction /= view.length;
    view.strain = (view.length - links.reference_length[link]) / links.reference_length[link];
    view.force  = Eigen::Vector3d(&links.force[record_size * link]);
    return view;
  }

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
    return load;
  }

  double elastic_energy(const Particles  &particles,
                        const LinkSet    &links,
                        const std::size_t link,
                        const CpmTable   &laws,
                        const Geometry    geometry)
  {
    const CpmConstants &law    = laws[links.law_of(link)];
    const double        strain = link_at(particles, links, link, geometry).strain;
    double              shear2 = 0;
    for (int c = 0; c < links.shear_components; ++c)
      shear2 += links.elastic_shear[c][link] * links.elastic_shear[c][link];
    const double normal = strain > 0 ? (1.0 - links.damage[link]) * law.E : law.E;
    return 0.5 * links.area[link] * links.reference_length[link] * (normal * strain * strain + law.G * shear2);
  }

  double elastic_energy(const Particles &particles, const LinkSet &links, const CpmTable &laws)
  {
    double sum = 0;
    for (std::size_t l = 0; l < links.count; ++l)
      if (links.is_alive(l))
        sum += elastic_energy(particles, links, l, laws);
    return sum;
  }

  double damage_dissipation(const LinkSet &links, const std::size_t link, const CpmTable &laws)
  {
    const CpmConstants &law = laws[links.law_of(link)];
    if (law.shear_weight > 0)
      return 0.0;
    return links.area[link] * links.reference_length[link] * law.dissipated_at(links.kappa[link], links.damage[link]);
  }

  double damage_dissipation(const LinkSet &links, const CpmTable &laws)
  {
    double sum = 0;
    for (const auto &account : links.accounts)
      sum += account.damage_work;
    for (std::size_t l = 0; l < links.count; ++l)
      if (links.is_alive(l))
        sum += damage_dissipation(links, l, laws);
    return sum;
  }

  double plastic_dissipation(const LinkSet &links)
  {
    double sum = 0;
    for (const auto &account : links.accounts)
      sum += account.plastic_work;
    return sum;
  }

  void add_stress_moments(const Particles &particles, const LinkSet &links, std::vector<Eigen::Matrix3d> &moments)
  {
    for (std::size_t l = 0; l < links.count; ++l)
      {
        if (!links.is_alive(l))
          continue;
        const LinkView    view = link_at(particles, links, l);
        const std::size_t J = links.first[l], K = links.second[l];
        const double      eccentric = particles.radius_of(J) - particles.radius_of(K);
        const auto        moment    = view.direction * view.force.transpose();
        moments[J] += 0.5 * (view.length + eccentric) * moment;
        moments[K] += 0.5 * (view.length - eccentric) * moment; // both arm and force change sign
      }
  }
} // namespace dem
