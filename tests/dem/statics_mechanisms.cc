// Hard case S7: floaters, mechanisms, networks at the edge of rigidity, stiffness contrast 1e6.
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/packing/lattice.h"
#include "tests/dem/homogenisation_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace homogenisation_fixture;

namespace
{
  /** A rigid simple cubic block of 4 x 4 x 3 spheres, the rest of the cell along z empty. */
  dem::Packing slab()
  {
    // Three spheres along x and y: no checkerboard fits, the block has no gear mechanism of its own.
    dem::Packing p = dem::make_lattice(dem::Lattice::face_centred_cubic, 1.0, {2, 2, 2});
    *p.periodic_cell += Eigen::Vector3d(0, 0, 12);
    return p;
  }

  std::vector<std::int32_t> particles_without_hold(const dem::ElasticNetwork &network, const dem::SolverMethod method)
  {
    dem::SolverParameters solver;
    solver.method    = method;
    const auto found = dem::relaxed_stiffness(network, solver);
    CHECK(found.solver.converged);
    CHECK(found.solver.residual <= 1e-10);
    return dem::floaters(found.solver.mechanisms);
  }

  using Numbers = std::vector<std::int32_t>;
} // namespace

TEST_CASE("mechanisms: spheres of no, one and two links are named, those of three are not", "[dem][statics]")
{
  dem::Packing p = slab();
  const auto   top =
    *std::max_element(p.centre.begin(), p.centre.end(), [](const auto &a, const auto &b) { return a[2] < b[2]; });
  const auto n = static_cast<std::int32_t>(p.size());
  p.centre.push_back(top + Eigen::Vector3d(0, 0, 6));         // far from all: no link
  p.centre.push_back(top + Eigen::Vector3d(0, 0, 2));         // on one sphere: one link
  p.centre.push_back(p.centre[0] - Eigen::Vector3d(0, 0, 2)); // chain below: first link of a chain of two,
  p.centre.push_back(p.centre[0] - Eigen::Vector3d(0, 0, 4)); // its end
  p.radius.resize(p.centre.size(), 1.0);
  const auto network = dem::make_network(p, links(1.0 + 1e-6, 0.3));
  for (const auto method : {dem::SolverMethod::iterative, dem::SolverMethod::direct})
    CHECK(particles_without_hold(network, method) == Numbers{n, n + 1, n + 2, n + 3});

  dem::SolverParameters solver;
  const auto            report = dem::relaxed_stiffness(network, solver).solver;
  REQUIRE(report.mechanisms.size() == 3);
  CHECK(report.mechanisms[0].links == 0);
  CHECK(report.mechanisms[1].links == 1);
  CHECK(report.mechanisms[2].particles == Numbers{n + 2, n + 3});
  const std::string text = dem::describe(report.mechanisms);
  CHECK_THAT(text, Catch::Contains("4 particles move without resistance"));
  CHECK_THAT(text, Catch::Contains("particle " + std::to_string(n + 1) + " (0 links)"));
}

TEST_CASE("mechanisms: a sphere between two may spin about their line, between three it is held", "[dem][statics]")
{
  // Four spheres of a square, far apart, on a grid of links of their own: the fifth in the middle sees two or four.
  dem::Packing p = slab();
  const auto   n = static_cast<std::int32_t>(p.size());
  const double z =
    std::max_element(p.centre.begin(), p.centre.end(), [](const auto &a, const auto &b) { return a[2] < b[2]; })->z();
  std::vector<Eigen::Vector3d> top;
  for (const auto &c : p.centre)
    if (c[2] > z - 1e-9)
      top.push_back(c);
  const auto second =
    std::find_if(top.begin() + 1, top.end(), [&](const auto &c) { return (c - top[0]).norm() < 2.001; });
  REQUIRE(second != top.end());
  const Eigen::Vector3d middle = 0.5 * (top[0] + *second);
  p.centre.push_back(middle + Eigen::Vector3d(0, 0, std::sqrt(3.0))); // touches exactly the two
  p.radius.push_back(1.0);
  const auto two = dem::make_network(p, links(1.0 + 1e-6, 0.3));
  for (const auto method : {dem::SolverMethod::iterative, dem::SolverMethod::direct})
    CHECK(particles_without_hold(two, method) == Numbers{n});

  p.centre.back() = middle + Eigen::Vector3d(0, 0, std::sqrt(3.0));
  const auto more = dem::make_network(p, links(1.45, 0.3)); // its next neighbours, 2 sqrt(2) away, linked too
  for (const auto method : {dem::SolverMethod::iterative, dem::SolverMethod::direct})
    CHECK(particles_without_hold(more, method).empty());
}

TEST_CASE("mechanisms: gears of a lattice with two sublattices are found", "[dem][statics]")
{
  // Simple cubic, all numbers even: spins of alternating sign about each axis meet no resistance; one odd number stops
  // those that alternate along it.
  const auto even = dem::make_network(dem::make_lattice(dem::Lattice::simple_cubic, 1.0, {2, 4, 2}), links(1.05, 0.3));
  const auto odd  = dem::make_network(dem::make_lattice(dem::Lattice::simple_cubic, 1.0, {3, 3, 3}), links(1.05, 0.3));
  for (const auto method : {dem::SolverMethod::iterative, dem::SolverMethod::direct})
    {
      CHECK(particles_without_hold(even, method).size() == 16);
      CHECK(particles_without_hold(odd, method).empty());
    }
}

TEST_CASE("mechanisms: a second network that is loose in the first is named, the larger one is not", "[dem][statics]")
{
  dem::Packing p = slab();
  const auto   n = static_cast<std::int32_t>(p.size());
  dem::Packing layer;
  const double z = (*p.periodic_cell)[2] - 5;
  for (const Eigen::Vector3d &c : {Eigen::Vector3d(1, 1, z), Eigen::Vector3d(3, 1, z), Eigen::Vector3d(2, 2.7, z),
                                   Eigen::Vector3d(2, 1.6, z + 1.6)})
    {
      p.centre.push_back(c);
      p.radius.push_back(1.0);
    }
  const auto network = dem::make_network(p, links(1.05, 0.3));
  for (const auto method : {dem::SolverMethod::iterative, dem::SolverMethod::direct})
    CHECK(particles_without_hold(network, method) == Numbers{n, n + 1, n + 2, n + 3});
}

TEST_CASE("statics: at the edge of rigidity the answer is found, or the moving particles are named", "[dem][statics]")
{
  // Interaction ratio falling towards touching: coordination from 8 to below 4 links per sphere (3 links of 2 shear and one
  // normal component each hold 6 motions: the edge is at 4 link ends per sphere).
  const auto packing = random_spheres(150, 9);
  for (const double ratio : {1.4, 1.25, 1.15, 1.1, 1.05})
    {
      const auto network = dem::make_network(packing, links(ratio, 0.3));
      const auto relaxed = dem::relaxed_stiffness(network);
      CAPTURE(ratio, network.links.size(), relaxed.solver.text());
      CHECK(relaxed.solver.converged);
      CHECK(relaxed.solver.residual <= 1e-10);
      CHECK(relaxed.stiffness.allFinite());
      // Spheres with fewer than three link ends can never be held.
      std::vector<int> ends(packing.size(), 0);
      for (const auto &l : network.links)
        {
          ++ends[l.first];
          ++ends[l.second];
        }
      const auto floating = dem::floaters(relaxed.solver.mechanisms);
      for (std::size_t i = 0; i < ends.size(); ++i)
        if (ends[i] < 3)
          CHECK(std::binary_search(floating.begin(), floating.end(), static_cast<std::int32_t>(i)));
      // The other method says the same.
      dem::SolverParameters direct;
      direct.method    = dem::SolverMethod::direct;
      const auto check = dem::relaxed_stiffness(network, direct);
      CHECK(check.solver.residual <= 1e-10);
      CHECK(dem::floaters(check.solver.mechanisms) == floating);
      CHECK((check.stiffness - relaxed.stiffness).norm() <= 1e-8 * dem::affine_stiffness(network).norm());
    }
}

TEST_CASE("statics: stiffness contrast of a million leaves the residual below 1e-10", "[dem][statics]")
{
  auto               network = dem::make_network(random_spheres(200, 10), links(1.6, 0.3));
  dem::UniformRandom random(5);
  for (auto &l : network.links)
    l.stiffness *= std::pow(10.0, -6 * random()); // every decade alike
  Matrix6 answers[3];
  int     k = 0;
  for (const auto method : {dem::SolverMethod::automatic, dem::SolverMethod::iterative, dem::SolverMethod::direct})
    {
      dem::SolverParameters solver;
      solver.method    = method;
      const auto found = dem::relaxed_stiffness(network, solver);
      CAPTURE(found.solver.text());
      CHECK(found.solver.converged);
      CHECK(found.solver.residual <= 1e-10);
      answers[k++] = found.stiffness;
    }
  CHECK(relative_difference(answers[1], answers[2]) <
        1e-6); // residual 1e-10 times a condition number of some 1e6, squared in the energy
  CHECK(relative_difference(answers[0], answers[2]) < 1e-6);
}
