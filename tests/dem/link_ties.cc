#include "clusters.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/specimen/specimen.h"

#include <catch2/catch.hpp>

#include <omp.h>

using Eigen::Vector3d;

// In a regular packing many distances are equal to the reach of links on paper. Whether they are linked must not hang on the place of
// the origin, through the rounding of the last digit.

namespace
{
  /** Points of a lattice in units of its edge, moved by `shift`; radius such that the ratio 1.5 reaches exactly to the next image. */
  dem::Packing tied(const std::vector<Vector3d> &points, const double edge, const Vector3d &shift)
  {
    dem::Packing packing;
    for (const Vector3d &x : points)
      packing.centre.emplace_back(edge * x + shift);
    packing.radius.assign(points.size(), edge / 3);
    packing.periodic_cell = Vector3d::Constant(edge);
    return packing;
  }

  dem::NetworkParameters links_to_neighbours()
  {
    dem::NetworkParameters p;
    p.interaction_ratio = 1.5;
    p.normal_modulus    = 1;
    p.shear_ratio       = 0.2;
    return p;
  }

  struct Linked
  {
    std::size_t links, in_motion;
    double      stiffness;
  };

  Linked linked(const dem::Packing &packing)
  {
    const dem::ElasticNetwork network = dem::make_network(packing, links_to_neighbours());
    dem::SpecimenParameters   p       = cluster::bonded(1.5);
    p.physics.periodic                = true;
    const dem::Specimen specimen(packing, p, cluster::concrete());
    return {network.links.size(), specimen.counts().links, dem::affine_stiffness(network)(0, 0)};
  }

  void compare_translations(const std::vector<Vector3d> &points, const double edge)
  {
    omp_set_num_threads(1);
    const Linked       here = linked(tied(points, edge, Vector3d::Zero()));
    dem::UniformRandom random(5);
    for (int trial = 0; trial < 200; ++trial)
      {
        const double far   = trial < 100 ? edge : 50 * edge;
        const Linked there = linked(tied(points, edge, far * cluster::random_vector(random)));
        CHECK(there.links == here.links);
        CHECK(there.in_motion == here.links);
        CHECK(there.stiffness == Approx(here.stiffness).epsilon(1e-9));
      }
  }
} // namespace

TEST_CASE("links to images of oneself at an exact tie are the same for any translation", "[statics][neighbours]")
{
  for (const double edge : {1.0, 0.1, 3.7e-3}) // of which a third has no exact binary form
    compare_translations({{0, 0, 0}, {0.5, 0.5, 0.5}}, edge);
}

TEST_CASE("links between neighbours at an exact tie are the same for any translation", "[statics][neighbours]")
{
  // Eight spheres of a cubic lattice: the second neighbours along an edge are images, at two spacings.
  const double          h = 0.5;
  std::vector<Vector3d> points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back(h * (i & 1), h * (i >> 1 & 1), h * (i >> 2 & 1));
  compare_translations(points, 0.1);
}

TEST_CASE("a free lattice touches everywhere or nowhere", "[dem][neighbours]")
{
  // Ratio 1 means less than touching: no link at all, not those that rounding brings nearer.
  dem::NetworkParameters p = links_to_neighbours();
  p.interaction_ratio      = 1;
  dem::UniformRandom random(6);
  for (int trial = 0; trial < 20; ++trial)
    {
      const auto lattice = cluster::moved(cluster::cubic_lattice(3, 3, 3, 0.1), Eigen::Matrix3d::Identity(),
                                          cluster::random_vector(random));
      CHECK_THROWS_WITH(dem::make_network(lattice, p), Catch::Contains("no two particles are near enough"));
    }
}
