#include "dem/measures/coordination.h"
#include "dem/measures/fabric.h"
#include "dem/measures/link_directions.h"
#include "measures_fixture.h"

#include <catch2/catch.hpp>

#include <numeric>

using namespace measures_fixture;

namespace
{
  /** The 12 corners of an icosahedron integrate polynomials up to degree 5 over the sphere exactly (a spherical 5-design). */
  std::vector<Eigen::Vector3d> icosahedron()
  {
    const double                 golden = 0.5 * (1 + std::sqrt(5.0));
    std::vector<Eigen::Vector3d> corners;
    for (const double a : {-1.0, 1.0})
      for (const double b : {-golden, golden})
        for (int d = 0; d < 3; ++d)
          {
            Eigen::Vector3d v;
            v[d]           = 0;
            v[(d + 1) % 3] = a;
            v[(d + 2) % 3] = b;
            corners.push_back(v.normalized());
          }
    return corners;
  }

  double delta(const int i, const int j) { return i == j ? 1.0 : 0.0; }

  /** Component ijkl out of a Mandel matrix. */
  double component(const base::Matrix6 &m, const int i, const int j, const int k, const int l)
  {
    const auto at = [](const int a, const int b) { return a == b ? a : 6 - a - b; };
    return m(at(i, j), at(k, l)) / ((i == j ? 1 : std::sqrt(2.0)) * (k == l ? 1 : std::sqrt(2.0)));
  }
} // namespace

TEST_CASE("fabric of even directions is that of the integrals over the sphere", "[dem][measures]")
{
  const dem::Fabric found = dem::fabric(icosahedron()), exact = dem::isotropic_fabric();
  REQUIRE((found.second - exact.second).norm() < 1e-15);
  REQUIRE((found.fourth - exact.fourth).norm() < 1e-15);
  REQUIRE(found.weight == 12);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      {
        REQUIRE(exact.second(i, j) == Approx(delta(i, j) / 3));
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l)
            {
              const double integral =
                (delta(i, j) * delta(k, l) + delta(i, k) * delta(j, l) + delta(i, l) * delta(j, k)) / 15;
              REQUIRE(component(exact.fourth, i, j, k, l) == Approx(integral).margin(1e-16));
            }
      }
}

TEST_CASE("fabric of even directions of the plane is that of the integrals over the circle", "[dem][measures]")
{
  std::vector<Eigen::Vector3d> circle; // regular pentagon: exact to degree 4
  for (int k = 0; k < 5; ++k)
    circle.push_back({std::cos(0.3 + 0.4 * M_PI * k), std::sin(0.3 + 0.4 * M_PI * k), 0});
  const dem::Fabric found = dem::fabric(circle), exact = dem::plane_isotropic_fabric();
  REQUIRE((found.second - exact.second).norm() < 1e-15);
  REQUIRE((found.fourth - exact.fourth).norm() < 1e-15);
  REQUIRE(exact.second(0, 0) == 0.5);
  REQUIRE(component(exact.fourth, 0, 0, 0, 0) == Approx(3.0 / 8));
  REQUIRE(component(exact.fourth, 0, 1, 0, 1) == Approx(1.0 / 8));
}

TEST_CASE("fabric is the mean of products, weighted, and turns with its directions", "[dem][measures]")
{
  dem::UniformRandom           random(4);
  std::vector<Eigen::Vector3d> n, turned;
  std::vector<double>          w;
  const Eigen::Matrix3d        Q = random_turn(random);
  for (int i = 0; i < 25; ++i)
    {
      n.push_back(random_direction(random));
      turned.push_back(Q * n.back());
      w.push_back(random());
    }
  const dem::Fabric f = dem::fabric(n, w), g = dem::fabric(turned, w);
  const double      total = std::accumulate(w.begin(), w.end(), 0.0);
  double            sum   = 0;
  for (int i = 0; i < 25; ++i)
    sum += w[i] * n[i][0] * n[i][1] * n[i][2] * n[i][2];
  REQUIRE(component(f.fourth, 0, 1, 2, 2) == Approx(sum / total).epsilon(1e-13));
  REQUIRE(component(f.fourth, 0, 2, 1, 2) == Approx(sum / total).epsilon(1e-13));
  REQUIRE(f.second.trace() == Approx(1.0).epsilon(1e-14));
  REQUIRE((g.second - Q * f.second * Q.transpose()).norm() < 1e-10);
  double rotated = 0; // Q_0a Q_1b Q_2c Q_2d F_abcd
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d)
          rotated += Q(0, a) * Q(1, b) * Q(2, c) * Q(2, d) * component(f.fourth, a, b, c, d);
  REQUIRE(std::abs(component(g.fourth, 0, 1, 2, 2) - rotated) < 1e-10);
}

TEST_CASE("fabric refuses what has no mean", "[dem][measures]")
{
  REQUIRE_THROWS_AS(dem::fabric({}), std::invalid_argument);
  REQUIRE_THROWS_AS(dem::fabric({{1, 0, 0}}, {1.0, 2.0}), std::invalid_argument);
  REQUIRE_THROWS_AS(dem::fabric({{1, 0, 0}}, {0.0}), std::invalid_argument);
}

TEST_CASE("the direction density of links drawn from a density is that density", "[dem][measures]")
{
  // Density (1 + d P2(cos))/(4 pi) about z, that is D = d diag(-1/2, -1/2, 1), drawn by rejection.
  const double                 d = 0.4;
  dem::UniformRandom           random(9);
  std::vector<Eigen::Vector3d> n;
  while (n.size() < 40000)
    {
      const Eigen::Vector3d v = random_direction(random);
      if (random() * (1 + d) < 1 + d * 0.5 * (3 * v.z() * v.z() - 1))
        n.push_back(v);
    }
  const auto s = dem::direction_statistics(n);
  REQUIRE(s.by_chance == Approx(7.5 / 200));
  // Standard deviation of one component of D: 7.5 sqrt(4/45)/200 = 0.011; three of them.
  REQUIRE(std::abs(s.density(2, 2) - d) < 0.034);
  REQUIRE(std::abs(s.density(0, 1)) < 0.034);
  REQUIRE(s.anisotropy == Approx(1.5 * d).margin(0.06)); // sqrt(3/2 D:D) = 3/2 d
}

TEST_CASE("even random directions show the anisotropy of chance", "[dem][measures]")
{
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    {
      dem::UniformRandom           random(seed);
      std::vector<Eigen::Vector3d> n;
      for (int i = 0; i < 100; ++i)
        n.push_back(random_direction(random));
      const auto s = dem::direction_statistics(n);
      sum += s.anisotropy * s.anisotropy / (s.by_chance * s.by_chance);
    }
  // a^2 is a sum of five squared normals: relative deviation sqrt(2/5), of the mean of 200 then 0.045; three of them.
  REQUIRE(sum / 200 == Approx(1.0).margin(0.14));
}

TEST_CASE("azimuths are counted modulo half a turn, steep directions left out", "[dem][measures]")
{
  std::vector<Eigen::Vector3d> n;
  const auto                   at = [&](const double degrees, const double z) {
    const double flat = std::sqrt(1 - z * z), angle = degrees * M_PI / 180;
    n.push_back({flat * std::cos(angle), flat * std::sin(angle), z});
  };
  at(10, 0.0), at(190, 0.5), at(100, -0.6), at(-80, 0.69), at(45, 0.71), at(179, 0.1);
  const auto h = dem::azimuth_histogram(n, 2, 4, 0.7);
  REQUIRE(h.count == std::vector<std::int64_t>{2, 0, 2, 1});
  REQUIRE(h.mean == 1.25);
  REQUIRE(h.least == 0);
  REQUIRE(h.most == 2);
  REQUIRE(h.deviation == Approx(std::sqrt((2 * 0.75 * 0.75 + 1.25 * 1.25 + 0.25 * 0.25) / 3)));
  // About x the angle runs from y towards z.
  REQUIRE(dem::azimuth_histogram({{0, 0, 1}, {0, 1, 0.01}}, 0, 4, 0.7).count == std::vector<std::int64_t>{1, 0, 1, 0});
}

TEST_CASE("coordination numbers count ends of links", "[dem][measures]")
{
  // A triangle with a tail; particle 4 floats; particle 5 is linked to its own image.
  const auto c = dem::coordination({{0, 1}, {1, 2}, {0, 2}, {2, 3}, {5, 5}}, 6);
  REQUIRE(c.of_particle == std::vector<std::int32_t>{2, 2, 3, 1, 0, 2});
  REQUIRE(c.particles == std::vector<std::int64_t>{1, 1, 3, 1});
  REQUIRE(c.mean == Approx(10.0 / 6));
  REQUIRE(c.mechanical == Approx(9.0 / 4));
  REQUIRE(c.with_at_most(1) == 2);
  REQUIRE(c.with_at_most(99) == 6);
  REQUIRE(dem::coordination({}, 3).mean == 0);
  REQUIRE(dem::coordination({}, 0).mean == 0);
  REQUIRE_THROWS_AS(dem::coordination({{0, 6}}, 6), std::invalid_argument);
}
