#include "dem/integrators/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dem
{
  namespace
  {
    /** kappa_c of a link as the particle at its first or second end sees it [N/m]. */
    double stiffness_seen(const Particles  &p,
                          const LinkSet    &links,
                          const std::size_t l,
                          const bool        from_first,
                          const CpmTable   &laws,
                          const bool        rotations)
    {
      const std::int32_t J = links.first[l], K = links.second[l], i = from_first ? J : K;
      const double       eccentric = (p.radius_of(J) - p.radius_of(K)) * (from_first ? 1 : -1),
                   arm             = 0.5 * (branch_of(p, links, l).norm() + eccentric),
                   lever           = rotations ? p.mass[i] * arm * arm / p.inertia[i] : 0.0;
      const CpmConstants &law      = laws[links.law_of(l)];
      return links.area[l] / links.reference_length[l] * std::max(law.E, law.G * (1.0 + lever));
    }

    void add_stiffness(
      const Particles &p, const LinkSet &links, const CpmTable &laws, const bool rotations, std::vector<double> &sum)
    {
      for (std::size_t l = 0; l < links.count; ++l)
        if (links.is_alive(l))
          {
            sum[links.first[l]] += stiffness_seen(p, links, l, true, laws, rotations);
            sum[links.second[l]] += stiffness_seen(p, links, l, false, laws, rotations);
          }
    }

    /** Sum of kappa_c over one particle's links [N/m]. */
    double stiffness_around(
      const Particles &p, const LinkSet &links, const CpmTable &laws, const bool rotations, const std::int32_t i)
    {
      double sum = 0;
      for (std::int32_t l = links.own_begin[i]; l < links.own_begin[i + 1]; ++l)
        if (links.is_alive(l))
          sum += stiffness_seen(p, links, l, true, laws, rotations);
      for (std::int32_t o = links.other_begin[i]; o < links.other_begin[i + 1]; ++o)
        if (links.is_alive(links.others[o]))
          sum += stiffness_seen(p, links, links.others[o], false, laws, rotations);
      return sum;
    }
  } // namespace

  double stable_step(const Particles &particles,
                     const LinkSet   &bonds,
                     const LinkSet   *contacts,
                     const CpmTable  &laws,
                     const bool       rotations)
  {
    std::vector<double> sum(particles.count, 0.0);
    add_stiffness(particles, bonds, laws, rotations, sum);
    if (contacts)
      add_stiffness(particles, *contacts, laws, rotations, sum);
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < particles.count; ++i)
      if (sum[i] > 0)
        smallest = std::min(smallest, 2.0 * particles.mass[i] / sum[i]);
    return std::sqrt(smallest);
  }

  double stable_step_of(const Particles   &particles,
                        const LinkSet     &bonds,
                        const LinkSet     &contacts,
                        const CpmTable    &laws,
                        const bool         rotations,
                        const std::int32_t particle)
  {
    const double sum = stiffness_around(particles, bonds, laws, rotations, particle) +
                       stiffness_around(particles, contacts, laws, rotations, particle);
    return std::sqrt(2.0 * particles.mass[particle] / sum);
  }
} // namespace dem
