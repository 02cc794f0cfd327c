#include "dem/measures/damage_tensor.h"
#include "measures_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

using namespace measures_fixture;

namespace
{
  std::vector<dem::LinkDamage> imposed(const Eigen::Matrix3d &tensor, const int links, const std::uint64_t seed)
  {
    dem::UniformRandom           random(seed);
    std::vector<dem::LinkDamage> made;
    for (int i = 0; i < links; ++i)
      {
        const Eigen::Vector3d n = random_direction(random);
        made.push_back({n, n.dot(tensor * n)});
      }
    return made;
  }

  double mean(const std::vector<dem::LinkDamage> &links)
  {
    double sum = 0;
    for (const auto &l : links)
      sum += l.damage;
    return sum / static_cast<double>(links.size());
  }
} // namespace

TEST_CASE("damage tensor of three links along the axes is that of table 6.1", "[dem][measures]")
{
  struct Row
  {
    Eigen::Vector3d damage, tensor;
    double          mean;
  };
  const Row table[] = {{{1, 1, 1}, {1, 1, 1}, 1.0},
                       {{1, 1, 0}, {1.5, 1.5, -1}, 2.0 / 3},
                       {{1, 0, 0}, {2, -0.5, -0.5}, 1.0 / 3},
                       {{0.5, 0.5, 0}, {0.75, 0.75, -0.5}, 1.0 / 3},
                       {{0.5, 0, 0}, {1, -0.25, -0.25}, 1.0 / 6}};
  for (const Row &row : table)
    {
      std::vector<dem::LinkDamage> links;
      for (int d = 0; d < 3; ++d)
        links.push_back({Eigen::Vector3d::Unit(d), row.damage[d]});
      const Eigen::Matrix3d found = dem::damage_tensor_even(links);
      REQUIRE((found - Eigen::Matrix3d(row.tensor.asDiagonal())).norm() < 1e-15);
      REQUIRE(found.trace() / 3 == Approx(row.mean).epsilon(1e-15));
      REQUIRE_FALSE(dem::damage_tensor_fitted(links)); // three directions cannot determine six components
    }
}

TEST_CASE("the fit returns a tensor imposed along 30 random directions, the form for even directions does not",
          "[dem][measures]")
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
      dem::UniformRandom    random(1000 + seed);
      const Eigen::Matrix3d tensor = random_symmetric(random);
      const auto            links  = imposed(tensor, 30, seed);
      const auto            fit    = dem::damage_tensor_fitted(links);
      REQUIRE(fit);
      REQUIRE((*fit - tensor).norm() < 1e-12 * tensor.norm());
      REQUIRE((dem::damage_tensor_even(links) - tensor).norm() > 0.05 * tensor.norm());
    }
}

TEST_CASE("both forms agree on directions that are even", "[dem][measures]")
{
  // Axes and cube corners with weights 8 : 9 integrate degree 5 exactly (McLaren, 1963): repeat them in that proportion.
  dem::UniformRandom           random(3);
  const Eigen::Matrix3d        tensor = random_symmetric(random);
  std::vector<dem::LinkDamage> links;
  const auto                   add = [&](const Eigen::Vector3d &n, const int times) {
    links.insert(links.end(), times, dem::LinkDamage{n, n.dot(tensor * n)});
  };
  for (int d = 0; d < 3; ++d)
    add(Eigen::Vector3d::Unit(d), 2 * 8);
  for (int corner = 0; corner < 4; ++corner)
    add(Eigen::Vector3d(1, corner & 1 ? 1 : -1, corner & 2 ? 1 : -1).normalized(), 2 * 9);
  REQUIRE((dem::damage_tensor_even(links) - tensor).norm() < 1e-14);
  REQUIRE((*dem::damage_tensor_fitted(links) - tensor).norm() < 1e-14);
}

TEST_CASE("ten thousand random directions return the tensor by the even form within 0.03", "[dem][measures]")
{
  Eigen::Matrix3d tensor;
  tensor << 0.6, 0.1, 0.0, 0.1, 0.3, -0.1, 0.0, -0.1, 0.2;
  const auto            links = imposed(tensor, 10000, 17);
  const Eigen::Matrix3d found = dem::damage_tensor_even(links);
  REQUIRE((found - tensor).cwiseAbs().maxCoeff() < 0.03); // doc/theory/sequential-transfer.md, 1
  REQUIRE(found.trace() / 3 == Approx(mean(links)).epsilon(1e-12));
}

TEST_CASE("damage tensors turn with the directions", "[dem][measures]")
{
  dem::UniformRandom    random(12);
  const Eigen::Matrix3d Q     = random_turn(random);
  auto                  links = imposed(random_symmetric(random), 25, 2);
  for (auto &l : links)
    l.damage = random(); // not exactly a tensor: what is left over must not spoil covariance
  const Eigen::Matrix3d even = dem::damage_tensor_even(links), fit = *dem::damage_tensor_fitted(links);
  for (auto &l : links)
    l.direction = Q * l.direction;
  REQUIRE((dem::damage_tensor_even(links) - Q * even * Q.transpose()).norm() < 1e-10);
  REQUIRE((*dem::damage_tensor_fitted(links) - Q * fit * Q.transpose()).norm() < 1e-10);
}

TEST_CASE("the fit leaves the smallest squares", "[dem][measures]")
{
  dem::UniformRandom random(6);
  auto               links = imposed(Eigen::Matrix3d::Identity(), 40, 5);
  for (auto &l : links)
    l.damage = random();
  const Eigen::Matrix3d fit    = *dem::damage_tensor_fitted(links);
  const auto            misfit = [&](const Eigen::Matrix3d &t) {
    double sum = 0;
    for (const auto &l : links)
      sum += std::pow(l.damage - l.direction.dot(t * l.direction), 2);
    return sum;
  };
  for (int trial = 0; trial < 50; ++trial)
    REQUIRE(misfit(fit + 1e-3 * random_symmetric(random)) > misfit(fit));
}

TEST_CASE("discs: both forms in the plane", "[dem][measures]")
{
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  tensor.topLeftCorner<2, 2>() << 0.5, 0.2, 0.2, -0.1;
  std::vector<dem::LinkDamage> even, uneven;
  for (int k = 0; k < 9; ++k)
    {
      const double          a = 0.1 + 2 * M_PI * k / 9, b = 0.05 * k * k;
      const Eigen::Vector3d n(std::cos(a), std::sin(a), 0), m(std::cos(b), std::sin(b), 0);
      even.push_back({n, n.dot(tensor * n)});
      uneven.push_back({m, m.dot(tensor * m)});
    }
  REQUIRE((dem::damage_tensor_even(even, 2) - tensor).norm() < 1e-14);
  REQUIRE(dem::damage_tensor_even(even, 2).trace() / 2 == Approx(mean(even)));
  REQUIRE((*dem::damage_tensor_fitted(uneven, 2) - tensor).norm() < 1e-13);
  REQUIRE((dem::damage_tensor_even(uneven, 2) - tensor).norm() > 0.05);
}

TEST_CASE("the fit refuses directions that do not determine a tensor", "[dem][measures]")
{
  std::vector<dem::LinkDamage> flat;
  for (int k = 0; k < 40; ++k)
    flat.push_back({{std::cos(0.1 * k), std::sin(0.1 * k), 0.0}, 0.5});
  REQUIRE_FALSE(dem::damage_tensor_fitted(flat));
  REQUIRE_FALSE(dem::damage_tensor_fitted(imposed(Eigen::Matrix3d::Identity(), 11, 1)));
  REQUIRE(dem::damage_tensor_fitted(imposed(Eigen::Matrix3d::Identity(), 30, 1)));
}

TEST_CASE("each particle's damage tensor is over its own links", "[dem][measures]")
{
  // Particle 0 has 30 links that determine its tensor; each of the 30 others has one.
  dem::UniformRandom                      random(2);
  const Eigen::Matrix3d                   tensor = random_symmetric(random);
  const auto                              links  = imposed(tensor, 30, 7);
  std::vector<std::array<std::size_t, 2>> ends;
  for (std::size_t k = 1; k <= 30; ++k)
    ends.push_back({0, k});
  const auto found = dem::particle_damage(ends, links, 32, dem::DamageFit::fitted);
  REQUIRE(found[0].fitted);
  REQUIRE(found[0].links == 30);
  REQUIRE((found[0].tensor - tensor).norm() < 1e-12);
  REQUIRE_FALSE(found[4].fitted);
  REQUIRE((found[4].tensor - dem::damage_tensor_even({links[3]})).norm() == 0);
  REQUIRE(found[31].links == 0);
  REQUIRE(found[31].tensor.norm() == 0);
  const auto even = dem::particle_damage(ends, links, 32, dem::DamageFit::even);
  REQUIRE((even[0].tensor - dem::damage_tensor_even(links)).norm() == 0);
  REQUIRE_THROWS_AS(dem::particle_damage({}, links, 32, dem::DamageFit::even), std::invalid_argument);
}

TEST_CASE("conversion from the published factor gives the printed tensors", "[dem][measures]")
{
  // Published states (doc/theory/sequential-transfer.md, 3), columns Omega' (factor 12) and Omega (factor 15), cases 002, 005, 010; six decimals.
  const Eigen::Vector3d published[] = {
    {0.108375, 0.101605, -0.087772}, {0.508975, 0.466284, -0.224915}, {0.538756, 0.507998, -0.138130}};
  const Eigen::Vector3d consistent[] = {
    {0.166021, 0.157559, -0.079163}, {0.823804, 0.770441, -0.093558}, {0.900601, 0.862154, 0.054494}};
  for (int i = 0; i < 3; ++i)
    {
      const Eigen::Matrix3d from = published[i].asDiagonal(), to = consistent[i].asDiagonal();
      // Each printed value is off by up to 5e-7, times 1.25 + 3 x 0.25 plus its own.
      REQUIRE((dem::from_published_factor(from) - to).cwiseAbs().maxCoeff() < 1.6e-6);
      REQUIRE((dem::with_published_factor(to) - from).cwiseAbs().maxCoeff() < 1.6e-6);
    }
}
