#include "dem/integrators/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dem
{
  namespace
  {
    void add_stiffness(
      const Particles &p, const LinkSet &links, const CpmConstants &law, const bool rotations, std::vector<double> &sum)
    {
      for (std::size_t l = 0; l < links.count; ++l)
        {
          if (!links.is_alive(l))
            continue;
          const std::int32_t J = links.first[l], K = links.second[l];
          const double       length = branch_of(p, links, l).norm(),
                       eccentric    = p.radius_of(J) - p.radius_of(K);
          const double stiffness    = links.area[l] / links.reference_length[l];
          const auto   seen_from    = [&](const std::int32_t i, const double arm) {
            const double lever = rotations ? p.mass[i] * arm * arm / p.inertia[i] : 0.0;
            return stiffness * std::max(law.E, law.G * (1.0 + lever));
          };
          sum[J] += seen_from(J, 0.5 * (length + eccentric));
          sum[K] += seen_from(K, 0.5 * (length - eccentric));
        }
    }
  } // namespace

  double stable_step(const Particles    &particles,
                     const LinkSet      &bonds,
                     const LinkSet      *contacts,
                     const CpmConstants &law,
                     const bool          rotations)
  {
    std::vector<double> sum(particles.count, 0.0);
    add_stiffness(particles, bonds, law, rotations, sum);
    if (contacts)
      add_stiffness(particles, *contacts, law, rotations, sum);
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < particles.count; ++i)
      if (sum[i] > 0)
        smallest = std::min(smallest, 2.0 * particles.mass[i] / sum[i]);
    return std::sqrt(smallest);
  }
} // namespace dem
