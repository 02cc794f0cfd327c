// Grips that turn, against bars side by side: doc/theory/laboratory-test.md, 1.
#include "dem/network/turning_grips.h"

#include "base/errors.h"
#include "dem/loading/uniaxial.h"
#include "dem/observation/path_output.h"
#include "laboratory_fixture.h"
#include "memory_state.h"
#include "quasi_static_fixture.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>

using laboratory::R;

namespace
{
  constexpr int    links_of_bar = 6;
  constexpr double apart = 10 * R, strain = 1e-5;

  /** Bars of spheres (discs) along an axis, at places across it, each of a material of its own. */
  dem::Packing bars(const int axis, const std::vector<Eigen::Vector2d> &places)
  {
    dem::Packing packing;
    for (std::size_t b = 0; b < places.size(); ++b)
      for (int i = 0; i <= links_of_bar; ++i)
        {
          Eigen::Vector3d x = Eigen::Vector3d::Zero();
          x[axis]           = 2 * R * i;
          x[(axis + 1) % 3] = places[b].x();
          x[(axis + 2) % 3] = places[b].y();
          packing.centre.push_back(x);
          packing.radius.push_back(R);
          packing.material.push_back(static_cast<std::int32_t>(b));
        }
    return packing;
  }

  /** Moduli of the bars, over that of the first. */
  const std::vector<double> softer = {1, 0.6, 0.8};

  dem::LinkMaterials materials()
  {
    std::vector<dem::Material<dem::FlatJointParameters>> list;
    for (const double each : softer)
      {
        list.push_back({"", laboratory::strong(), 0});
        list.back().parameters.effective_modulus *= each;
      }
    return dem::Materials<dem::FlatJointParameters>(list);
  }

  struct Pulled
  {
    double                       force = 0;
    std::vector<Eigen::Vector3d> moved;
  };

  Pulled
  pulled(const dem::Packing &packing, const int dimension, const int axis, const bool turn, const bool spin_blocked)
  {
    dem::NetworkParameters links;
    links.dimension         = dimension;
    links.thickness         = 1;
    links.interaction_ratio = 1.1;
    dem::GripPair grips;
    grips.axis            = axis;
    grips.lateral_blocked = true;
    grips.spin_blocked    = spin_blocked;
    dem::GripParameters ends;
    ends.thickness                  = 0.5 * R;
    grips.layers                    = dem::find_grip_layers({packing.centre, packing.radius, dimension, 1}, axis, ends);
    const dem::LinkMaterials law    = materials();
    dem::LoadedNetwork       loaded = dem::load_grips(dem::make_network(packing, links, law), grips);
    if (turn)
      dem::let_grips_turn(loaded, grips);
    dem::QuasiStaticParameters p;
    p.strain_step = p.end_strain = strain;
    p.tolerance                  = 1e-11;
    dem::QuasiStaticPath path(loaded, law, p);
    while (!path.finished())
      path.advance();
    return {path.points().back().stress[loaded.driven] * grips.layers.section,
            dem::displacements_of(loaded, path.motion())};
  }

  dem::SpecimenParameters slow_motion(const int dimension)
  {
    dem::SpecimenParameters p = laboratory::discs();
    p.physics.dimension       = dimension;
    p.interaction_ratio       = 1.1;
    p.physics.contacts        = false;
    return p;
  }

  /** So slow that it is as good as in equilibrium. */
  dem::UniaxialParameters slow_pull(const int axis, const bool turn, const bool spin_blocked)
  {
    dem::UniaxialParameters p;
    p.axis            = axis;
    p.strain_rate     = 1e-3;
    p.stop_strain     = strain;
    p.grips.thickness = 0.5 * R;
    p.lateral_blocked = true;
    p.spin_blocked    = spin_blocked;
    p.turning         = turn;
    return p;
  }

  /** Force at the end of a pull in motion [N], and how far the energy of the grips is from force times way. */
  struct PulledInMotion
  {
    double force = 0, work_error = 0, balance_error = 0;
  };

  PulledInMotion pulled_in_motion(
    const dem::Packing &packing, const int dimension, const int axis, const bool turn, const bool spin_blocked)
  {
    dem::Specimen     body(packing, slow_motion(dimension), materials());
    dem::UniaxialTest test(body, slow_pull(axis, turn, spin_blocked));
    double            work = 0, last_strain = 0, last_stress = 0;
    test.watch([&](const dem::UniaxialSample &now) {
      work += 0.5 * (now.stress + last_stress) * (now.strain - last_strain);
      last_strain = now.strain;
      last_stress = now.stress;
    });
    test.advance(test.most_steps());
    work *= test.section() * test.gauge_length();
    const dem::EnergyAccount energy = body.energy();
    return {test.curve().back().stress * test.section(), energy.external_work / work - 1, energy.balance_error()};
  }

  /** Of a bar [N/m]. */
  double stiffness(const int dimension, const std::size_t bar)
  {
    const double area = dimension == 2 ? 2 * R : M_PI * R * R;
    return laboratory::modulus * softer[bar] * area / (2 * R) / links_of_bar;
  }

  constexpr double way = strain * 2 * R * links_of_bar;
} // namespace

TEST_CASE("grips that turn find two bars of unequal stiffness as soft as their hinges say, parallel ones their sum",
          "[dem][statics]")
{
  for (const int axis : {0, 1})
    {
      const std::vector<Eigen::Vector2d> places =
        axis == 0 ? std::vector<Eigen::Vector2d>{{0, 0}, {apart, 0}} : std::vector<Eigen::Vector2d>{{0, 0}, {0, apart}};
      const dem::Packing packing = bars(axis, places);
      const double       k_1 = stiffness(2, 0), k_2 = stiffness(2, 1);
      CHECK(pulled(packing, 2, axis, false, false).force == Approx((k_1 + k_2) * way).epsilon(1e-9));
      const Pulled turned = pulled(packing, 2, axis, true, false);
      CHECK(turned.force == Approx(4 * k_1 * k_2 / (k_1 + k_2) * way).epsilon(1e-9));
      // Each bar bears half, and is stretched by it.
      CHECK(turned.moved[links_of_bar][axis] == Approx(0.25 * turned.force / k_1).epsilon(1e-6));
      // Bars that are clamped to their grips bend with them, and resist.
      const double clamped = pulled(packing, 2, axis, true, true).force;
      CHECK(clamped > (1 + 1e-6) * turned.force);
      CHECK(clamped < (1 - 1e-6) * (k_1 + k_2) * way);
    }
}

TEST_CASE("grips that turn find three bars in space loaded alike, whatever their stiffness", "[dem][statics]")
{
  const std::vector<Eigen::Vector2d> places = {{0, 0}, {apart, 0}, {0.3 * apart, 0.9 * apart}};
  for (const int axis : {0, 1, 2})
    {
      double softness = 0;
      for (std::size_t bar = 0; bar < places.size(); ++bar)
        softness += 1 / (9 * stiffness(3, bar)); // a third of the force each, and a third of its way in the mean
      CHECK(pulled(bars(axis, places), 3, axis, true, false).force == Approx(way / softness).epsilon(1e-9));
    }
}

TEST_CASE("grips that turn refuse a specimen that would fall over, and one without a face", "[dem][statics]")
{
  const dem::Packing one = bars(2, {{0, 0}});
  CHECK_THROWS_AS(pulled(one, 3, 2, true, false), base::InputError);
  dem::GripPair grips;
  grips.layers.low  = {0};
  grips.layers.high = {links_of_bar};
  dem::LoadedNetwork loaded;
  CHECK_THROWS_AS(dem::let_grips_turn(loaded, grips), base::InputError);
}

TEST_CASE("grips that turn in motion find bars side by side as soft as those in equilibrium", "[dem]")
{
  for (const int axis : {0, 1})
    {
      const std::vector<Eigen::Vector2d> places =
        axis == 0 ? std::vector<Eigen::Vector2d>{{0, 0}, {apart, 0}} : std::vector<Eigen::Vector2d>{{0, 0}, {0, apart}};
      const dem::Packing packing = bars(axis, places);
      const double       k_1 = stiffness(2, 0), k_2 = stiffness(2, 1);
      CHECK(pulled_in_motion(packing, 2, axis, false, false).force == Approx((k_1 + k_2) * way).epsilon(1e-3));
      const PulledInMotion turned = pulled_in_motion(packing, 2, axis, true, false);
      CHECK(turned.force == Approx(4 * k_1 * k_2 / (k_1 + k_2) * way).epsilon(1e-3));
      CHECK(std::abs(turned.work_error) < 1e-3); // what turns freely takes and gives no work
      CHECK(turned.balance_error < 1e-6);
      CHECK(pulled_in_motion(packing, 2, axis, true, true).force ==
            Approx(pulled(packing, 2, axis, true, true).force).epsilon(1e-3));
    }
  const dem::Packing three = bars(1, {{0, 0}, {apart, 0}, {0.3 * apart, 0.9 * apart}});
  for (const bool blocked : {false, true})
    CHECK(pulled_in_motion(three, 3, 1, true, blocked).force ==
          Approx(pulled(three, 3, 1, true, blocked).force).epsilon(1e-3));
}

TEST_CASE("glued platens of a laboratory turn as grips do", "[dem][laboratory]")
{
  const dem::Packing packing = bars(1, {{0, 0}, {0, apart}});
  for (const bool turn : {false, true})
    {
      dem::LabParameters requested = laboratory::between_platens(1e-3 * 2 * R * links_of_bar);
      requested.test               = laboratory::Test::tension;
      requested.press.layer        = 0.5 * R;
      requested.press.turns        = turn;
      requested.stop_strain        = strain;
      laboratory::Run run(packing, slow_motion(2), materials(), requested);
      run.to_end(100000);
      CHECK(run.test.reading().stress / run.test.stress_of_force() ==
            Approx(pulled(packing, 2, 1, turn, true).force).epsilon(2e-3)); // platens hold spins
    }
}

TEST_CASE("a face that turns has the inertia of its particles: it swings on bars as their stiffness says", "[dem]")
{
  // One link of each bar, between a grip that is fast and one that turns: (k_1 + k_2) b^2 over 2 m b^2, b half of their distance.
  dem::Packing packing;
  for (const double x : {0.0, apart})
    for (const double y : {0.0, 2 * R})
      {
        packing.centre.emplace_back(x, y, 0);
        packing.radius.push_back(R);
        packing.material.push_back(0);
      }
  dem::SpecimenParameters p = slow_motion(2);
  p.damping                 = 0;
  p.step_factor             = 0.02;
  dem::Specimen body(packing, p, materials());
  dem::Grip     fast, free;
  fast.particles  = {0, 2};
  free.particles  = {1, 3};
  fast.prescribed = free.prescribed = {true, true, true, true, true, true};
  free.turning_face                 = 1;
  body.grips().add(fast);
  body.grips().add(free);
  body.partners().add_force(1, {0, 1, 0}, Eigen::Vector3d::Zero()); // about their middle, from now on
  body.partners().add_force(3, {0, -1, 0}, Eigen::Vector3d::Zero());
  const double mass = 2500 * M_PI * R * R;
  const double link = laboratory::modulus * 2 * R / (2 * R);
  // Spins turn with the face: their inertia is added, and links bend with it by k R^2 / 3 and shear by a stiffness over 2.5 at an arm R.
  const double b = 0.5 * apart, inertia = 2 * mass * (b * b + 0.5 * R * R),
               stiff = 2 * link * (b * b + R * R / 3 + R * R / 2.5), period = 2 * M_PI * std::sqrt(inertia / stiff);
  double              last = 0;
  std::vector<double> crossings;
  const double        settled = 2 / stiff * b; // mean slope under the moment 2 b of 1 N, times one over b
  body.advance(static_cast<std::int64_t>(5.5 * period / body.time_step()), [&] {
    const double slope = body.displacement(1).y() / b - settled;
    if (last < 0 && slope >= 0)
      crossings.push_back(body.time() - body.time_step() * slope / (slope - last));
    last = slope;
    return true;
  });
  REQUIRE(crossings.size() >= 5);
  CHECK((crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1) ==
        Approx(period).epsilon(1e-3));
  CHECK(body.energy().balance_error() < 1e-3);
}

TEST_CASE("a test with grips that turn goes on from its state as if nothing had been", "[dem]")
{
  const dem::Packing packing = bars(1, {{0, 0}, {apart, 0}, {0.3 * apart, 0.9 * apart}});
  const auto         end     = [&](const bool interrupted) {
    auto body = std::make_unique<dem::Specimen>(packing, slow_motion(3), materials());
    auto test = std::make_unique<dem::UniaxialTest>(*body, slow_pull(1, true, true));
    test->advance(700);
    if (interrupted)
      {
        MemoryState         state;
        MemoryState::Writer writer(state);
        body->visit_state(writer);
        test->visit_state(writer);
        test.reset();
        body = std::make_unique<dem::Specimen>(packing, slow_motion(3), materials());
        test = std::make_unique<dem::UniaxialTest>(*body, slow_pull(1, true, true));
        MemoryState::Reader reader(state);
        body->visit_state(reader);
        test->visit_state(reader);
      }
    test->advance(700);
    return std::vector<double>{test->curve().back().stress, body->displacement(links_of_bar).y()};
  };
  CHECK(end(true) == end(false));
}
