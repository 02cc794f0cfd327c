// Hard case S6: a loose packing of sizes 1 : 50 that settles under gravity.

#include "dem/core/uniform_random.h"
#include "dem/facets/shapes.h"
#include "dem/facets/surface.h"
#include "dem/laws/linear_contact.h"
#include "dem/neighbours/cell_list.h"
#include "dem/specimen/specimen.h"
#include "tests/performance/instruction_count.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <utility>

using Eigen::Vector3d;

namespace
{
  constexpr double smallest = 1e-3, side = 0.102; ///< radius; of the box's floor [m]; discs of unit thickness

  dem::LinearContactParameters stone()
  {
    dem::LinearContactParameters p;
    p.effective_modulus    = 5e8;
    p.friction_coefficient = 0.5;
    return p;
  }

  /** A row of discs that fills the floor, each a little beside its place. @return height of the next one [m] */
  double add_row(dem::Packing &packing, const double radius, const double height, dem::UniformRandom &random)
  {
    const int    along   = std::max(1, static_cast<int>(side / (2.2 * radius)));
    const double spacing = side / along, play = 0.45 * (spacing - 2 * radius);
    for (int i = 0; i < along; ++i)
      {
        packing.centre.emplace_back((i + 0.5) * spacing + play * (2 * random() - 1), height + radius, 0);
        packing.radius.push_back(radius);
      }
    return height + 2.1 * radius;
  }

  /** In an open box, let go, until it rests. */
  dem::Specimen settled(const dem::Packing &packing)
  {
    dem::SpecimenParameters p;
    p.physics.dimension = 2;
    p.physics.rotations = false; // nothing resists rolling, and so nothing would end it
    p.thickness         = 1;
    p.density           = 2500;
    p.interaction_ratio = 1;
    p.damping           = 0.7;
    p.gravity           = {0, -9.81, 0};
    dem::Specimen bed(packing, p, stone());
    bed.surfaces().add(
      {"box", dem::rectangle({0, 0, 0}, {side, 1, 0}, {true, true, true, false, true, true}), stone()});
    double weight = 0;
    for (const double mass : bed.particles().mass)
      weight += 9.81 * mass;
    constexpr std::int64_t most = 150000, look_every = 2000;
    const double           at_rest = 1e-6 * weight * smallest, least_time = 0.05; // of what a fall by so little gives
    do
      bed.advance(look_every);
    while (bed.steps() < most && (bed.time() < least_time || bed.energy().kinetic > at_rest));
    INFO("kinetic energy " << bed.energy().kinetic << " J after " << bed.steps() << " steps");
    CHECK(bed.energy().kinetic <= at_rest);
    return bed;
  }

  /** Deepest overlap of two particles over the radius of the smaller one. */
  double deepest(const dem::ParticleOutput &now)
  {
    double most = 0;
    for (const dem::NeighbourPair &pair : dem::find_pairs(now.position, now.radius, 1, 0, std::nullopt))
      {
        const auto   one = static_cast<std::size_t>(pair.first), other = static_cast<std::size_t>(pair.second);
        const double apart = (now.position[one] - now.position[other]).norm();
        most =
          std::max(most, (now.radius[one] + now.radius[other] - apart) / std::min(now.radius[one], now.radius[other]));
      }
    return most;
  }

  double instructions_per_contact(dem::Specimen &bed)
  {
    constexpr std::int64_t steps = 3;
    const dem::Counts      there = bed.counts();
    return performance::instructions_of([&] { bed.advance(steps); }) /
           static_cast<double>(steps * static_cast<std::int64_t>(there.contacts + there.wall_contacts));
  }
} // namespace

TEST_CASE("a loose packing of sizes 1 : 50 settles without deep overlaps, and costs what equal discs cost (S6)",
          "[stability][slow]")
{
  omp_set_num_threads(1);
  dem::UniformRandom random(6);
  dem::Packing       unlike;
  double             height = 0;
  for (const auto &[radius, rows] : {std::pair{smallest, 6}, {3 * smallest, 2}, {10 * smallest, 1}, {50 * smallest, 1}})
    for (int row = 0; row < rows; ++row)
      height = add_row(unlike, radius, height, random);
  REQUIRE(*std::max_element(unlike.radius.begin(), unlike.radius.end()) == 50 * smallest);
  dem::Specimen bed = settled(unlike);
  CHECK(deepest(bed.particles()) < 0.05);
  CHECK(bed.energy().balance_error() < 1e-3);
  const auto now = bed.particles();
  for (std::size_t i = 0; i < now.radius.size(); ++i)
    for (int d = 0; d < 2; ++d)
      CHECK(now.position[i][d] - now.radius[i] > -0.05 * now.radius[i]);
  CHECK(now.position.back().y() < unlike.centre.back().y() - 2 * smallest); // the largest has come down on the others

  dem::Packing alike;
  height = 0;
  for (int row = 0; row < 8; ++row)
    height = add_row(alike, smallest, height, random);
  dem::Specimen equal = settled(alike);
  const double  cost = instructions_per_contact(bed), usual = instructions_per_contact(equal);
  INFO(cost << " and " << usual << " instructions per contact and step");
  if (usual > 0) // some systems let nobody count
    CHECK(cost < 2 * usual);
}
