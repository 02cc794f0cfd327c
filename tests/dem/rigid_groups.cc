// Rigid motions of groups of particles beside the particles' own blocks.
#include "dem/linear/rigid_groups.h"

#include "dem/linear/linear_solver.h"
#include "tests/dem/homogenisation_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace homogenisation_fixture;

namespace
{
  /**
   * Spheres in a face-centred lattice of so many cells of four, each linked to twelve others; links are up to four times as stiff as others. In a
   * simple cubic lattice, where every other sphere can turn the other way, turns would be soft that no group makes.
   */
  dem::ElasticNetwork lattice_of(const int nx, const int ny, const int nz)
  {
    const double edge = 2 * std::sqrt(2.0);
    dem::Packing packing;
    for (int i = 0; i < 2 * nx; ++i)
      for (int j = 0; j < 2 * ny; ++j)
        for (int k = (i + j) % 2; k < 2 * nz; k += 2)
          packing.centre.push_back(edge / 2 * Eigen::Vector3d(i, j, k));
    packing.radius.assign(packing.centre.size(), 1.0);
    packing.periodic_cell       = edge * Eigen::Vector3d(nx, ny, nz);
    dem::ElasticNetwork network = dem::make_network(packing, links(1.05, 0.2));
    dem::UniformRandom  random(7);
    for (dem::ElasticLink &link : network.links)
      link.stiffness *= 1 + 3 * random();
    return network;
  }

  struct Answer
  {
    Matrix6 stiffness;
    int     iterations;
  };

  template <typename Preconditioner>
  Answer answer_by(const dem::ElasticNetwork &network)
  {
    const dem::StiffnessOperator K(network, {});
    dem::RowShare                share(K, nullptr);
    dem::Fields                  x(K.particles() * dem::motions * dem::load_lanes, 0.0), b(x);
    dem::LaneStrains             strain;
    for (int lane = 0; lane < dem::load_lanes; ++lane)
      strain[lane] = lane < 6 ? base::Vector6(base::Vector6::Unit(lane)) : base::Vector6(base::Vector6::Zero());
    K.apply(x, strain, b);
    for (double &force : b)
      force = -force;
    const auto make = [&] {
      if constexpr (std::is_same_v<Preconditioner, dem::BlockJacobi>)
        return Preconditioner(K, share.own());
      else
        return Preconditioner(K, share);
    };
    const auto reference = K.link_force_norm(x, strain);
    const auto report    = dem::conjugate_gradients(K, make(), b, x, reference, {1e-11, 20000}, share);
    REQUIRE(report.converged);
    return {K.energy_product(x, strain), report.iterations};
  }
} // namespace

TEST_CASE("statics: rigid motions of groups spare a long cell most iterations, and leave its stiffness as it is",
          "[dem][statics]")
{
  const dem::ElasticNetwork network = lattice_of(3, 3, 56);
  const Answer blocks = answer_by<dem::BlockJacobi>(network), groups = answer_by<dem::BlocksAndGroups>(network);
  CAPTURE(blocks.iterations, groups.iterations);
  CHECK(5 * groups.iterations < 2 * blocks.iterations);
  CHECK(relative_difference(groups.stiffness, blocks.stiffness) < 1e-12);
}

TEST_CASE("statics: with rigid motions of groups a large cell needs hardly more iterations than a small one",
          "[dem][statics]")
{
  const auto of    = [](const int n) { return answer_by<dem::BlocksAndGroups>(lattice_of(n, n, n)).iterations; };
  const int  small = of(7), large = of(12); // 11 and 54 groups
  CAPTURE(small, large);
  CHECK(large < 1.25 * small);
}

TEST_CASE("statics: what no link holds stays at rest where the groups around it move, and is named", "[dem][statics]")
{
  dem::ElasticNetwork network = lattice_of(11, 11, 11);
  REQUIRE(network.particles() > dem::RigidGroups::fewest_particles);
  // Loose: one sphere in 97, and a pair with a link of its own.
  auto              &all      = network.links;
  const auto         in_97    = [](const std::int32_t i) { return i % 97 == 5; };
  const auto         free_one = std::find_if(all.begin() + 5000, all.end(),
                                             [&](const dem::ElasticLink &l) { return !in_97(l.first) && !in_97(l.second); });
  const std::int32_t J = free_one->first, K = free_one->second;
  const auto         loose    = [&](const std::int32_t i) { return in_97(i) || i == J || i == K; };
  const auto         unlinked = [&](const dem::ElasticLink &l) {
    return (loose(l.first) || loose(l.second)) && !(l.first == J && l.second == K);
  };
  all.erase(std::remove_if(all.begin(), all.end(), unlinked), all.end());
  const dem::RelaxedStiffness relaxed = dem::relaxed_stiffness(network, {});
  CHECK(relaxed.solver.converged);
  CHECK(relaxed.solver.method == dem::SolverMethod::iterative);
  std::vector<std::int32_t> expected;
  double                    largest = 0, largest_of_loose = 0;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(network.particles()); ++i)
    {
      double &most = in_97(i) ? largest_of_loose : largest;
      most         = std::max(most, relaxed.motion[i].cwiseAbs().maxCoeff());
      if (loose(i))
        expected.push_back(i);
    }
  CHECK(dem::floaters(relaxed.solver.mechanisms) == expected);
  CHECK(largest > 0.01);
  CHECK(largest_of_loose == 0);
  // The pair keeps its link unstretched by moving either end alike.
  CHECK((relaxed.motion[J] + relaxed.motion[K]).topRows<3>().cwiseAbs().maxCoeff() < 1e-9);
}
