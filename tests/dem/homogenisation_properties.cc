// Properties of the macroscopic stiffness that hold for every packing.
#include "dem/homogenisation/relaxed_stiffness.h"
#include "tests/dem/homogenisation_fixture.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <cstring>

using namespace homogenisation_fixture;

namespace
{
  dem::SolverParameters tight()
  {
    dem::SolverParameters p;
    p.tolerance = 1e-12;
    return p;
  }

  dem::CellPacking in_cell(const dem::Packing &packing, const Eigen::Matrix3d &map)
  {
    dem::CellPacking cell;
    for (const auto &c : packing.centre)
      cell.centre.push_back(map * c);
    cell.radius = packing.radius;
    cell.cell   = map * Eigen::Matrix3d(packing.periodic_cell->asDiagonal());
    return cell;
  }
} // namespace

TEST_CASE("relaxed stiffness: never above the affine one, for 100 random strains", "[dem][homogenisation]")
{
  dem::UniformRandom random(11);
  for (const double ratio : {0.05, 1.0, 10.0})
    {
      const auto    network = dem::make_network(random_spheres(150, 3), links(1.6, ratio));
      const Matrix6 affine  = dem::affine_stiffness(network);
      const Matrix6 relaxed = dem::relaxed_stiffness(network).stiffness;
      for (int k = 0; k < 100; ++k)
        {
          base::Vector6 E;
          for (int c = 0; c < 6; ++c)
            E[c] = random() - 0.5;
          const double upper = E.dot(affine * E), energy = E.dot(relaxed * E);
          REQUIRE(energy <= upper * (1 + 1e-14)); // rounding of the two sums
          REQUIRE(energy > 0);
        }
    }
}

TEST_CASE("relaxed stiffness: symmetric, by condensation as by energy", "[dem][homogenisation]")
{
  const auto    network = dem::make_network(random_spheres(150, 4), links(1.6, 0.2));
  const auto    relaxed = dem::relaxed_stiffness(network, tight());
  const Matrix6 D       = relaxed.stiffness;
  CHECK((D - D.transpose()).norm() <= 1e-12 * D.norm());

  // Independent of the energy: mean stress of the link forces, (1/V) sum l (x) f, under each unit strain.
  Matrix6 stress = Matrix6::Zero();
  for (const dem::ElasticLink &l : network.links)
    {
      const Eigen::Matrix<double, 3, 6> f = l.stiffness * dem::strain_localisation(l, relaxed) * l.branch.norm();
      for (int c = 0; c < 6; ++c)
        {
          const Eigen::Matrix3d s = l.branch * f.col(c).transpose();
          stress.col(c) += (base::Vector6() << s(0, 0), s(1, 1), s(2, 2), (s(1, 2) + s(2, 1)) / 2,
                            (s(2, 0) + s(0, 2)) / 2, (s(0, 1) + s(1, 0)) / 2)
                             .finished() /
                           network.volume;
        }
    }
  CHECK(relative_difference(stress, D) < 1e-10); // first order in the residual 1e-12
  CHECK((stress - stress.transpose()).norm() < 1e-10 * D.norm());
}

TEST_CASE("strain localisation: the energy of the links is that of the macroscopic stiffness", "[dem][homogenisation]")
{
  const double ratio   = 0.2;
  const auto   network = dem::make_network(eight_particles(), links(1.5, ratio));
  const auto   relaxed = dem::relaxed_stiffness(network, tight());
  Matrix6      energy  = Matrix6::Zero(); // (1/V) sum A L (E eps_N^2 + G eps_T^2), Hill
  for (const dem::ElasticLink &l : network.links)
    {
      const Eigen::Matrix<double, 3, 6> M      = dem::strain_localisation(l, relaxed);
      const Eigen::Matrix<double, 1, 6> normal = l.direction.transpose() * M;
      const Eigen::Matrix<double, 3, 6> shear  = M - l.direction * normal;
      energy +=
        l.area * l.branch.norm() / network.volume * (normal.transpose() * normal + ratio * shear.transpose() * shear);
    }
  CHECK(relative_difference(energy, relaxed.stiffness) < 1e-12);
}

TEST_CASE("relaxed stiffness: turning the packing turns the tensor", "[dem][homogenisation]")
{
  const auto            packing = random_spheres(120, 5);
  const Eigen::Matrix3d R       = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -0.7).normalized()).toRotationMatrix();
  const auto            p       = links(1.6, 0.2);
  const Matrix6         D       = dem::relaxed_stiffness(dem::make_network(packing, p), tight()).stiffness;
  const Matrix6         turned  = dem::relaxed_stiffness(dem::make_network(in_cell(packing, R), p), tight()).stiffness;
  // Stress turns like the tensor, strain with doubled shears: D' = T^-T D T^-1 with T the rotation of strains.
  const Matrix6 T_inverse = strain_rotation(R.transpose());
  CHECK(relative_difference(turned, T_inverse.transpose() * D * T_inverse) < 1e-10);
  CHECK(relative_difference(turned, D) > 1e-4); // the packing is not isotropic: the test can fail
}

TEST_CASE("relaxed stiffness: macroscopic strain on every link or on those across the cell, the same answer",
          "[dem][homogenisation]")
{
  for (const auto &network : {dem::make_network(eight_particles(), links(1.5, 0.2)),
                              dem::make_network(random_spheres(120, 6), links(1.6, 5.0)),
                              dem::make_network(six_discs(), plane_links(1.25, 0.2, 1.0))})
    {
      const auto fluctuation = dem::relaxed_stiffness(network, tight(), dem::CellFormulation::fluctuation);
      const auto total       = dem::relaxed_stiffness(network, tight(), dem::CellFormulation::total);
      CHECK(relative_difference(total.stiffness, fluctuation.stiffness) < 1e-12);
    }
}

TEST_CASE("relaxed stiffness: a cell and its double are the same material", "[dem][homogenisation]")
{
  auto twice = eight_particles();
  for (int i = 0; i < 8; ++i)
    {
      twice.centre.push_back(twice.centre[i] + Eigen::Vector3d(1, 0, 0));
      twice.radius.push_back(twice.radius[i]);
    }
  (*twice.periodic_cell)[0] = 2;
  const Matrix6 one = dem::relaxed_stiffness(dem::make_network(eight_particles(), links(1.5, 0.2)), tight()).stiffness;
  const Matrix6 two = dem::relaxed_stiffness(dem::make_network(twice, links(1.5, 0.2)), tight()).stiffness;
  CHECK(relative_difference(two, one) < 1e-12);
}

TEST_CASE("relaxed stiffness: blocking rotations stiffens, and so does any new link", "[dem][homogenisation]")
{
  const auto packing = random_spheres(120, 7);
  auto       blocked = links(1.6, 0.2);
  blocked.rotations  = false;
  const Matrix6 free = dem::relaxed_stiffness(dem::make_network(packing, links(1.6, 0.2))).stiffness;
  const Matrix6 held = dem::relaxed_stiffness(dem::make_network(packing, blocked)).stiffness;
  const Matrix6 more = dem::relaxed_stiffness(dem::make_network(packing, links(1.7, 0.2))).stiffness;
  for (int c = 0; c < 6; ++c)
    {
      CHECK(held(c, c) > free(c, c));
      CHECK(more(c, c) > free(c, c));
    }
}

TEST_CASE("relaxed stiffness: the same bits for one and two threads", "[dem][homogenisation]")
{
  const auto network = dem::make_network(random_spheres(600, 8), links(1.6, 0.2));
  const int  before  = omp_get_max_threads();
  omp_set_num_threads(1);
  const Matrix6 one = dem::relaxed_stiffness(network).stiffness;
  omp_set_num_threads(2);
  const Matrix6 two = dem::relaxed_stiffness(network).stiffness;
  omp_set_num_threads(before);
  CHECK(std::memcmp(one.data(), two.data(), sizeof(Matrix6)) == 0);
}
