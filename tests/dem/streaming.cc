// Stores past the caches, which large sets of links take.
#include "dem/core/streaming.h"

#include "clusters.h"
#include "dem/contacts/particle_pairs.h"
#include "dem/kernels/particle_pass.h"
#include "dem/laws/cpm.h"
#include "dem/laws/parallel_bond.h"
#include "dem/model/links.h"
#include "dem/model/materials.h"
#include "dem/model/particles.h"
#include "weak_bonds.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace
{
  /** A cluster in which every particle has just moved and turned a little. */
  dem::Particles moving(const dem::Packing &packing)
  {
    dem::Particles     particles = dem::make_particles(packing, {3, 2400.0}, true);
    dem::UniformRandom random(5);
    for (std::size_t i = 0; i < particles.count; ++i)
      for (std::size_t c = 0; c < 6; ++c)
        {
          const std::size_t at   = dem::record_size * i + c;
          const double      move = (c < 3 ? 1e-6 : 1e-3) * (random() - 0.5);
          particles.motion[at]   = move;
          particles.pose[at] += move;
        }
    return particles;
  }
} // namespace

TEST_CASE("a line written past the caches holds the bits of one written into them", "[dem]")
{
  alignas(64) double stored[8], streamed[8];
  const dem::Pack    values = dem::pack_of([](const int i) { return 1.0 / (3.0 + i); });
  dem::put(values, stored, false);
  dem::put(values, streamed, true);
  dem::finish_streaming();
  CHECK(std::equal(stored, stored + 8, streamed));
}

TEST_CASE("links give the same forces and histories, whether their records are written past the caches or not", "[dem]")
{
  const dem::Packing packing   = cluster::random_cluster(11, 300, 1e-3, 1e-3);
  dem::Particles     particles = moving(packing);
  const auto         law       = dem::LinkMaterials(cluster::concrete()).bonds(dem::Physics());
  dem::LinkSet       kept;
  dem::make_links(kept, dem::particle_pairs(particles, 1.5, 0.0), particles, {}, *law);
  REQUIRE(kept.count > 500);
  REQUIRE_FALSE(kept.streams); // few enough for any cache
  dem::LinkSet past = kept;
  past.streams      = true;
  const auto pass   = law->pass(dem::Mixture::equal);
  pass(kept, particles, *law, kept.whole());
  pass(past, particles, *law, past.whole());
  CHECK(std::any_of(kept.force.begin(), kept.force.end(), [](const double f) { return f != 0; }));
  CHECK(kept.force == past.force);
  CHECK(kept.history == past.history);
}

TEST_CASE("particles move by the same bits, whether force records are fetched ahead or not", "[dem]")
{
  const dem::Packing packing   = cluster::random_cluster(11, 300, 1e-3, 1e-3);
  dem::Particles     particles = moving(packing);
  const bool         moments   = GENERATE(false, true);
  CAPTURE(moments);
  const dem::LinkMaterials materials =
    moments ? dem::LinkMaterials(weak_bonds::parallel()) : dem::LinkMaterials(cluster::concrete());
  const auto   law = materials.bonds(dem::Physics());
  dem::LinkSet links;
  dem::make_links(links, dem::particle_pairs(particles, 1.5, 0.0), particles, {}, *law);
  REQUIRE(links.count > 500);
  REQUIRE_FALSE(links.fetches_ahead); // few enough for the caches
  law->pass(dem::Mixture::radii)(links, particles, *law, links.whole());
  dem::Particles ahead = particles;

  const auto        pass   = dem::select_particle_pass(false, true, false, moments, dem::Surroundings::free);
  const std::size_t blocks = dem::particle_blocks(particles.count);
  std::vector<dem::ParticleBlockAccount> account(blocks), account_ahead(blocks);
  const auto                             move = [&](dem::Particles &p, std::vector<dem::ParticleBlockAccount> &of) {
    pass(p, links, nullptr, {}, {1e-7, 1e-7}, 0.3, Eigen::Vector3d::Zero(), {0, blocks}, of);
  };
  move(particles, account);
  links.fetches_ahead = true;
  move(ahead, account_ahead);
  CHECK(std::any_of(particles.force.begin(), particles.force.end(), [](const double f) { return f != 0; }));
  CHECK(particles.pose == ahead.pose);
  CHECK(particles.velocity == ahead.velocity);
  CHECK(particles.force == ahead.force);
  CHECK(account.front().kinetic == account_ahead.front().kinetic);
}
