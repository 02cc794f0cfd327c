// Hard case S3: the per-particle step against the critical step on packings that are as unlike as they can be.

#include "dem/integrators/stable_step.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"
#include "dem/neighbours/cell_list.h"
#include "tests/dem/clusters.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <optional>

TEST_CASE("per-particle step is within a factor of two below the critical step on unlike packings (S3)", "[stability]")
{
  // Size ratio 1:10; link stiffness contrast 1:1000 through the cross-sections, log-uniform.
  for (std::uint64_t seed = 121; seed < 141; ++seed)
    {
      const dem::ParticleShape shape{3, 4800, 0};
      const auto               law = dem::LinkMaterials(cluster::concrete()).bonds(dem::Physics());
      dem::Particles particles     = dem::make_particles(cluster::random_cluster(seed, 150, 0.2e-3, 2e-3), shape, true);
      std::vector<Eigen::Vector3d> centre;
      std::vector<double>          radius;
      for (std::size_t i = 0; i < particles.count; ++i)
        {
          centre.push_back(particles.position_of(i));
          radius.push_back(particles.radius_of(i));
        }
      dem::LinkSet links;
      dem::make_links(links, dem::find_pairs(centre, radius, 1.5, 0.0, std::nullopt), particles, shape, *law);
      dem::UniformRandom random(seed);
      for (std::size_t l = 0; l < links.count; ++l)
        links.area[l] *= std::pow(1000.0, -random());
      const double quality =
        dem::stable_step(particles, {{links, *law}}, true) / dem::critical_step(particles, {{links, *law}}, true);
      INFO("seed " << seed << ", " << links.count << " links");
      CHECK(quality > 0.5);
      CHECK(quality <= 1 + 1e-9);
    }
}
