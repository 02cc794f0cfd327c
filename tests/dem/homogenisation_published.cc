// Random packings against the published static solutions, doc/theory/homogenisation.md, 5.
#include "dem/homogenisation/isotropy.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/packing/compaction.h"
#include "tests/dem/homogenisation_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>

using namespace homogenisation_fixture;

namespace
{
  /** A row of the table of section 6 for N = 500. */
  struct Published
  {
    double interaction_ratio, shear_ratio, young, young_deviation, poisson, young_spread, shear_spread;
  };

  const std::vector<Published> table = {
    {1.05, 0.1, 0.5025, 0.0220, +0.2601, 0.0457, 0.0417},  {1.05, 1.0, 1.0643, 0.0427, +0.0422, 0.0211, 0.0188},
    {1.05, 10., 2.4236, 0.1060, -0.4869, 0.0153, 0.0571},  {1.25, 0.1, 0.9654, 0.0145, +0.2293, 0.0119, 0.0263},
    {1.25, 1.0, 1.7888, 0.0275, +0.0102, 0.0046, 0.0048},  {1.25, 10., 4.1459, 0.0655, -0.6179, 0.0023, 0.0238},
    {1.50, 0.1, 1.4471, 0.0310, +0.2193, 0.0130, 0.0088},  {1.50, 1.0, 2.5907, 0.0542, +0.0061, 0.0082, 0.0037},
    {1.50, 10., 5.9916, 0.1263, -0.6301, 0.0025, 0.0074},  {2.00, 0.1, 5.9332, 0.1987, +0.2209, 0.0056, 0.0099},
    {2.00, 1.0, 10.6402, 0.3566, +0.0026, 0.0038, 0.0019}, {2.00, 10., 24.4437, 0.8087, -0.6382, 0.0014, 0.0067}};

  /** The rows of N = 100. */
  const std::vector<Published> small_table = {
    {1.05, 0.1, 0.5549, 0.0318, +0.2497, 0.1062, 0.0741}, {1.05, 1.0, 1.1156, 0.0308, +0.0401, 0.0532, 0.0414},
    {1.05, 10., 2.5202, 0.0783, -0.4900, 0.0269, 0.1316}, {1.50, 0.1, 1.4604, 0.0224, +0.2198, 0.0162, 0.0280},
    {1.50, 1.0, 2.6199, 0.0478, +0.0062, 0.0119, 0.0091}, {1.50, 10., 6.0620, 0.1173, -0.6300, 0.0049, 0.0176}};

  /**
   * Spheres compacted without friction, as the published ones: to a pressure of a tenth of k_n/2r, and back. The generator stops with
   * the spheres just touching, 64.6 % solid; so are some of the published cells. Others were let go a little further: the link
   * density of the one that is published in full (section 5), 10.447 at 2 diameters, is that of ours grown to 63 % solid.
   */
  enum class State
  {
    touching,
    let_go
  };

  dem::Packing packing(const std::size_t count, const std::uint64_t seed, const State state)
  {
    dem::CompactionParameters p;
    p.radius                     = 1;
    p.count                      = count;
    p.seed                       = seed;
    p.friction                   = 0;
    p.damping                    = 0.1;
    dem::CompactionResult result = dem::compact(p);
    if (state == State::touching)
      return result.packing;
    const double growth = std::cbrt(result.packing_fraction / 0.63);
    for (Eigen::Vector3d &x : result.packing.centre)
      x *= growth;
    *result.packing.periodic_cell *= growth;
    return result.packing;
  }

  struct Means
  {
    double young = 0, poisson = 0, young_spread = 0, shear_spread = 0, ratio_to_affine = 0, link_density = 0;
  };

  Means means(const std::vector<dem::Packing> &packings, const double interaction_ratio, const double shear_ratio)
  {
    Means      m;
    const auto n = static_cast<double>(packings.size());
    for (const auto &p : packings)
      {
        const auto network = dem::make_network(p, links(interaction_ratio, shear_ratio));
        const auto found   = dem::relaxed_stiffness(network);
        CHECK(found.solver.converged);
        const auto relaxed = dem::isotropy_measures(found.stiffness, 3);
        const auto affine  = dem::isotropy_measures(dem::affine_stiffness(network), 3);
        m.young += relaxed.mean.young / n;
        m.poisson += relaxed.mean.poisson / n;
        m.young_spread += relaxed.young_spread / n;
        m.shear_spread += relaxed.shear_spread / n;
        m.ratio_to_affine += relaxed.mean.young / affine.mean.young / n;
        for (const dem::ElasticLink &l : network.links)
          m.link_density += l.branch.norm() * l.area / (3 * network.volume) / n;
      }
    return m;
  }

  std::vector<dem::Packing> five(const std::size_t count, const State state, const std::uint64_t times = 1)
  {
    std::vector<dem::Packing> packings;
    for (std::uint64_t seed = 1; seed <= 5 * times; ++seed)
      packings.push_back(packing(count, seed, state));
    return packings;
  }

  void check_rows(const std::vector<Published> &rows, const std::vector<dem::Packing> &packings)
  {
    for (const Published &row : rows)
      {
        const Means m = means(packings, row.interaction_ratio, row.shear_ratio);
        CAPTURE(packings.front().size(), row.interaction_ratio, row.shear_ratio, m.young, m.poisson);
        // The rule for packings made otherwise than the published ones.
        CHECK(std::fabs(m.young - row.young) <= std::max(3 * row.young_deviation, 0.08 * row.young));
        CHECK(std::fabs(m.poisson - row.poisson) <= (row.interaction_ratio < 1.1 ? 0.03 : 0.015));
      }
  }
} // namespace

// Between both states lie all published means for 500 spheres: let go 0.2 % above to 2.7 % below them, touching 2 to 7 % above. What
// decides is how many neighbours the compaction leaves within 1.05 diameters. Spheres that are merely brought to 62.5 % from a looser
// state, without ever being pressed together, have too few: their link density is 1.19 for 100 spheres where the published moduli
// tell of 1.31, and their modulus is 10 % low.
TEST_CASE("random packings: moduli of every row of the published table", "[dem][homogenisation][slow]")
{
  const State state = GENERATE(State::let_go, State::touching);
  CAPTURE(state == State::let_go);
  check_rows(table, five(500, state));
  check_rows(small_table,
             five(100, state, 5)); // five times fewer spheres scatter as much in five times as many packings
}

TEST_CASE("random packings: link density and relaxed over affine modulus as published", "[dem][homogenisation]")
{
  // Section 5, shear ratio 1: density of links and modulus of one published packing. Single packings scatter by 1 %.
  struct Known
  {
    double interaction_ratio, link_density, ratio;
  };
  const auto packings = five(500, State::let_go);
  for (const Known &known :
       {Known{1.05, 1.22730, 0.854}, {1.25, 1.84129, 0.963}, {1.5, 2.61087, 0.977}, {2.0, 10.44749, 0.990}})
    {
      const Means m = means(packings, known.interaction_ratio, 1.0);
      CAPTURE(known.interaction_ratio, m.link_density, m.ratio_to_affine);
      CHECK(m.link_density == Approx(known.link_density).epsilon(0.03));
      CHECK(std::fabs(m.ratio_to_affine - known.ratio) <= 0.02);
    }
}

TEST_CASE("random packings: anisotropy falls as the root of the number of spheres", "[dem][homogenisation][slow]")
{
  const Means few = means(five(100, State::let_go), 1.5, 0.1), many = means(five(900, State::let_go), 1.5, 0.1);
  // A third for nine times as many; means of five maxima scatter by about a third.
  CHECK(many.young_spread < 0.6 * few.young_spread);
  CHECK(many.shear_spread < 0.6 * few.shear_spread);
}

TEST_CASE("random packings: cells compacted as those of the published multiscale example are as stiff as it says",
          "[dem][homogenisation][slow]")
{
  // Its script (multi1.py) compacts by stresses of 1e11 and then 1e8 Pa, at Young's modulus 3e10 Pa: k_n = E r, p 2r/k_n = 6.7e-3. Left at
  // the default of 1e-3 spheres have fewer neighbours, and the same cells are 4 % softer.
  dem::CompactionParameters p;
  p.radius              = 0.01;
  p.count               = 75;
  p.friction            = 0.1;
  p.damping             = 0.8;
  p.low_pressure        = 2 * 1e8 / 3e10;
  constexpr int cells   = 16;
  double        modulus = 0, young = 0, poisson = 0, softer = 0;
  const auto    stiffness = [&](const dem::CompactionParameters &of) {
    return dem::relaxed_stiffness(dem::make_network(dem::compact(of).packing, links(1.5, 0.2))).stiffness;
  };
  for (int i = 0; i < cells; ++i)
    {
      p.seed                               = static_cast<std::uint64_t>(10 + i);
      const auto                D          = stiffness(p);
      const auto                constants  = dem::isotropy_measures(D, 3).mean;
      dem::CompactionParameters by_default = p;
      by_default.low_pressure              = dem::CompactionParameters().low_pressure;
      modulus += D(2, 2) / cells;
      young += constants.young / cells;
      poisson += constants.poisson / cells;
      softer += stiffness(by_default)(2, 2) / cells;
    }
  CHECK(modulus == Approx(6.9 / 4).epsilon(0.05));
  CHECK(young == Approx(1.57).margin(0.06));
  CHECK(poisson == Approx(0.19).margin(0.015));
  CHECK(softer < 0.975 * modulus);
}
