#include "base/errors.h"
#include "dem/neighbours/cell_list.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

namespace
{
  struct Cloud
  {
    std::vector<Eigen::Vector3d> centre;
    std::vector<double>          radius;
  };

  /** Random centres in a box, some of them outside by up to `stray` box lengths; radii log-uniform in [1, ratio] x smallest. */
  Cloud random_cloud(const unsigned         seed,
                     const std::size_t      n,
                     const Eigen::Vector3d &box,
                     const double           smallest,
                     const double           ratio,
                     const double           stray)
  {
    std::mt19937_64 engine(seed);
    const auto      uniform = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
    Cloud           cloud;
    for (std::size_t i = 0; i < n; ++i)
      {
        Eigen::Vector3d x;
        for (int d = 0; d < 3; ++d)
          x[d] = box[d] * (uniform() * (1 + 2 * stray) - stray);
        cloud.centre.push_back(x);
        cloud.radius.push_back(smallest * std::pow(ratio, uniform()));
      }
    return cloud;
  }

  /** Every pair and every image up to `images` cells away, one comparison each. */
  std::vector<dem::NeighbourPair> by_comparison(
    const Cloud &cloud, const double factor, const double skin, const Eigen::Matrix3d &cell, const int images)
  {
    std::vector<dem::NeighbourPair> pairs;
    const int                       n = static_cast<int>(cloud.centre.size());
    for (int j = 0; j < n; ++j)
      for (int k = j; k < n; ++k)
        for (int a = -images; a <= images; ++a)
          for (int b = -images; b <= images; ++b)
            for (int c = -images; c <= images; ++c)
              {
                const bool mirror = j == k && (a < 0 || (a == 0 && (b < 0 || (b == 0 && c <= 0))));
                if (mirror)
                  continue;
                const double          reach  = factor * (cloud.radius[j] + cloud.radius[k]) + skin;
                const Eigen::Vector3d branch = cloud.centre[k] + cell * Eigen::Vector3d(a, b, c) - cloud.centre[j];
                if (branch.norm() < reach)
                  pairs.push_back(
                    {j, k, {{static_cast<std::int8_t>(a), static_cast<std::int8_t>(b), static_cast<std::int8_t>(c)}}});
              }
    return pairs; // in the order of the loops: first, second, shift
  }
} // namespace

TEST_CASE("pairs of a free packing are those of a comparison of all with all", "[dem][neighbours]")
{
  for (unsigned seed = 0; seed < 6; ++seed)
    {
      const double ratio = seed % 2 == 0 ? 1.0 : 50.0;
      const Cloud  cloud = random_cloud(seed, 500, {3.0, 2.0, 1.0}, ratio > 1 ? 0.02 : 0.2, ratio, 0.3);
      const auto   found = dem::find_pairs(cloud.centre, cloud.radius, 1.2, 0.02, std::nullopt);
      REQUIRE(found.size() > 1000);
      REQUIRE(found == by_comparison(cloud, 1.2, 0.02, Eigen::Matrix3d::Identity(), 0));
    }
}

TEST_CASE("pairs of a periodic packing are those of a comparison of all images", "[dem][neighbours]")
{
  const Eigen::Vector3d box(1.0, 1.3, 0.8);
  for (unsigned seed = 0; seed < 6; ++seed)
    {
      const double ratio = seed % 2 == 0 ? 1.0 : 50.0;
      const Cloud  cloud = random_cloud(seed, 250, box, ratio > 1 ? 0.006 : 0.08, ratio, 1.0);
      const auto   found = dem::find_pairs(cloud.centre, cloud.radius, 1.1, 0.01, box);
      REQUIRE(found.size() > 500);
      // Centres stray one cell either way, two apart at most; the reach is below one more.
      REQUIRE(found == by_comparison(cloud, 1.1, 0.01, box.asDiagonal(), 4));
    }
}

TEST_CASE("a cell smaller than the reach links particles to several images and to their own", "[dem][neighbours]")
{
  const Eigen::Vector3d box(4.0, 4.5,
                            5.0); // four radii, the smallest cell in use; and again with a reach of three cells
  const Cloud           cloud = random_cloud(7, 12, box, 0.9, 1.4, 0.5);
  for (const double factor : {1.5, 6.0})
    {
      const auto found    = dem::find_pairs(cloud.centre, cloud.radius, factor, 0.0, box);
      const auto expected = by_comparison(cloud, factor, 0.0, box.asDiagonal(), 7);
      REQUIRE(found == expected);
      REQUIRE(std::any_of(found.begin(), found.end(), [](const auto &p) { return p.first == p.second; }) ==
              (factor > 2));
    }
}

TEST_CASE("one particle alone in a periodic cell is linked to half of its images within reach", "[dem][neighbours]")
{
  // Simple cubic lattice of unit edge: 6 images at 1, 12 at sqrt 2, 8 at sqrt 3, 6 at 2: the halves are 3, 9, 13, 16.
  const std::vector<Eigen::Vector3d> centre = {{0.3, 17.2, -0.4}};
  const Eigen::Vector3d              box(1, 1, 1);
  const std::vector<double>          radius = {0.5};
  REQUIRE(dem::find_pairs(centre, radius, 0.99, 0.0, box).size() == 0);
  REQUIRE(dem::find_pairs(centre, radius, 1.01, 0.0, box).size() == 3);
  REQUIRE(dem::find_pairs(centre, radius, 1.42, 0.0, box).size() == 9);
  REQUIRE(dem::find_pairs(centre, radius, 1.74, 0.0, box).size() == 13);
  REQUIRE(dem::find_pairs(centre, radius, 1.74, 0.3, box).size() == 16);
}

TEST_CASE("pairs in a sheared cell are those of a comparison of all images", "[dem][neighbours]")
{
  Eigen::Matrix3d cell;
  cell << 1.0, 0.4, -0.2, 0.1, 1.2, 0.5, 0.0, -0.3, 0.9;
  Cloud cloud = random_cloud(3, 200, {1, 1, 1}, 0.03, 5.0, 0.5);
  for (Eigen::Vector3d &x : cloud.centre)
    x = cell * x;
  const auto found = dem::find_pairs_sheared(cloud.centre, cloud.radius, 1.5, 0.0, cell);
  REQUIRE(found.size() > 500);
  REQUIRE(found == by_comparison(cloud, 1.5, 0.0, cell, 4));
}

TEST_CASE("an infinite cell edge does not repeat", "[dem][neighbours]")
{
  const double          far = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d slab(1.0, 1.3, far);
  const Cloud           cloud = random_cloud(5, 300, {1.0, 1.3, 0.7}, 0.03, 3.0, 0.0);
  const auto            found = dem::find_pairs(cloud.centre, cloud.radius, 1.5, 0.0, slab);
  // The reference repeats along z as well, at a distance nothing reaches over.
  REQUIRE(found == by_comparison(cloud, 1.5, 0.0, Eigen::Vector3d(1.0, 1.3, 100.0).asDiagonal(), 2));
}

TEST_CASE("discs in a plane and degenerate clouds are found too", "[dem][neighbours]")
{
  Cloud flat = random_cloud(11, 400, {1.0, 1.0, 0.0}, 0.02, 4.0, 0.0);
  REQUIRE(dem::find_pairs(flat.centre, flat.radius, 1.3, 0.0, std::nullopt) ==
          by_comparison(flat, 1.3, 0.0, Eigen::Matrix3d::Identity(), 0));
  REQUIRE(dem::find_pairs({}, {}, 1.5, 0.0, std::nullopt).empty());
  REQUIRE(dem::find_pairs({{1, 2, 3}}, {1.0}, 1.5, 0.0, std::nullopt).empty());
  // One speck a million radii away must neither be lost nor cost a million cells.
  flat.centre.push_back({1e5, -1e5, 1e5});
  flat.radius.push_back(0.1);
  REQUIRE(dem::find_pairs(flat.centre, flat.radius, 1.3, 0.0, std::nullopt) ==
          by_comparison(flat, 1.3, 0.0, Eigen::Matrix3d::Identity(), 0));
}

TEST_CASE("the pair list does not depend on the number of threads", "[dem][neighbours]")
{
  const Eigen::Vector3d box(1, 1, 1);
  const Cloud           cloud  = random_cloud(2, 20000, box, 0.003, 10.0, 0.0);
  const int             before = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto one = dem::find_pairs(cloud.centre, cloud.radius, 1.5, 0.0, box);
  omp_set_num_threads(3);
  const auto three = dem::find_pairs(cloud.centre, cloud.radius, 1.5, 0.0, box);
  omp_set_num_threads(before);
  REQUIRE(one.size() > 20000);
  REQUIRE(one == three);
  REQUIRE(std::is_sorted(one.begin(), one.end()));
}

TEST_CASE("the neighbour search names what it cannot use", "[dem][neighbours]")
{
  using Catch::Contains;
  const double                 nan    = std::numeric_limits<double>::quiet_NaN();
  std::vector<Eigen::Vector3d> centre = {{0, 0, 0}, {1, 0, 0}};
  const std::vector<double>    radius = {1.0, 1.0};
  REQUIRE_THROWS_WITH(dem::find_pairs(centre, {1.0}, 1.0, 0.0, std::nullopt), Contains("2 centres but 1 radii"));
  REQUIRE_THROWS_WITH(dem::find_pairs(centre, radius, -1.0, 0.0, std::nullopt), Contains("not negative"));
  REQUIRE_THROWS_WITH(dem::find_pairs(centre, radius, 1.0, 0.0, Eigen::Vector3d(1, 0, 1)), Contains("cell edge"));
  REQUIRE_THROWS_WITH(dem::find_pairs_sheared(centre, radius, 1.0, 0.0, Eigen::Matrix3d::Zero()),
                      Contains("determinant"));
  centre[1][2] = nan;
  REQUIRE_THROWS_AS(dem::find_pairs(centre, radius, 1.0, 0.0, std::nullopt), base::NumericalError);
  REQUIRE_THROWS_WITH(dem::find_pairs(centre, radius, 1.0, 0.0, std::nullopt), Contains("particle 2"));
  centre[1] = {3000.5, 0, 0};
  REQUIRE_THROWS_WITH(dem::find_pairs(centre, radius, 1.0, 0.0, Eigen::Vector3d(10, 10, 10)),
                      Contains("more than 127"));
}

TEST_CASE("pairs of a range of particles are those of all pairs that have an end in it", "[dem][neighbours]")
{
  // Ranges lie along a line through the box, so that most of it is far from each; radii by a factor of 1 or 20; centres outside the cell too.
  const auto along_z = [](Cloud cloud) {
    std::sort(cloud.centre.begin(), cloud.centre.end(),
              [](const Eigen::Vector3d &a, const Eigen::Vector3d &b) { return a.z() < b.z(); });
    return cloud;
  };
  const Eigen::Vector3d box(1.0, 0.8, 6.0);
  Eigen::Matrix3d       sheared = box.asDiagonal();
  sheared(0, 2)                 = 1.3;
  sheared(1, 0)                 = 0.2;
  const auto check              = [](const Cloud &cloud, const auto &find) {
    const auto  n     = static_cast<std::int32_t>(cloud.centre.size());
    const auto  all   = find(dem::PairsOf());
    std::size_t parts = 0;
    REQUIRE(all.size() > cloud.centre.size());
    for (const dem::PairsOf &of : {dem::PairsOf{0, n / 3}, dem::PairsOf{n / 3, n / 3 + 1}, dem::PairsOf{n / 2, n},
                                   dem::PairsOf{n / 2, n / 2}, dem::PairsOf{0, n}, dem::PairsOf{n - 5, n + 100}})
      {
        std::vector<dem::NeighbourPair> expected;
        std::copy_if(all.begin(), all.end(), std::back_inserter(expected),
                                  [&](const dem::NeighbourPair &pair) { return of.has(pair); });
        CHECK(find(of) == expected);
        parts += expected.size();
      }
    CHECK(parts > all.size());
  };
  for (unsigned seed = 0; seed < 4; ++seed)
    {
      const double ratio = seed % 2 == 0 ? 1.0 : 20.0;
      const Cloud  cloud = along_z(random_cloud(seed, 700, box, ratio > 1 ? 0.02 : 0.1, ratio, 0.2));
      Cloud        flat  = cloud;
      for (Eigen::Vector3d &x : flat.centre)
        x = {x.z(), x.y(), 0};
      check(cloud, [&](const dem::PairsOf &of) {
        return dem::find_pairs(cloud.centre, cloud.radius, 1.2, 0.02, std::nullopt, of);
      });
      check(cloud,
            [&](const dem::PairsOf &of) { return dem::find_pairs(cloud.centre, cloud.radius, 1.2, 0.02, box, of); });
      check(cloud, [&](const dem::PairsOf &of) {
        return dem::find_pairs_sheared(cloud.centre, cloud.radius, 1.2, 0.02, sheared, of);
      });
      check(flat, [&](const dem::PairsOf &of) {
        return dem::find_pairs(flat.centre, flat.radius, 1.2, 0.02, std::nullopt, of);
      });
    }
}
