#include "dem/integrators/stable_step.h"

#include "dem/measures/link_measures.h"
#include "dem/model/held_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dem
{
  namespace
  {
    /** kappa_c of links as the particle at their first or second end sees them. */
    class StiffnessSeen
    {
    public:
      StiffnessSeen(const Particles &particles, const LawfulLinks &of, const bool particles_rotate, const double ahead_)
        : p(particles)
        , ahead(ahead_)
        , links(of.links)
        , rotations(particles_rotate)
        , has_moment(of.law.has_moment())
        , reader(particles, of.links, of.law)
      {
      }

      /** [N/m] */
      double operator()(const std::size_t l, const bool from_first)
      {
        const std::int32_t J = links.first[l], K = links.second[l], i = from_first ? J : K;
        const double       eccentric = (p.radius_of(J) - p.radius_of(K)) * (from_first ? 1 : -1),
                     arm             = 0.5 * (branch_of(p, links, l).norm() + eccentric),
                     lever           = rotations && p.inertia[i] > 0 ? p.mass[i] * arm * arm / p.inertia[i] : 0.0;
        reader.read(l, Geometry::present);
        const LinkStiffnesses s = reader.stiffness_of_step(ahead);
        const double seen = links.area[l] / links.reference_length[l] * std::max(s.normal, s.shear * (1.0 + lever));
        if (!has_moment)
          return seen;
        const double turning = p.inertia[i] > 0 ? p.mass[i] / p.inertia[i] : 0.0,
                     across = links.area[l] / links.reference_length[l] * s.shear * (1.0 + lever) + s.bending * turning;
        return std::max({seen, across, s.twist * turning});
      }

    private:
      const Particles &p;
      double           ahead;
      const LinkSet   &links;
      bool             rotations, has_moment;
      LinkReader       reader;
    };

    /** Sum of kappa_c over one particle's links [N/m]. */
    double stiffness_around(
      const Particles &p, const LawfulLinks &of, const bool rotations, const std::int32_t i, const double ahead)
    {
      const LinkSet &links = of.links;
      StiffnessSeen  seen(p, of, rotations, ahead);
      double         sum = 0;
      for (std::int32_t o = links.own_begin[i]; o < links.own_begin[i + 1]; ++o)
        if (links.is_alive(links.own(o)))
          sum += seen(links.own(o), true);
      for (std::int32_t o = links.other_begin[i]; o < links.other_begin[i + 1]; ++o)
        if (links.is_alive(links.others[o]))
          sum += seen(links.others[o], false);
      return sum;
    }
  } // namespace

  double stable_step(const Particles                                          &particles,
                     const std::vector<LawfulLinks>                           &all,
                     const bool                                                rotations,
                     const std::vector<double>                                &of_surfaces,
                     const double                                              ahead,
                     const std::optional<std::pair<std::size_t, std::size_t>> &among)
  {
    const auto [first, last] = among.value_or(std::pair<std::size_t, std::size_t>(0, particles.count));
    std::vector<double> sum  = of_surfaces;
    sum.resize(particles.count, 0.0);
    for (const LawfulLinks &of : all)
      {
        StiffnessSeen seen(particles, of, rotations, ahead);
        for (const LinkRange &lines : among ? updated_lines(of.links) : std::vector<LinkRange>{all_lines(of.links)})
          each_living(of.links, lines, [&](const std::size_t l) {
            sum[of.links.first[l]] += seen(l, true);
            sum[of.links.second[l]] += seen(l, false);
          });
      }
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < last; ++i)
      if (sum[i] > 0 && particles.mass[i] > 0) // without mass: a partner moves it
        smallest = std::min(smallest, 2.0 * particles.mass[i] / sum[i]);
    return std::sqrt(smallest);
  }

  double stiffness_around(const Particles                &particles,
                          const std::vector<LawfulLinks> &all,
                          const bool                      rotations,
                          const std::int32_t              particle,
                          const double                    of_surfaces,
                          const double                    ahead)
  {
    double sum = of_surfaces;
    for (const LawfulLinks &of : all)
      sum += stiffness_around(particles, of, rotations, particle, ahead);
    return sum;
  }

  double stable_step_of(const Particles                &particles,
                        const std::vector<LawfulLinks> &all,
                        const bool                      rotations,
                        const std::int32_t              particle,
                        const double                    of_surfaces,
                        const double                    ahead)
  {
    if (!(particles.mass[particle] > 0))
      return std::numeric_limits<double>::infinity();
    return std::sqrt(2.0 * particles.mass[particle] /
                     stiffness_around(particles, all, rotations, particle, of_surfaces, ahead));
  }
} // namespace dem
