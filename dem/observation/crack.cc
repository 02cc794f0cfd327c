#include "dem/observation/crack.h"

#include "dem/specimen/observation.h"
#include "dem/specimen/told_to_first.h"

#include <cmath>
#include <numeric>
#include <vector>

namespace dem
{
  namespace
  {
    /** What is added up over links, by its place among numbers that go from rank to rank. */
    struct CrackSum
    {
      enum Place : std::size_t
      {
        links,
        cracked,
        broken,
        length_area,      ///< [m^3]
        severed,          ///< [m^2]
        severed_at_grips, ///< [m^2]
        all
      };
    };

    void add_to_crack(std::vector<double>  &sum,
                      const ParticleOutput &particles,
                      const LinkOutput     &some,
                      const ParticleShape  &shape)
    {
      for (std::size_t l = 0; l < some.ends.size(); ++l)
        {
          if (some.kind[l] == LinkOutput::contact)
            continue;
          const auto [J, K] = some.ends[l];
          const double area = shape.link_area(particles.radius[J], particles.radius[K]);
          sum[CrackSum::length_area] += area * some.load[l].branch.norm();
          ++sum[CrackSum::links];
          sum[CrackSum::broken] += some.kind[l] == LinkOutput::broken;
          if (some.damage[l] <= Crack::damage)
            continue;
          ++sum[CrackSum::cracked];
          sum[CrackSum::severed] += area;
          if (particles.held[J] || particles.held[K])
            sum[CrackSum::severed_at_grips] += area;
        }
    }

    Crack crack_of(const std::vector<double> &sum, const ParticleOutput &particles, const int dimension)
    {
      Crack crack;
      crack.links   = static_cast<std::size_t>(sum[CrackSum::links]);
      crack.cracked = static_cast<std::size_t>(sum[CrackSum::cracked]);
      crack.broken  = static_cast<std::size_t>(sum[CrackSum::broken]);
      if (sum[CrackSum::severed] == 0)
        return crack;
      const double volume = std::accumulate(particles.volume.begin(), particles.volume.end(), 0.0);
      const double cut    = (dimension == 3 ? 0.5 : 2 / M_PI) * sum[CrackSum::length_area] / volume;
      crack.area          = sum[CrackSum::severed] / cut;
      crack.area_at_grips = sum[CrackSum::severed_at_grips] / cut;
      return crack;
    }
  } // namespace

  Crack measure_crack(const ParticleOutput &particles, const LinkOutput &all, const ParticleShape &shape)
  {
    std::vector<double> sum(CrackSum::all, 0.0);
    add_to_crack(sum, particles, all, shape);
    return crack_of(sum, particles, shape.dimension);
  }

  Crack measure_crack(const ObservedSpecimen &specimen)
  {
    const SpecimenParameters &made      = specimen.parameters();
    const ParticleOutput      particles = lasting_particles(specimen);
    const ParticleShape       shape{made.physics.dimension, made.density, made.thickness};
    std::vector<double>       sum(CrackSum::all, 0.0);
    add_up_links(specimen, sum, [&](const LinkOutput &some) { add_to_crack(sum, particles, some, shape); });
    return crack_of(sum, particles, shape.dimension);
  }
} // namespace dem
