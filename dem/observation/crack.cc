#include "dem/observation/crack.h"

#include <cmath>
#include <numeric>

namespace dem
{
  Crack measure_crack(const ParticleOutput &particles, const LinkOutput &links, const ParticleShape &shape)
  {
    Crack  crack;
    double length_area = 0, severed = 0, severed_at_grips = 0;
    for (std::size_t l = 0; l < links.ends.size(); ++l)
      {
        if (links.kind[l] == LinkOutput::contact)
          continue;
        const auto [J, K] = links.ends[l];
        const double area = shape.link_area(particles.radius[J], particles.radius[K]);
        length_area += area * links.load[l].branch.norm();
        ++crack.links;
        crack.broken += links.kind[l] == LinkOutput::broken;
        if (links.damage[l] <= Crack::damage)
          continue;
        ++crack.cracked;
        severed += area;
        if (particles.held[J] || particles.held[K])
          severed_at_grips += area;
      }
    if (severed == 0)
      return crack;
    const double volume = std::accumulate(particles.volume.begin(), particles.volume.end(), 0.0);
    const double cut    = (shape.dimension == 3 ? 0.5 : 2 / M_PI) * length_area / volume;
    crack.area          = severed / cut;
    crack.area_at_grips = severed_at_grips / cut;
    return crack;
  }
} // namespace dem
