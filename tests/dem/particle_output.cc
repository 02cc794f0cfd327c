#include "clusters.h"
#include "dem/specimen/specimen.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <vector>

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
  const double r = 1e-3, E = 25e9, G = 5e9;

  std::vector<std::size_t> hold_all(dem::Specimen &body)
  {
    std::vector<std::size_t> grips;
    for (std::size_t i = 0; i < body.counts().particles; ++i)
      {
        dem::Grip grip;
        grip.particles = {i};
        grip.prescribed.fill(true);
        grips.push_back(body.grips().add(grip));
      }
    return grips;
  }

  /** Move every particle by the uniform strain, without spin, in some steps; the forces afterwards are those of the end. */
  void strain_uniformly(dem::Specimen &body, const std::vector<std::size_t> &grips, const Matrix3d &strain)
  {
    const int  steps = 10;
    const auto x     = body.particles().position;
    for (std::size_t i = 0; i < x.size(); ++i)
      body.grips().set_velocity(grips[i], strain * x[i] / (steps * body.time_step()), Vector3d::Zero());
    body.advance(steps);
    for (const std::size_t grip : grips)
      body.grips().set_velocity(grip, Vector3d::Zero(), Vector3d::Zero());
    body.advance(1);
  }
} // namespace

TEST_CASE("stress of a particle inside a uniformly strained lattice is the affine one", "[dem]")
{
  // V sigma = sum over half of each neighbour's link of L n (x) A [E n (n.eps n) + G (eps n - n n.eps n)], V = (2 r)^3.
  omp_set_num_threads(1);
  const int n = 5;
  Matrix3d  strain;
  strain << 2e-6, 1e-6, -0.5e-6, 1e-6, -1e-6, 0.7e-6, -0.5e-6, 0.7e-6, 3e-6;
  for (const double iota : {1.1, 1.5, 1.8}) // 6, 18, 26 neighbours
    {
      dem::Specimen body(cluster::cubic_lattice(n, n, n, r), cluster::elastic(cluster::bonded(iota)),
                         cluster::concrete());
      strain_uniformly(body, hold_all(body), strain);

      Matrix3d exact = Matrix3d::Zero();
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
          for (int k = -1; k <= 1; ++k)
            {
              const Vector3d branch = 2 * r * Vector3d(i, j, k);
              const double   L      = branch.norm();
              if (L == 0 || L >= iota * 2 * r)
                continue;
              const Vector3d m = branch / L, stretch = strain * m, normal = m * m.dot(stretch);
              exact += 0.5 * L * m * (M_PI * r * r * (E * normal + G * (stretch - normal))).transpose();
            }
      exact /= 8 * r * r * r;
      if (iota < 1.2)
        CHECK(exact(0, 0) == Approx(M_PI / 4 * E * strain(0, 0)).epsilon(1e-12));
      const Matrix3d found = body.particles().stress[(n * n * n) / 2]; // the one in the middle
      CHECK((found - exact).norm() < 1e-5 * exact.norm());             // strains of 3e-6 are finite
    }
}

TEST_CASE("particle stresses add up to the work of the outer forces (Love and Weber)", "[dem]")
{
  omp_set_num_threads(1);
  const dem::Packing packing = cluster::random_cluster(81, 50, 0.4 * r, r);
  dem::Specimen      body(packing, cluster::bonded(1.5), cluster::concrete());
  const auto         grips = hold_all(body);
  Matrix3d           strain;
  strain << 2e-4, 3e-4, 0, 3e-4, -1e-4, 1e-4, 0, 1e-4, 1e-4;
  strain_uniformly(body, grips, strain);
  const auto out = body.particles();

  Eigen::Array3d low = Eigen::Array3d::Constant(1), high = -low;
  double         solid = 0;
  for (std::size_t i = 0; i < packing.size(); ++i)
    {
      low  = low.min(packing.centre[i].array() - packing.radius[i]);
      high = high.max(packing.centre[i].array() + packing.radius[i]);
      solid += 4.0 / 3.0 * M_PI * std::pow(packing.radius[i], 3);
    }
  const double box    = (high - low).prod();
  Matrix3d     inside = Matrix3d::Zero(), outside = inside;
  for (std::size_t i = 0; i < packing.size(); ++i)
    {
      inside += 4.0 / 3.0 * M_PI * std::pow(packing.radius[i], 3) / solid * box * out.stress[i];
      outside += out.position[i] * body.grips().reaction(grips[i]).transpose();
    }
  CHECK((inside - 0.5 * (outside + outside.transpose())).norm() < 1e-11 * inside.norm());
  CHECK(body.mean_damage() > 0.01);
}

TEST_CASE("damage of a particle is the mean of the links it was made with, broken ones count as one", "[dem]")
{
  omp_set_num_threads(1);
  dem::Specimen body(cluster::cubic_lattice(3, 1, 1, r), cluster::next_neighbours(), cluster::concrete());
  const auto    grips = hold_all(body);
  const auto    move  = [&](const std::size_t i, const double by) {
    body.grips().set_velocity(grips[i], {by / body.time_step(), 0, 0}, Vector3d::Zero());
    body.advance(1);
    body.grips().set_velocity(grips[i], Vector3d::Zero(), Vector3d::Zero());
    body.advance(1);
  };
  move(2, 2e-4 * 2 * r); // strain 2e-4 of the second link
  const double omega = 1 - 0.5 * std::exp(-1.0 / 30);
  auto         out   = body.particles();
  CHECK(out.damage[0] == 0);
  CHECK(out.damage[1] == Approx(omega / 2).epsilon(1e-9));
  CHECK(out.damage[2] == Approx(omega).epsilon(1e-9));
  CHECK(body.mean_damage() == Approx(omega / 2).epsilon(1e-9));

  move(0, -0.1 * r); // the first link is torn: strain 0.05 beyond 277 eps_0
  out = body.particles();
  CHECK(body.counts().broken == 1);
  CHECK(body.counts().links == 1);
  CHECK(out.damage[0] == 1);
  CHECK(out.damage[1] == Approx((1 + omega) / 2).epsilon(1e-9));
  CHECK(out.broken_links == std::vector<std::int32_t>{1, 1, 0});
  CHECK(body.mean_damage() == Approx((1 + omega) / 2).epsilon(1e-9));

  const auto links = body.links();
  REQUIRE(links.kind.size() == 2);
  CHECK(links.kind == std::vector<std::int32_t>{dem::LinkOutput::cohesive, dem::LinkOutput::broken});
  CHECK(links.damage[1] == 1);
  CHECK(links.normal_force[1] == 0);
  CHECK(std::minmax(links.ends[1][0], links.ends[1][1]) == std::minmax<std::size_t>(0, 1));
}
