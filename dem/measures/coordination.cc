#include "dem/measures/coordination.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace dem
{
  std::int64_t Coordination::with_at_most(const std::size_t links) const
  {
    std::int64_t sum = 0;
    for (std::size_t z = 0; z < std::min(links + 1, particles.size()); ++z)
      sum += particles[z];
    return sum;
  }

  Coordination coordination(const std::vector<std::array<std::size_t, 2>> &ends, const std::size_t particles)
  {
    Coordination c;
    c.of_particle.assign(particles, 0);
    for (const auto &link : ends)
      for (const std::size_t end : link)
        {
          if (end >= particles)
            throw std::invalid_argument("coordination: a link ends at particle " + std::to_string(end + 1) + " of " +
                                        std::to_string(particles) + ".");
          ++c.of_particle[end];
        }
    const auto most = std::max_element(c.of_particle.begin(), c.of_particle.end());
    c.particles.assign(most == c.of_particle.end() ? 1 : *most + 1, 0);
    for (const std::int32_t z : c.of_particle)
      ++c.particles[z];

    const auto   twice = 2.0 * static_cast<double>(ends.size()), n = static_cast<double>(particles);
    const double ones     = c.particles.size() > 1 ? static_cast<double>(c.particles[1]) : 0.0;
    const double carrying = n - static_cast<double>(c.with_at_most(1));
    c.mean                = particles > 0 ? twice / n : 0.0;
    c.mechanical          = carrying > 0 ? (twice - ones) / carrying : 0.0;
    return c;
  }
} // namespace dem
