#include "base/errors.h"
#include "dem/neighbours/cell_list.h"
#include "dem/packing/compaction.h"
#include "dem/packing/tiling.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using Catch::Contains;

namespace
{
  dem::CompactionParameters spheres(const std::size_t count, const double friction, const double damping)
  {
    dem::CompactionParameters p;
    p.radius   = 1e-3;
    p.count    = count;
    p.friction = friction;
    p.damping  = damping;
    return p;
  }

  std::vector<dem::NeighbourPair> links(const dem::Packing &packing, const double interaction_ratio)
  {
    return dem::find_pairs(packing.centre, packing.radius, interaction_ratio, 0.0, packing.periodic_cell);
  }

  Eigen::Vector3d branch(const dem::Packing &packing, const dem::NeighbourPair &pair)
  {
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    if (packing.periodic_cell)
      for (int d = 0; d < 3; ++d)
        shift[d] = pair.shift[d] * (*packing.periodic_cell)[d];
    return packing.centre[pair.second] + shift - packing.centre[pair.first];
  }

  /** What follows from the centres alone when the spheres are frictionless; lengths in diameters, k_n = 1. */
  struct Recomputed
  {
    double pressure = 0, overlap = 0, unbalanced_ratio = 0, coordination = 0;

    explicit Recomputed(const dem::Packing &packing)
    {
      const double                 diameter = 2 * packing.radius[0];
      std::vector<Eigen::Vector3d> force(packing.size(), Eigen::Vector3d::Zero());
      const auto                   contacts = links(packing, 1.0);
      double                       virial   = 0;
      for (const auto &pair : contacts)
        {
          const Eigen::Vector3d l    = branch(packing, pair) / diameter;
          const double          push = 1 - l.norm();
          force[pair.first] -= push * l.normalized();
          force[pair.second] += push * l.normalized();
          virial += push * l.norm();
          overlap += push / static_cast<double>(contacts.size());
        }
      for (const Eigen::Vector3d &f : force)
        unbalanced_ratio += f.norm() / static_cast<double>(packing.size()) / overlap;
      pressure     = virial / (3 * (*packing.periodic_cell / diameter).prod()); // p (2r)/k_n
      coordination = 2.0 * static_cast<double>(contacts.size()) / static_cast<double>(packing.size());
    }
  };
} // namespace

TEST_CASE("one sphere in its periodic cell is compacted to the closed form", "[dem][packing]")
{
  // It touches its six images: p = k_n overlap / L^2, hence with s = overlap/2r: p 2r/k_n = s/(1 - s)^2.
  auto p          = spheres(1, 0.5, 0.6);
  p.low_pressure  = 0.02;
  const auto   r  = dem::compact(p);
  const double s  = r.mean_overlap;
  const double pf = M_PI / 6 / std::pow(1 - s, 3);
  REQUIRE(s / ((1 - s) * (1 - s)) == Approx(0.02).epsilon(0.01)); // the servo's tolerance
  REQUIRE(r.packing_fraction == Approx(pf).epsilon(1e-12));
  REQUIRE(r.coordination == 6.0);
}

TEST_CASE("with friction a packing stands on fewer contacts, as counting forces and equations demands",
          "[dem][packing]")
{
  // Maxwell: spheres that carry load have z/2 contacts each. Without friction 3 equations and z/2 forces, hence z >= 6; with
  // friction 6 equations and 3 z/2 forces, hence z >= 4, approached by high friction.
  const auto smooth = dem::compact(spheres(300, 0.0, 0.6)), rough = dem::compact(spheres(300, 1.0, 0.6));
  const auto carrying = [](const dem::CompactionResult &r) {
    std::vector<int> contacts(r.packing.size(), 0);
    for (const auto &pair : links(r.packing, 1.0))
      {
        ++contacts[pair.first];
        ++contacts[pair.second];
      }
    double sum = 0, spheres = 0;
    for (const int c : contacts)
      if (c >= 2) // rattlers touch nothing, or barely one
        {
          sum += c;
          spheres += 1;
        }
    return sum / spheres;
  };
  REQUIRE(carrying(smooth) > 6.0 - 0.1); // equilibrium is not complete: the last contacts may be about to close
  REQUIRE(carrying(rough) > 4.0 - 0.1);
  REQUIRE(carrying(rough) < 5.0);
}

TEST_CASE("what the compaction reports follows from the centres", "[dem][packing]")
{
  const auto       r = dem::compact(spheres(500, 0.0, 0.6));
  const Recomputed known(r.packing);
  REQUIRE(known.pressure == Approx(1e-3).epsilon(0.01)); // the servo's tolerance
  REQUIRE(known.unbalanced_ratio < 1e-3);
  // The same sums in another order, of overlaps that are differences of lengths a thousand times larger.
  REQUIRE(r.unbalanced_ratio == Approx(known.unbalanced_ratio).epsilon(1e-6));
  REQUIRE(r.mean_overlap == Approx(known.overlap).epsilon(1e-9));
  REQUIRE(r.coordination == known.coordination);
  REQUIRE(r.packing_fraction == Approx(500 * 4.0 / 3.0 * M_PI * 1e-9 / r.packing.periodic_cell->prod()).epsilon(1e-13));
  for (const Eigen::Vector3d &x : r.packing.centre)
    REQUIRE((x.minCoeff() >= 0 && (*r.packing.periodic_cell - x).minCoeff() >= 0));
}

TEST_CASE("packings of little friction have the published packing fraction", "[dem][packing]")
{
  // Stransky (2018), 240 packings with friction 0.1 and damping 0.8: 0.6152 (std 0.0016) for 500 to 1000 spheres,
  // 0.6143 (0.0019) for 1000 to 1500. Four packings, three standard deviations.
  double mean = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4})
    {
      auto p       = spheres(1000, 0.1, 0.8);
      p.seed       = seed;
      const auto r = dem::compact(p);
      REQUIRE(r.packing_fraction > 0.605);
      REQUIRE(r.packing_fraction < 0.645);
      mean += r.packing_fraction / 4;
    }
  REQUIRE(mean == Approx(0.6148).margin(3 * 0.0018));
}

TEST_CASE("the more friction the looser the packing, as the table of expected packing fractions says",
          "[dem][packing][slow]")
{
  // The table is a mean over twelve seeds; four others scatter by 0.002 to 0.0045 each, three times half of that here.
  for (const double friction : {0.0, 0.2, 0.5, 1.0})
    {
      double mean = 0;
      for (const std::uint64_t seed : {13, 14, 15, 16})
        {
          auto p = spheres(1000, friction, dem::CompactionParameters().damping);
          p.seed = seed;
          mean += dem::compact(p).packing_fraction / 4;
        }
      INFO("friction " << friction);
      REQUIRE(mean == Approx(dem::expected_packing_fraction(friction)).margin(3 * 0.0045 / 2));
    }
}

TEST_CASE("default packings repeated to a 50 mm cube have the published particles and links", "[dem][packing][slow]")
{
  // Stransky (2018): cell edge 19.652 mm (packing fraction 0.5519, 13.50 links per sphere at 1.5) and 19.727 mm (0.5456);
  // the first, cropped to the cube, gives 14,556 particles and 91,483 links. Three seeds, whose links scatter by 1.3 %.
  double particles = 0, in_cube = 0, per_sphere = 0, fraction = 0;
  for (const std::uint64_t seed : {1, 2, 3})
    {
      auto p            = spheres(1000, dem::CompactionParameters().friction, dem::CompactionParameters().damping);
      p.seed            = seed;
      const auto r      = dem::compact(p);
      const auto tiling = dem::tile_and_crop(r.packing, {0.05, 0.05, 0.05});
      REQUIRE(tiling.note.empty());
      particles += static_cast<double>(tiling.packing.size()) / 3;
      in_cube += static_cast<double>(links(tiling.packing, 1.5).size()) / 3;
      per_sphere += 2.0 * static_cast<double>(links(r.packing, 1.5).size()) / 1000 / 3;
      fraction += r.packing_fraction / 3;
    }
  REQUIRE(particles == Approx(14556).epsilon(0.03));
  REQUIRE(in_cube == Approx(91483).epsilon(0.03));
  REQUIRE(per_sphere == Approx(13.5).margin(0.3));
  REQUIRE(fraction > 0.5456 - 0.006); // the two published cells differ by as much
  REQUIRE(fraction < 0.5519 + 0.006);
}

TEST_CASE("a large dense packing is isotropic", "[dem][packing][slow]")
{
  // Stransky (2018): 4000 spheres, links at 1.5 with |n_z| <= 0.7 in 32 sectors of the xy plane: mean 632, std 29,
  // min 576, max 706. Four of those standard deviations, as a single packing differs from a single one.
  const auto r         = dem::compact(spheres(4000, 0.1, 0.8));
  const auto all       = links(r.packing, 1.5);
  double     count[32] = {}, total = 0;
  for (const auto &pair : all)
    {
      const Eigen::Vector3d n = branch(r.packing, pair).normalized();
      if (std::abs(n.z()) > 0.7)
        continue;
      const double angle = std::atan2(n.y(), n.x()); // a direction and its opposite are one
      const double part  = (angle < 0 ? angle + M_PI : angle) / M_PI;
      count[std::min(31, static_cast<int>(32 * part))] += 1;
      total += 1;
    }
  const double mean     = total / 32;
  double       variance = 0;
  for (const double c : count)
    {
      REQUIRE(std::abs(c - mean) < 4 * 29);
      variance += (c - mean) * (c - mean) / 31;
    }
  REQUIRE(mean == Approx(632).epsilon(0.03));
  REQUIRE(std::sqrt(variance) < 29 + 4 * 29 / std::sqrt(62.0)); // sampling error of a standard deviation of 32 values
  REQUIRE(2.0 * static_cast<double>(all.size()) / 4000 == Approx(14.5).margin(0.3));
}

TEST_CASE("one seed gives one packing, whatever the threads and the size of the spheres", "[dem][packing]")
{
  auto       p     = spheres(200, 0.5, 0.6);
  const auto first = dem::compact(p);

  const int before = omp_get_max_threads();
  omp_set_num_threads(3);
  const auto again = dem::compact(p);
  omp_set_num_threads(before);
  REQUIRE(again.steps == first.steps);
  REQUIRE(again.packing.centre == first.packing.centre);

  p.radius          = 1e-3 * 1024; // a power of two: no rounding
  const auto larger = dem::compact(p);
  for (std::size_t i = 0; i < 200; ++i)
    REQUIRE(larger.packing.centre[i] == 1024 * first.packing.centre[i]);

  p.seed = 2;
  REQUIRE(dem::compact(p).packing.centre != larger.packing.centre);
}

TEST_CASE("the compaction reports its progress and stops on request", "[dem][packing]")
{
  std::int64_t last  = 0;
  int          stage = 1;
  const auto   r     = dem::compact(spheres(100, 0.1, 0.8), [&](const dem::CompactionProgress &now) {
    REQUIRE(now.steps == last + 20);
    REQUIRE(now.stage >= stage);
    REQUIRE(now.packing_fraction > 0.15);
    last  = now.steps;
    stage = now.stage;
    return true;
  });
  REQUIRE(stage == 2);
  REQUIRE(r.steps == last);
  REQUIRE_THROWS_AS(dem::compact(spheres(100, 0.1, 0.8), [](const auto &now) { return now.steps < 100; }),
                    dem::CompactionCancelled);
}

TEST_CASE("a compaction that finds no equilibrium reports how far it came", "[dem][packing]")
{
  auto p       = spheres(100, 0.1, 0.8);
  p.step_limit = 100;
  REQUIRE_THROWS_AS(dem::compact(p), dem::CompactionFailed);
  REQUIRE_THROWS_WITH(dem::compact(p), Contains("step limit = 100") && Contains("stage 1 of 2") && Contains("Raise"));
}

TEST_CASE("parameters without sense are refused by name", "[dem][packing]")
{
  const double nan     = std::numeric_limits<double>::quiet_NaN();
  const auto   refusal = [](const auto &change) {
    auto p = spheres(10, 0.5, 0.6);
    change(p);
    dem::compact(p);
  };
  using P = dem::CompactionParameters;
  REQUIRE_THROWS_WITH(refusal([](P &p) { p.radius = 0; }), Contains("radius = 0"));
  REQUIRE_THROWS_WITH(refusal([=](P &p) { p.radius = nan; }), Contains("radius = nan"));
  REQUIRE_THROWS_WITH(refusal([](P &p) { p.count = 0; }), Contains("count = 0"));
  REQUIRE_THROWS_WITH(refusal([](P &p) { p.friction = -0.1; }), Contains("friction = -0.1"));
  REQUIRE_THROWS_WITH(refusal([](P &p) { p.damping = 1; }), Contains("damping = 1"));
  REQUIRE_THROWS_AS(refusal([=](P &p) { p.damping = nan; }), base::InputError);
  REQUIRE_THROWS_WITH(refusal([](P &p) { p.shear_ratio = 2; }), Contains("shear ratio = 2"));
  REQUIRE_THROWS_WITH(refusal([](P &p) { p.initial_spacing = 2; }), Contains("initial spacing = 2"));
  REQUIRE_THROWS_WITH(refusal([](P &p) { p.low_pressure = 0; }), Contains("low pressure = 0"));
  REQUIRE_THROWS_WITH(refusal([](P &p) { p.high_pressure = 1e-4; }), Contains("high pressure = 0.0001"));
  REQUIRE_THROWS_WITH(refusal([](P &p) { p.time_step_factor = 1.3; }), Contains("time step factor = 1.3"));
  REQUIRE_THROWS_WITH(refusal([](P &p) { p.step_limit = 0; }), Contains("step limit = 0"));
}
