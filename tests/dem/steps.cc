#include "clusters.h"
#include "dem/integrators/stable_step.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"
#include "dem/neighbours/cell_list.h"
#include "dem/specimen/specimen.h"
#include "dense_stiffness.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <optional>

using Eigen::Vector3d;

namespace
{
  const double r = 1e-3, density = 4800, mass = density * 4.0 / 3.0 * M_PI * r * r * r, E = 25e9;
  const double k_N = E * M_PI * r * r / (2 * r); // of touching spheres

  dem::CpmParameters with_shear_ratio(const double ratio)
  {
    dem::CpmParameters p = cluster::concrete();
    p.shear_ratio        = ratio;
    return p;
  }

  dem::Specimen chain(const int n, const double shear_ratio, const bool rotations)
  {
    auto p              = cluster::elastic(cluster::next_neighbours());
    p.physics.rotations = rotations;
    return {cluster::cubic_lattice(n, 1, 1, r), p, with_shear_ratio(shear_ratio)};
  }
} // namespace

TEST_CASE("per-particle step of a chain is its closed form", "[dem]")
{
  // kappa = max(k_N, k_T (1 + (5/8) (L/r)^2)) = max(k_N, 3.5 k_T), two links on an inner sphere: sqrt(2 m/(2 kappa)).
  CHECK(chain(5, 0.2, true).stable_step() == Approx(std::sqrt(mass / k_N)).epsilon(1e-13));
  CHECK(chain(5, 1.0, true).stable_step() == Approx(std::sqrt(mass / (3.5 * k_N))).epsilon(1e-13));
  CHECK(chain(5, 1.0, false).stable_step() == Approx(std::sqrt(mass / k_N)).epsilon(1e-13));
  CHECK(chain(5, 2.0, false).stable_step() == Approx(std::sqrt(mass / (2 * k_N))).epsilon(1e-13));
  CHECK(chain(2, 0.2, true).stable_step() ==
        Approx(std::sqrt(2 * mass / k_N)).epsilon(1e-13)); // the ends have one link
}

TEST_CASE("critical step of a chain is its closed form, the per-particle step within a factor of two below", "[dem]")
{
  // Free chain of n masses: largest circular frequency squared 4 k/m cos^2(pi/(2 n)), along with k_N and, unless they spin,
  // across with k_T.
  for (const int n : {2, 3, 10, 40})
    {
      const double w = 2 * std::sqrt(k_N / mass) * std::cos(M_PI / (2 * n));
      CHECK(chain(n, 0.2, true).critical_step() == Approx(2 / w).epsilon(1e-9));
      CHECK(chain(n, 0.7, false).critical_step() == Approx(2 / w).epsilon(1e-9));
      CHECK(chain(n, 1.7, false).critical_step() == Approx(2 / w / std::sqrt(1.7)).epsilon(1e-9));
      for (const double ratio : {0.05, 0.2, 1.0, 3.0})
        for (const bool rotations : {true, false})
          {
            const dem::Specimen body    = chain(n, ratio, rotations);
            const double        quality = body.stable_step() / body.critical_step();
            INFO(n << " spheres, shear ratio " << ratio << ", rotations " << rotations);
            CHECK(quality > 0.5);
            CHECK(quality <= 1 + 1e-9);
          }
    }
}

TEST_CASE("critical step of random clusters is that of their dense eigenvalues", "[dem]")
{
  omp_set_num_threads(1);
  for (const bool rotations : {true, false})
    for (const double ratio : {0.2, 1.0})
      for (std::uint64_t seed = 71; seed < 75; ++seed)
        {
          const std::size_t        many = seed < 73 ? 25 : 60; // few and so many that Lanczos is used
          const dem::ParticleShape shape{3, density, 0};
          const auto               law       = dem::LinkMaterials(with_shear_ratio(ratio)).bonds(dem::Physics());
          const dem::Packing       packing   = cluster::random_cluster(seed, many, seed % 2 ? r : 0.3 * r, r);
          dem::Particles           particles = dem::make_particles(packing, shape, rotations);
          dem::LinkSet             links;
          dem::Packing             ordered = packing;
          for (std::size_t i = 0; i < packing.size(); ++i)
            {
              ordered.centre[i] = particles.position_of(i);
              ordered.radius[i] = particles.radius_of(i);
            }
          dem::make_links(links, dem::find_pairs(ordered.centre, ordered.radius, 1.5, 0.0, std::nullopt), particles,
                          shape, *law);
          const double exact = dense::critical_step(particles, links, *law, rotations);
          CHECK(dem::critical_step(particles, {{links, *law}}, rotations) == Approx(exact).epsilon(1e-9));
          CHECK(dem::stable_step(particles, {{links, *law}}, rotations) <= exact);
        }
}

TEST_CASE("time step is the factor times the per-particle step", "[dem]")
{
  for (const double factor : {0.1, 0.8, 0.95})
    {
      auto p        = cluster::bonded(1.5);
      p.step_factor = factor;
      const dem::Specimen body(cluster::cubic_lattice(3, 3, 3, r), p, cluster::concrete());
      CHECK(body.time_step() == Approx(factor * body.stable_step()).epsilon(1e-15));
    }
}

TEST_CASE("time step falls when contacts stiffen a particle beyond its own bound", "[dem]")
{
  // A light small sphere, bonded to one large sphere, is pressed by a second one: twice the stiffness at the same mass.
  omp_set_num_threads(1);
  dem::Packing packing;
  packing.centre  = {Vector3d(0, 0, 0), Vector3d(1.3 * r, 0, 0), Vector3d(2.9 * r, 0, 0)};
  packing.radius  = {r, 0.3 * r, r};
  auto          p = cluster::bonded(1.1);
  dem::Specimen body(packing, p, cluster::concrete());
  REQUIRE(body.counts().links == 1);
  const double before = body.time_step();
  body.set_velocity(2, {-20, 0, 0}, Vector3d::Zero());
  while (body.counts().contacts == 0 && body.steps() < 10000)
    body.advance(1);
  REQUIRE(body.counts().contacts == 1);
  body.advance(100);
  CHECK(body.time_step() <= 0.8 * body.stable_step() * (1 + 1e-9));
  CHECK(body.time_step() < 0.8 * before);
}
