// Contacts of elastic spheres against closed forms: with each other, and with a face.
#include "dem/laws/hertz_mindlin.h"

#include "dem/laws/cpm.h"
#include "facets_fixture.h"
#include "same_bits.h"

#include <catch2/catch.hpp>

#include <cmath>

using Eigen::Vector3d;

namespace
{
  constexpr double r = 5e-3, E = 7e8, nu = 0.25;
  const double     normal = E / (2 * (1 - nu * nu)), shear = E / (4 * (2 - nu) * (1 + nu)); // E*, G*

  dem::HertzMindlinParameters glass(const double friction = 0, const double restitution = 1)
  {
    dem::HertzMindlinParameters p;
    p.young_modulus        = E;
    p.poisson_ratio        = nu;
    p.friction_coefficient = friction;
    p.restitution          = restitution;
    return p;
  }

  dem::SpecimenParameters fine(const double step_factor)
  {
    dem::SpecimenParameters p = walls::loose();
    p.step_factor             = step_factor;
    return p;
  }

  double hertz(const double E_star, const double R, const double overlap)
  {
    return 4.0 / 3 * E_star * std::sqrt(R) * std::pow(overlap, 1.5);
  }

  double mass(const double radius) { return 2500 * 4.0 / 3 * walls::pi * std::pow(radius, 3); }

  /** What an impact ends with. */
  struct Impact
  {
    double duration = 0, deepest = 0; ///< [s], [m]
    double speed = 0;                 ///< at which the ball goes back [m/s]
    double lost = 0, balance = 0;     ///< by dashpots [J]; error of the account [-]
  };

  /** The ball of this number, thrown along -z, until it has parted again. @param gap to what it meets, now [m] */
  template <typename Gap>
  Impact impact_of(dem::Specimen &specimen, const std::size_t ball, const Gap &gap)
  {
    Impact found;
    bool   met = false;
    while (!met || gap() < 0)
      {
        specimen.advance(1);
        REQUIRE(specimen.time_step() <= specimen.parameters().step_factor * specimen.stable_step() *
                                          (1 + 1e-12)); // never beyond the present one
        if (gap() >= 0)
          continue;
        met = true;
        found.duration += specimen.time_step();
        found.deepest = std::max(found.deepest, -gap());
      }
    specimen.advance(2);
    found.speed   = specimen.particle(ball).velocity.z();
    found.lost    = specimen.energy().damping;
    found.balance = specimen.energy().balance_error();
    return found;
  }

  /** Two equal balls head on. */
  template <typename Parameters>
  Impact pair_impact(const Parameters &law, const double speed, const double step_factor, const int = 0)
  {
    dem::Specimen specimen(walls::balls({{0, 0, 0}, {0, 0, 2.0001 * r}}, r), fine(step_factor), law);
    specimen.set_velocity(1, {0, 0, -speed / 2}, Vector3d::Zero());
    specimen.set_velocity(0, {0, 0, speed / 2}, Vector3d::Zero());
    return impact_of(specimen, 1,
                     [&] { return (specimen.particle(1).position - specimen.particle(0).position).norm() - 2 * r; });
  }

  /** A ball on a floor. */
  template <typename Parameters>
  Impact floor_impact(const Parameters &law, const double speed, const double step_factor)
  {
    dem::Specimen specimen(walls::balls({{0, 0, 1.0001 * r}}, r), fine(step_factor), law);
    specimen.surfaces().add({"floor", dem::FacetMesh::plane({0, 0, 0}, {0, 0, 1}), law});
    specimen.set_velocity(0, {0, 0, -speed}, Vector3d::Zero());
    return impact_of(specimen, 0, [&] { return specimen.particle(0).position.z() - r; });
  }

  /** Speed after an impact over that before, extrapolated to steps without length from two lengths. */
  template <typename Collide>
  double restitution(const Collide &collide, const double speed_before)
  {
    const double coarse = collide(0.02).speed, fine_ = collide(0.01).speed;
    return (2 * fine_ - coarse) / speed_before;
  }
} // namespace

TEST_CASE("force between spheres of two sizes and materials is that of Hertz", "[dem][hertz]")
{
  dem::HertzMindlinParameters soft = glass(), hard = glass();
  hard.young_modulus = 3 * E, hard.poisson_ratio = 0.4;
  const dem::Materials<dem::HertzMindlinParameters> both({{"soft", soft, 0}, {"hard", hard, 0}});
  const double between = 1 / ((1 - nu * nu) / E + (1 - 0.4 * 0.4) / (3 * E)), small = 0.6 * r;
  dem::Packing packing{{{0, 0, 0}, {0, 0, r + small}}, {r, small}, {}};
  packing.material = {0, 1};
  dem::Specimen specimen(packing, fine(0.1), both);
  walls::Driven low(specimen, 0), high(specimen, 1);
  for (const double overlap : {1e-6, 1e-5, 1e-4})
    {
      high.to({0, 0, r + small - overlap});
      high.to({0, 0, r + small - overlap});
      CHECK(specimen.grips().reaction(1).z() ==
            Approx(-hertz(between, r * small / (r + small), overlap)).epsilon(1e-9)); // it is held down
    }
}

// doc/theory/hertz-mindlin.md, (4).
TEST_CASE("elastic impact of two spheres and of a sphere on a face lasts and presses as Hertz has it", "[dem][hertz]")
{
  const auto closed = [](const Impact &found, const double m, const double R, const double speed) {
    const double deepest = std::pow(15 * m * speed * speed / (16 * normal * std::sqrt(R)), 0.4);
    CHECK(found.deepest == Approx(deepest).epsilon(1e-3));
    CHECK(found.duration == Approx(2.9432752 * deepest / speed).epsilon(5e-3)); // to a step at either end
    CHECK(found.balance < 1e-5);
    CHECK(found.lost == 0);
  };
  for (const double speed : {0.02, 2.0})
    {
      const Impact two = pair_impact(glass(), speed, 0.02), one = floor_impact(glass(), speed, 0.02);
      closed(two, mass(r) / 2, r / 2, speed);
      closed(one, mass(r), r, speed);
      CHECK(two.speed == Approx(speed / 2).epsilon(1e-4));
      CHECK(one.speed == Approx(speed).epsilon(1e-4));
    }
}

TEST_CASE("restitution is the prescribed one, at any speed, of spheres and of a face", "[dem][hertz]")
{
  for (const double e : {0.9, 0.5, 0.2})
    for (const double speed : {0.05, 2.0})
      {
        INFO(e << " at " << speed << " m/s");
        CHECK(restitution([&](const double f) { return pair_impact(glass(0, e), speed, f); }, speed / 2) ==
              Approx(e).epsilon(5e-3));
        CHECK(restitution([&](const double f) { return floor_impact(glass(0, e), speed, f); }, speed) ==
              Approx(e).epsilon(5e-3));
        dem::LinearContactParameters spring = walls::contact(0, 1e7);
        spring.restitution                  = e;
        CHECK(restitution([&](const double f) { return pair_impact(spring, speed, f); }, speed / 2) ==
              Approx(e).epsilon(5e-3));
        CHECK(restitution([&](const double f) { return floor_impact(spring, speed, f); }, speed) ==
              Approx(e).epsilon(5e-3));
      }
}

TEST_CASE("what dashpots take is accounted as damping, and closes the balance", "[dem][hertz]")
{
  constexpr double e = 0.6, speed = 1;
  const Impact     two = pair_impact(glass(0, e), speed, 0.01), one = floor_impact(glass(0, e), speed, 0.01);
  CHECK(two.lost == Approx(0.5 * mass(r) / 2 * speed * speed * (1 - e * e)).epsilon(1e-2));
  CHECK(one.lost == Approx(0.5 * mass(r) * speed * speed * (1 - e * e)).epsilon(1e-2));
  CHECK(two.balance < 1e-5);
  CHECK(one.balance < 1e-5);
}

TEST_CASE("shear under constant pressure is as stiff as Mindlin has it, slides at friction, and comes back",
          "[dem][hertz]")
{
  constexpr double friction = 0.3, overlap = 2e-5, step = 1e-9;
  const double     a = std::sqrt(r * overlap), limit = friction * hertz(normal, r, overlap);
  dem::Specimen    specimen(walls::balls({{0, 0, r - overlap}}, r), fine(0.01), glass(friction));
  specimen.surfaces().add({"floor", dem::FacetMesh::plane({0, 0, 0}, {0, 0, 1}), glass(friction)});
  walls::Driven ball(specimen, 0);
  double        x    = 0;
  const auto    move = [&](const double to) {
    while (std::abs(to - x) > 0.5 * step)
      ball.to({x += to > x ? step : -step, 0, r - overlap});
    ball.to({x, 0, r - overlap});
    return specimen.grips().reaction(0).x();
  };
  const double k = 8 * shear * a;
  CHECK(move(100 * step) == Approx(k * 100 * step).epsilon(1e-6));
  CHECK(move(400 * step) == Approx(k * 400 * step).epsilon(1e-6));
  const double slides_from = limit / k;
  CHECK(move(1.5 * slides_from) == Approx(limit).epsilon(1e-6));
  const double turned = x, force = move(turned - 0.5 * slides_from);
  CHECK(force == Approx(limit - k * (turned - x)).epsilon(1e-6));
}

TEST_CASE("shear force shrinks with the contact and stays while it grows", "[dem][hertz]")
{
  constexpr double overlap = 2e-5;
  dem::Specimen    specimen(walls::balls({{0, 0, r - overlap}}, r), fine(0.01), glass(10));
  specimen.surfaces().add({"floor", dem::FacetMesh::plane({0, 0, 0}, {0, 0, 1}), glass(10)});
  walls::Driven ball(specimen, 0);
  double        x = 0, z = r - overlap;
  const auto    shear_force = [&] {
    ball.to({x, 0, z});
    return specimen.grips().reaction(0).x();
  };
  for (int n = 0; n < 200; ++n)
    ball.to({x += 1e-9, 0, z});
  const double before = shear_force();
  for (int n = 0; n < 400; ++n)
    ball.to({x, 0, z += overlap / 800}); // to half the overlap
  CHECK(shear_force() == Approx(std::sqrt(0.5) * before).epsilon(1e-6));
  const double least = shear_force();
  for (int n = 0; n < 400; ++n)
    ball.to({x, 0, z -= overlap / 800}); // and back
  CHECK(shear_force() == Approx(least).epsilon(1e-6));
  CHECK(specimen.energy().friction > 0);
  CHECK(specimen.energy().balance_error() < 1e-6);
}

TEST_CASE("ball that slides through an oblique impact leaves with the closed form's speed and spin", "[dem][hertz]")
{
  // Sliding all the way: v_t' = v_t - mu (1 + e) v_n, w = 5/2 mu (1 + e) v_n / r (O. R. Walton 1993). Friction follows the spring's force,
  // whose impulse is that of the whole only without a dashpot.
  constexpr double friction = 0.1, along = 0.15, down = 0.05;
  dem::Specimen    specimen(walls::balls({{0, 0, 1.0001 * r}}, r), fine(0.01), glass(friction));
  specimen.surfaces().add({"floor", dem::FacetMesh::plane({0, 0, 0}, {0, 0, 1}), glass(friction)});
  specimen.set_velocity(0, {along, 0, -down}, Vector3d::Zero());
  impact_of(specimen, 0, [&] { return specimen.particle(0).position.z() - r; });
  const auto ball = specimen.particle(0);
  CHECK(ball.velocity.x() == Approx(along - 2 * friction * down).epsilon(1e-4));
  CHECK(ball.spin.y() == Approx(2.5 * 2 * friction * down / r).epsilon(2e-3)); // pressed, its arm is a little shorter
  CHECK(specimen.energy().friction ==
        Approx(0.5 * mass(r) *
               (along * along - ball.velocity.x() * ball.velocity.x() - 0.4 * r * r * ball.spin.y() * ball.spin.y()))
          .epsilon(1e-2));
  CHECK(specimen.energy().balance_error() < 1e-3);
}

TEST_CASE("dashpots and elastic spheres go on to the same bits from a state, with any number of threads",
          "[dem][hertz]")
{
  const auto made = [] {
    dem::SpecimenParameters p  = fine(0.2);
    p.gravity                  = {0, 0, -9.81};
    dem::Packing       packing = walls::balls({}, r);
    dem::UniformRandom random(8);
    for (int i = 0; i < 27; ++i)
      {
        packing.centre.push_back(2.02 * r * Vector3d(i % 3, i / 3 % 3, 0.55 + i / 9) +
                                 1e-4 * Vector3d(random(), random(), 0));
        packing.radius.push_back(r);
      }
    dem::Specimen specimen(packing, p, glass(0.4, 0.7));
    specimen.surfaces().add({"floor", dem::FacetMesh::plane({0, 0, 0}, {0, 0, 1}), glass(0.4, 0.7)});
    for (std::size_t i = 0; i < packing.size(); ++i)
      specimen.set_velocity(i, {0.1, 0, -1}, Vector3d::Zero());
    return specimen;
  };
  check_same_bits(made, 230, 230, 0); // the lowest are just on the floor
  dem::Specimen specimen = made();
  specimen.advance(230);
  CHECK(specimen.counts().wall_contacts == 9);
  std::size_t met = 0;
  for (int n = 0; n < 230; ++n)
    {
      specimen.advance(1);
      met = std::max(met, specimen.counts().contacts);
    }
  CHECK(met >= 9);
  CHECK(specimen.energy().damping > 0);
  CHECK(specimen.energy().balance_error() < 2e-3);
}

TEST_CASE("law that surfaces cannot have, and a pressure of a law that is not linear, are refused", "[dem][hertz]")
{
  dem::Specimen      specimen(walls::balls({{0, 0, 1.5 * r}}, r), fine(0.1), glass());
  dem::CpmParameters concrete;
  concrete.normal_modulus = 1e9, concrete.shear_ratio = 0.2, concrete.limit_elastic_strain = 1e-4;
  concrete.relative_ductility = 5, concrete.cohesion = 1e6, concrete.friction_coefficient = 0.5;
  CHECK_THROWS_WITH(specimen.surfaces().add({"floor", walls::patch(0.1, 2), concrete}),
                    Catch::Contains("floor") && Catch::Contains("CPM") && Catch::Contains("hertz-mindlin"));
  CHECK_THROWS_WITH(specimen.surfaces().add({"floor", walls::patch(0.1, 2), glass(), 1e-3}),
                    Catch::Contains("floor") && Catch::Contains("linear"));
}
