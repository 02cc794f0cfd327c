// The equilibrium under weight from which a specimen starts: closed forms, rest afterwards, what is refused.
#include "clusters.h"
#include "dem/loading/impact.h"
#include "dem/loading/uniaxial.h"
#include "dem/specimen/specimen.h"
#include "dense_stiffness.h"
#include "memory_state.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <functional>

using Catch::Contains;
using Eigen::Vector3d;

namespace
{
  const double r = 1e-3, E = 25e9, G = 5e9;

  constexpr std::array<bool, 6> all = {true, true, true, true, true, true}, along_z = {false, false, true};

  dem::Grip held(const std::vector<std::size_t> &particles, const std::array<bool, 6> &prescribed = all)
  {
    dem::Grip grip;
    grip.particles  = particles;
    grip.prescribed = prescribed;
    return grip;
  }

  dem::SpecimenParameters with_gravity(dem::SpecimenParameters p, const Vector3d &g)
  {
    p.gravity = g;
    return p;
  }

  double mass_of(const dem::SpecimenParameters &p, const double radius)
  {
    return p.density *
           (p.physics.dimension == 3 ? 4.0 / 3 * M_PI * std::pow(radius, 3) : M_PI * radius * radius * p.thickness);
  }

  /** A body of unequal spheres, at least three links each at a ratio of 2, of which the three lowest are held. */
  struct HeldBody
  {
    dem::Packing             packing = cluster::random_cluster(12, 120, 0.6e-3, 1e-3);
    std::vector<std::size_t> feet;

    HeldBody()
    {
      std::vector<std::size_t> order(packing.size());
      for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
      std::sort(order.begin(), order.end(),
                [&](const auto a, const auto b) { return packing.centre[a].z() < packing.centre[b].z(); });
      feet.assign(order.begin(), order.begin() + 3);
    }
  };
} // namespace

TEST_CASE("standing and hanging columns shorten and stretch by the weight that each link carries",
          "[dem][statics][gravity]")
{
  omp_set_num_threads(1);
  // Link j carries the weight of all particles beyond it: along a line that is exact, not only to first order.
  const int free = 12;
  for (const int dimension : {3, 2})
    for (const double g : {1e4, -1e4})
      for (const bool rotations : {false, true}) // with them each link is a hinge, but nothing loads it
        {
          auto p              = cluster::elastic(cluster::next_neighbours());
          p.physics.dimension = dimension;
          p.physics.rotations = rotations;
          p.thickness         = 1.5e-3;
          const int axis      = dimension - 1;
          p.gravity[axis]     = g;
          const auto row =
            dimension == 3 ? cluster::cubic_lattice(1, 1, free + 1, r) : cluster::cubic_lattice(1, free + 1, 1, r);
          dem::Specimen specimen(row, p, cluster::concrete());
          const auto    foot  = specimen.grips().add(held({0}));
          const auto    found = specimen.find_equilibrium();
          const double  area = dimension == 3 ? M_PI * r * r : 2 * r * p.thickness, k = E * area / (2 * r),
                       weight = mass_of(p, r) * g;
          const auto out      = specimen.particles();
          double     expected = 0;
          INFO(dimension << "D, gravity " << g << ", rotations " << rotations);
          for (int i = 1; i <= free; ++i)
            {
              expected += (free + 1 - i) * weight / k;
              CHECK(out.displacement[i][axis] == Approx(expected).epsilon(1e-10));
              CHECK(out.displacement[i].norm() == std::abs(out.displacement[i][axis]));
            }
          CHECK(specimen.grips().reaction(foot)[axis] == Approx(-(free + 1) * weight).epsilon(1e-10));
          CHECK(specimen.unbalanced_ratio() < 1e-9);
          CHECK(found.largest_displacement == Approx(std::abs(expected)).epsilon(1e-10));
          CHECK(found.unbalanced_ratio <= std::max(1e-10, 4 * found.rounding));
          CHECK((found.undetermined > 0) == rotations);
        }
}

TEST_CASE("the equilibrium of an irregular body is the dense solution of its stiffness", "[dem][statics][gravity]")
{
  omp_set_num_threads(1);
  const HeldBody body;
  const Vector3d g(0.4e3, -0.3e3, -1e3);
  auto           p = with_gravity(cluster::elastic(cluster::bonded(2.0)), g);
  dem::Specimen  specimen(body.packing, p, cluster::concrete());
  const auto     foot = specimen.grips().add(held(body.feet));
  specimen.find_equilibrium();

  const auto      n      = static_cast<Eigen::Index>(body.packing.size());
  Eigen::MatrixXd K      = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  Eigen::VectorXd f      = Eigen::VectorXd::Zero(6 * n);
  const auto     &x      = body.packing.centre;
  const auto     &radius = body.packing.radius;
  for (std::size_t J = 0; J < x.size(); ++J)
    {
      f.segment<3>(static_cast<Eigen::Index>(6 * J)) = mass_of(p, radius[J]) * g;
      for (std::size_t i = J + 1; i < x.size(); ++i)
        {
          const double L = (x[i] - x[J]).norm(), area = M_PI * std::pow(std::min(radius[i], radius[J]), 2);
          if (L < 2.0 * (radius[i] + radius[J]))
            dense::add(K,
                       {J, i, x[i] - x[J], radius[J] + 0.5 * (L - radius[J] - radius[i]), E * area / L, G * area / L});
        }
    }
  const double weight = f.head(6 * n).norm();
  for (const std::size_t i : body.feet)
    for (int c = 0; c < 6; ++c)
      {
        const auto row = static_cast<Eigen::Index>(6 * i + c);
        K.row(row).setZero();
        K.col(row).setZero();
        K(row, row) = E * r;
        f[row]      = 0;
      }
  const Eigen::VectorXd u = K.ldlt().solve(f);
  REQUIRE(weight > 0);
  const auto out     = specimen.particles();
  double     largest = 0, total = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    largest = std::max(largest, u.segment<3>(6 * i).norm());
  for (Eigen::Index i = 0; i < n; ++i)
    {
      // To first order in strains of 1e-5.
      CHECK((out.displacement[i] - u.segment<3>(6 * i)).norm() < 1e-4 * largest);
      total += mass_of(p, radius[i]);
    }
  CHECK((specimen.grips().reaction(foot) + total * g).norm() < 1e-8 * total * g.norm());
}

TEST_CASE("after a static start the run stays at rest", "[dem][statics][gravity]")
{
  omp_set_num_threads(2);
  const HeldBody body;
  for (const double g : {9.81, 2e3})
    {
      auto          p = with_gravity(cluster::bonded(2.0), {0.1 * g, 0.2 * g, -g});
      dem::Specimen specimen(body.packing, p, cluster::concrete());
      specimen.grips().add(held(body.feet));
      const auto found = specimen.find_equilibrium();
      CHECK(found.largest_strain > 0);
      CHECK(found.largest_strain < 1);
      CHECK(specimen.steps() == 0);
      const double stored = specimen.energy().elastic;
      CHECK(stored > 0);
      CHECK(specimen.energy().initial == stored);
      double largest = 0;
      for (int step = 0; step < 1000; step += 50)
        {
          specimen.advance(50);
          largest = std::max(largest, specimen.energy().kinetic);
        }
      INFO("gravity " << g << ", unbalanced " << found.unbalanced_ratio << ", rounding " << found.rounding);
      CHECK(largest <= 1e-12 * stored);
      CHECK(specimen.energy().elastic == Approx(stored).epsilon(1e-6));
      CHECK(specimen.counts().broken == 0);
      CHECK(specimen.mean_damage() == 0);
      CHECK(specimen.energy().balance_error() < 1e-6);
    }
}

TEST_CASE("a load after the static start finds its energy balanced", "[dem][statics][gravity]")
{
  omp_set_num_threads(2);
  const HeldBody body;
  auto           p = with_gravity(cluster::bonded(2.0), {0, 0, -2e3});
  dem::Specimen  specimen(body.packing, p, cluster::concrete());
  const auto     foot = specimen.grips().add(held(body.feet));
  specimen.grips().set_velocity(foot, {0.003, 0, 0.002}, Vector3d::Zero()); // moves from the first step on
  specimen.find_equilibrium();
  double worst = 0;
  for (int sample = 0; sample < 30; ++sample)
    {
      specimen.advance(100);
      worst = std::max(worst, specimen.energy().balance_error());
    }
  CHECK(worst < 1e-6);
}

TEST_CASE("specimen and gravity turned together have the equilibrium turned", "[dem][statics][gravity]")
{
  omp_set_num_threads(1);
  const HeldBody        body;
  const Vector3d        g(1e3, 500, -2e3);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(1, 2, -0.7).normalized()).toRotationMatrix();
  dem::Specimen         one(body.packing, with_gravity(cluster::bonded(2.0), g), cluster::concrete());
  dem::Specimen         other(cluster::moved(body.packing, turn, Vector3d::Zero()),
                              with_gravity(cluster::bonded(2.0), turn * g), cluster::concrete());
  for (dem::Specimen *specimen : {&one, &other})
    specimen->grips().add(held(body.feet));
  const auto found = one.find_equilibrium();
  other.find_equilibrium();
  const auto a = one.particles(), b = other.particles();
  for (std::size_t i = 0; i < a.displacement.size(); ++i)
    // Lengths of 1e-3 m, rounded to 2e-19 m: 1e-10 of the largest displacement at 1e-5 of strain, times the span of the body.
    CHECK((turn * a.displacement[i] - b.displacement[i]).norm() < 1e-8 * found.largest_displacement);
}

TEST_CASE("grips that hold along their axis only: no sideways motion, and the same answer from any place",
          "[dem][statics][gravity]")
{
  omp_set_num_threads(1);
  const auto               block = cluster::cubic_lattice(3, 4, 6, r);
  auto                     p     = with_gravity(cluster::bonded(1.5), {0, 0, -2e3});
  dem::Specimen            specimen(block, p, cluster::concrete());
  std::vector<std::size_t> low(12);
  for (std::size_t i = 0; i < 12; ++i)
    low[i] = i;
  const auto foot  = specimen.grips().add(held(low, along_z));
  const auto found = specimen.find_equilibrium();
  CHECK(found.undetermined == 0);
  const auto out = specimen.particles();
  Vector3d   mean(0, 0, 0), turn(0, 0, 0);
  for (std::size_t i = 0; i < block.size(); ++i)
    {
      mean += out.displacement[i] / static_cast<double>(block.size());
      turn += block.centre[i].cross(out.displacement[i]) / static_cast<double>(block.size());
      // Mirror image in the block's middle plane x = 2 r.
      const std::size_t mirror = i - i % 3 + (2 - i % 3);
      CHECK(std::abs(out.displacement[i].x() + out.displacement[mirror].x()) < 1e-8 * found.largest_displacement);
      CHECK(std::abs(out.displacement[i].z() - out.displacement[mirror].z()) < 1e-8 * found.largest_displacement);
    }
  CHECK(std::hypot(mean.x(), mean.y()) < 1e-9 * found.largest_displacement);
  CHECK(std::abs(turn.z()) < 1e-9 * found.largest_displacement * 6 * r);
  CHECK(specimen.grips().reaction(foot).z() == Approx(72 * mass_of(p, r) * 2e3).epsilon(1e-8));
  CHECK(out.displacement[block.size() - 1].x() != 0); // it widens

  auto          sideways = with_gravity(cluster::bonded(1.5), {1, 0, -2e3});
  dem::Specimen slips(block, sideways, cluster::concrete());
  slips.grips().add(held(low, along_z));
  CHECK_THROWS_WITH(slips.find_equilibrium(), Contains("motion of the whole specimen that no grip"));
}

TEST_CASE("what has no equilibrium is refused by particle", "[dem][statics][gravity]")
{
  omp_set_num_threads(1);
  const auto p       = with_gravity(cluster::next_neighbours(), {0, 0, -10});
  const auto refusal = [&](const dem::Packing &packing, const dem::SpecimenParameters &made, const dem::Grip &grip) {
    dem::Specimen specimen(packing, made, cluster::concrete());
    if (!grip.particles.empty())
      specimen.grips().add(grip);
    specimen.find_equilibrium();
  };
  const auto block = cluster::cubic_lattice(2, 2, 3, r);
  CHECK_THROWS_WITH(refusal(block, p, {}), Contains("nothing holds") && Contains("12 particles"));
  auto stray = block;
  stray.centre.push_back({0, 0, 20 * r});
  stray.radius.push_back(r);
  CHECK_THROWS_WITH(refusal(stray, p, held({0, 1, 2, 3})), Contains("particle 13 (0 links)"));
  // A sphere that sticks out sideways on one link turns about the contact.
  auto arm = block;
  arm.centre.push_back({4.9 * r, 0, 4 * r});
  arm.radius.push_back(r);
  CHECK_THROWS_WITH(refusal(arm, with_gravity(cluster::bonded(1.5), {0, 0, -10}), held({0, 1, 2, 3})),
                    Contains("particle 13 (1 link)"));
  // Hanging by so much weight that the uppermost links damage.
  const auto row = cluster::cubic_lattice(1, 1, 10, r);
  CHECK_THROWS_WITH(refusal(row, with_gravity(p, {0, 0, 1e5}), held({0})), Contains("links damage") &&
                                                                             Contains("particles 1 and 2") &&
                                                                             Contains("Initial equilibrium = none"));
  dem::Specimen under_way(block, p, cluster::concrete());
  under_way.grips().add(held({0, 1, 2, 3}));
  under_way.advance(1);
  CHECK_THROWS_WITH(under_way.find_equilibrium(), Contains("before the first step"));
}

TEST_CASE("a few particles on hinges are named and let go, and disturb nothing", "[dem][statics][gravity]")
{
  omp_set_num_threads(1);
  const auto block = cluster::cubic_lattice(5, 5, 6, r);
  auto       arm   = block;
  arm.centre.push_back({10.9 * r, 4 * r, 8 * r}); // one link, sideways
  arm.radius.push_back(r);
  std::vector<std::size_t> feet(25);
  for (std::size_t i = 0; i < feet.size(); ++i)
    feet[i] = i;
  const auto    p = with_gravity(cluster::bonded(1.5), {0, 0, -2e3});
  dem::Specimen plain(block, p, cluster::concrete()), with_arm(arm, p, cluster::concrete());
  plain.grips().add(held(feet));
  with_arm.grips().add(held(feet));
  CHECK(plain.find_equilibrium().unsettled.empty());
  const auto found = with_arm.find_equilibrium();
  CHECK(found.unsettled == std::vector<std::int32_t>{150});
  const auto a = plain.particles(), b = with_arm.particles();
  for (std::size_t i = 0; i < block.size(); ++i)
    CHECK((a.displacement[i] - b.displacement[i]).norm() < 1e-8 * found.largest_displacement);
  // It swings: to begin with its end of the link falls at less than g, what it pulls at answers.
  with_arm.advance(100);
  CHECK(with_arm.particles().velocity[150].z() < -0.1 * 2e3 * with_arm.time());
  CHECK(with_arm.energy().balance_error() < 1e-6);
}

TEST_CASE("a particle on a hinge supports nothing", "[dem][statics][gravity]")
{
  // The block stands on feet that may slip: its sideways motions are fixed somewhere, but not at the arm.
  omp_set_num_threads(1);
  auto arm = cluster::cubic_lattice(5, 5, 6, r);
  arm.centre.push_back({10.9 * r, 8 * r, 10 * r});
  arm.radius.push_back(r);
  std::vector<std::size_t> feet(25);
  for (std::size_t i = 0; i < feet.size(); ++i)
    feet[i] = i;
  dem::Specimen specimen(arm, with_gravity(cluster::bonded(1.5), {0, 0, -2e3}), cluster::concrete());
  specimen.grips().add(held(feet, along_z));
  const auto found = specimen.find_equilibrium();
  CHECK(found.unsettled == std::vector<std::int32_t>{150});
  CHECK(found.unbalanced_ratio <= std::max(1e-10, 4 * found.rounding));
}

TEST_CASE("whoever watches the search for an equilibrium is told before each solution what is left over",
          "[dem][statics][gravity]")
{
  omp_set_num_threads(1);
  const HeldBody body;
  dem::Specimen  specimen(body.packing, with_gravity(cluster::elastic(cluster::bonded(2.0)), {0.4e3, -0.3e3, -1e3}),
                          cluster::concrete());
  specimen.grips().add(held(body.feet));
  std::vector<double> left;
  const auto          found = specimen.find_equilibrium([&](const dem::InitialEquilibrium &so_far) {
    CHECK(so_far.solutions == static_cast<int>(left.size()));
    left.push_back(so_far.unbalanced_ratio);
  });
  REQUIRE(found.solutions >= 2);
  REQUIRE(left.size() == static_cast<std::size_t>(found.solutions));
  for (std::size_t k = 1; k < left.size(); ++k)
    CHECK(left[k] > dem::wanted_unbalanced_ratio);
  CHECK(std::is_sorted(left.begin() + 1, left.end(), std::greater<double>()));
}

TEST_CASE("without gravity the packing is the equilibrium", "[dem][statics][gravity]")
{
  dem::Specimen specimen(cluster::cubic_lattice(2, 2, 3, r), cluster::next_neighbours(), cluster::concrete());
  const auto    found = specimen.find_equilibrium(); // not even held
  CHECK(found.solutions == 0);
  CHECK(found.largest_displacement == 0);
  CHECK(specimen.energy().elastic == 0);
}

TEST_CASE("a beam sags under its weight before it is hit; the impactor waits", "[dem][statics][gravity]")
{
  omp_set_num_threads(1);
  dem::ImpactParameters impact;
  impact.span              = 0.036;
  impact.support_width     = 2.5e-3;
  impact.impactor_radius   = 2e-3;
  impact.impactor_velocity = 1;
  impact.longest           = 1e-4;
  auto p                   = with_gravity(cluster::bonded(1.5), {0, 0, -500});
  p.loose                  = 1;
  const auto      beam     = cluster::cubic_lattice(21, 3, 3, r);
  const auto      packing  = dem::with_impactor(beam, impact, 3);
  dem::Specimen   specimen(packing, p, cluster::concrete());
  dem::ImpactTest test(specimen, impact);
  const auto      found = specimen.find_equilibrium();
  const auto      out   = specimen.particles();
  CHECK(out.displacement.back().norm() == 0);
  CHECK(out.velocity.back().z() == -1);
  // Lowest at mid-span, level on both sides of it.
  const std::size_t middle = 10 + 21 * 1;
  CHECK(out.displacement[middle].z() < 0);
  CHECK(found.largest_displacement >= std::abs(out.displacement[middle].z()));
  for (std::size_t i = 0; i < 21; ++i)
    CHECK(out.displacement[i].z() == Approx(out.displacement[20 - i].z()).epsilon(1e-6));
  test.advance(100);
  CHECK(specimen.energy().balance_error() < 1e-6);
}

TEST_CASE("a static start goes on from its state to the same bits, on any number of threads", "[dem][statics][gravity]")
{
  const HeldBody body;
  const auto     p    = with_gravity(cluster::bonded(2.0), {0, 0, -2e3});
  const auto     make = [&] {
    dem::Specimen specimen(body.packing, p, cluster::concrete());
    specimen.grips().set_velocity(specimen.grips().add(held(body.feet)), {0, 0, 0.05}, Vector3d::Zero());
    return specimen;
  };
  const auto state_of = [](dem::Specimen &specimen) {
    MemoryState         state;
    MemoryState::Writer writer(state);
    specimen.visit_state(writer);
    return state;
  };
  omp_set_num_threads(1);
  auto whole = make();
  whole.find_equilibrium();
  const MemoryState started = state_of(whole);
  whole.advance(200);

  omp_set_num_threads(3);
  auto                resumed = make(); // not settled: the state says all
  MemoryState::Reader reader(started);
  resumed.visit_state(reader);
  resumed.advance(200);
  CHECK(state_of(resumed) == state_of(whole));
  auto again = make();
  again.find_equilibrium();
  again.advance(200);
  CHECK(state_of(again) == state_of(whole));
  CHECK(again.energy().balance_error() == whole.energy().balance_error());
}
