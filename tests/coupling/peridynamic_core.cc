// A peridynamic core inside a solid of finite elements, and particles that hit one.

#include "coupling/contact/node_contacts.h"
#include "coupling/participants/particle_participant.h"
#include "coupling/volume/peridynamic_handshake.h"
#include "dem/laws/elastic_links.h"
#include "dem/specimen/specimen.h"
#include "tests/fem/solid_fixture.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>

using coupling::PeridynamicHandshake;
using coupling::PeridynamicParticipant;
using Eigen::Vector3d;
namespace pd = dem::peridynamics;

namespace
{
  constexpr double modulus = 25e9, density = 2400, spacing = 0.005, height = 0.04;
  constexpr double own_length = 0.1, width = 0.04, solid_end = 0.3;

  /**
   * A strip of plane stress along x: elements from 0.1 m on to both sides, a peridynamic core between them, and an overlap of 0.04 m at each
   * side of it.
   */
  struct Strip
  {
    static coupling::VolumeCouplingParameters parameters()
    {
      coupling::VolumeCouplingParameters p;
      p.name    = "core";
      p.overlap = {[](const Vector3d &x) { return std::abs(x.x()) - own_length; }, width};
      return p;
    }

    static pd::Bonds core()
    {
      pd::Body body;
      body.size    = {2 * (own_length + width), height, 0};
      body.spacing = body.thickness = spacing;
      pd::Material m;
      m.young_modulus = modulus;
      m.density       = density;
      m.calibration   = pd::Calibration::axis;
      const pd::Horizon h{3.015, pd::Volumes::partial, false};
      return {pd::Grid(body, pd::reach_of(h)), h, m};
    }

    static fem::Solid<2> elements()
    {
      fem::SolidOptions options;
      options.thickness = spacing;
      options.share = [](const std::array<double, 3> &x) { return parameters().overlap.of_solid(Vector3d(x.data())); };
      return fem::Solid<2>(fem::make_mesh<2>(
                             [](dealii::Triangulation<2> &mesh) {
                               dealii::Triangulation<2> left, right;
                               const dealii::Point<2>   low(-solid_end, -height / 2), high(-own_length, height / 2);
                               dealii::GridGenerator::subdivided_hyper_rectangle(left, {20, 4}, low, high);
                               dealii::GridGenerator::subdivided_hyper_rectangle(
                                 right, {20, 4}, dealii::Point<2>(own_length, -height / 2),
                                 dealii::Point<2>(solid_end, height / 2));
                               dealii::GridGenerator::merge_triangulations(left, right, mesh);
                               for (const auto &cell : mesh.active_cell_iterators())
                                 cell->set_material_id(0);
                             },
                             fem::ElementFamily::hypercube, MPI_COMM_SELF, fem::Bodies::several),
                           options);
    }

    static pd::Loads free_of_loads(const pd::Bonds &bonds)
    {
      pd::Loads none;
      none.held.assign(bonds.grid().places(), 0);
      none.forces        = [](double, const pd::Field *, pd::Field &) {};
      none.displacements = [](double, pd::Field &) {};
      return none;
    }

    explicit Strip(const std::function<Vector3d(const Vector3d &)> &velocity, const bool notched = false)
      : bonds(core())
      , solid(elements())
    {
      if (notched)
        bonds.cut({{0, -1, 0}, {0, 0.01, 0}, Vector3d::Zero()});
      coupling::share_with_solid(bonds, parameters());
      pd::Field v = bonds.grid().field();
      for (const std::size_t i : bonds.grid().nodes())
        v.add(i, velocity(bonds.grid().position(i)));
      middle =
        std::make_unique<PeridynamicParticipant>(bonds, free_of_loads(bonds), PeridynamicParticipant::Setup{}, v);
      solid.assign("0", fem::make_points(elastic(modulus, 1.0 / 3.0), fem::Plane::stress));
      fem::Loads<2> loads;
      loads.may_move_freely = true;
      solid.set_loads(loads);
      fem::ExplicitOptions options;
      options.density = {{"0", density}};
      motion          = std::make_unique<fem::ExplicitSolver<2>>(solid, options);
      motion->set_velocity([&](const dealii::Point<2> &x, double) {
        const Vector3d       at = velocity({x[0], x[1], 0});
        dealii::Tensor<1, 2> t;
        t[0] = at.x();
        t[1] = at.y();
        return t;
      });
      sides     = std::make_unique<coupling::SolidParticipant<2>>(solid, *motion);
      handshake = std::make_unique<PeridynamicHandshake<2>>(*middle, solid, *motion, *sides, parameters());
    }

    double energy() const
    {
      const auto a = middle->energy(), b = sides->energy();
      return a.kinetic + a.internal + b.kinetic + b.internal;
    }
    Vector3d momentum() const { return coupling::momentum_of(*middle).linear + coupling::momentum_of(*sides).linear; }

    pd::Bonds                                      bonds;
    std::unique_ptr<PeridynamicParticipant>        middle;
    fem::Solid<2>                                  solid;
    std::unique_ptr<fem::ExplicitSolver<2>>        motion;
    std::unique_ptr<coupling::SolidParticipant<2>> sides;
    std::unique_ptr<PeridynamicHandshake<2>>       handshake;
  };

  /** A bump that runs to the right from x = -0.2. */
  constexpr double bump = 0.09;
  double           bump_at(const double x)
  {
    return std::abs(x + 0.2) < bump ? std::pow(std::cos(0.5 * std::acos(-1.0) * (x + 0.2) / bump), 2) : 0.0;
  }
} // namespace

TEST_CASE("a body of elements with a peridynamic core that moves as a whole goes on unchanged", "[coupling]")
{
  Strip strip([](const Vector3d &) { return Vector3d(3, -2, 0); });
  for (int n = 0; n < 200; ++n)
    strip.handshake->advance(strip.handshake->stable_step());
  for (std::size_t i = 0; i < strip.middle->carriers(); ++i)
    CHECK((strip.middle->velocity(i) - Vector3d(3, -2, 0)).norm() < 1e-9);
  for (std::size_t i = 0; i < strip.sides->carriers(); ++i)
    CHECK((strip.sides->velocity(i) - Vector3d(3, -2, 0)).norm() < 1e-9);
}

TEST_CASE("masses of a solid and its peridynamic core are together those of the whole body", "[coupling]")
{
  const Strip strip([](const Vector3d &) { return Vector3d::Zero(); });
  double      sum = 0;
  for (std::size_t i = 0; i < strip.middle->carriers(); ++i)
    sum += strip.middle->mass(i);
  for (std::size_t i = 0; i < strip.sides->carriers(); ++i)
    sum += strip.sides->mass(i);
  CHECK(sum == Approx(density * 2 * solid_end * height * spacing).epsilon(2e-3)); // a thousandth is left to either
}

TEST_CASE("a wave runs from elements through a peridynamic core and on, and momentum and energy are kept", "[coupling]")
{
  Strip          strip([](const Vector3d &x) { return Vector3d(bump_at(x.x()), 0, 0); });
  const double   speed = std::sqrt(modulus / density), energy = strip.energy();
  const Vector3d momentum = strip.momentum();
  double         worst = 0, apart = 0, given = 0;
  // Two bumps of half the height run apart; the right one goes through the core, and is measured after that.
  while (strip.middle->time() < 0.4 / speed)
    {
      strip.handshake->advance(strip.handshake->stable_step());
      worst = std::max(worst, std::abs(strip.energy() - energy));
      apart = std::max(apart, strip.handshake->apart());
      given = std::max(given, std::abs(strip.handshake->work_on_core()));
    }
  CHECK(worst < 1e-2 * energy);
  CHECK(apart < 1e-10);
  CHECK((strip.momentum() - momentum).norm() < 1e-11 * momentum.norm());
  CHECK((strip.handshake->to_core() + strip.handshake->to_solid()).norm() < 1e-11 * strip.handshake->to_core().norm());
  // What ties take from one side they give to the other, but for the first step: velocities at the start were given to each alone.
  CHECK(given > 0.1 * energy);
  CHECK(std::abs(strip.handshake->work_on_core() + strip.handshake->work_on_solid()) < 1e-5 * energy);
  double passed = 0;
  for (std::size_t i = 0; i < strip.sides->carriers(); ++i)
    if (strip.sides->position(i).x() > own_length)
      passed = std::max(passed, strip.sides->velocity(i).x());
  CHECK(passed == Approx(0.5).epsilon(0.06));
}

TEST_CASE("a notch in a peridynamic core stops most of a wave", "[coupling]")
{
  const auto passed = [](const bool notched) {
    Strip        strip([](const Vector3d &x) { return Vector3d(bump_at(x.x()), 0, 0); }, notched);
    const double end = 0.4 / std::sqrt(modulus / density);
    while (strip.middle->time() < end)
      strip.handshake->advance(strip.handshake->stable_step());
    double most = 0;
    for (std::size_t i = 0; i < strip.sides->carriers(); ++i)
      if (strip.sides->position(i).x() > own_length)
        most = std::max(most, strip.sides->velocity(i).x());
    return most;
  };
  CHECK(passed(true) < 0.8 * passed(false));
}

TEST_CASE("peridynamic nodes beyond the overlap, or with none in it, are refused", "[coupling]")
{
  pd::Bonds bonds = Strip::core();
  auto      p     = Strip::parameters();
  p.overlap.width = 0.5 * width;
  CHECK_THROWS_AS(coupling::share_with_solid(bonds, p), base::InputError);
}

TEST_CASE(
  "a body of particles that hits a peridynamic one through the interface of participants keeps momentum and energy",
  "[coupling]")
{
  // Two discs that hold together against the end of a strip, by springs between them and the nodes that they meet.
  pd::Bonds              bonds = Strip::core();
  pd::Field              v     = bonds.grid().field();
  PeridynamicParticipant strip(bonds, Strip::free_of_loads(bonds), {}, v);
  dem::Packing           ball;
  ball.centre = {{own_length + width + 0.0101, 0, 0}, {own_length + width + 0.0301, 0, 0}};
  ball.radius = {0.01, 0.01};
  dem::SpecimenParameters p;
  p.physics.dimension = 2;
  p.physics.damage = p.physics.friction = p.physics.contacts = false;
  p.density                                                  = 2400;
  p.thickness                                                = spacing;
  p.interaction_ratio                                        = 1.5;
  dem::Specimen specimen(ball, p, dem::elastic_links(modulus, 0.3));
  for (const std::size_t i : {0, 1})
    specimen.set_velocity(i, {-5, 0, 0}, Vector3d::Zero());
  coupling::ParticleParticipant particle(specimen);
  coupling::NodeContacts        contacts(particle, {{0.01, 1e7}, {0.01, 1e7}}, strip, 0.5 * spacing);
  const double                  step    = 0.1 * contacts.stable_step(strip.stable_step());
  const Vector3d                before  = coupling::momentum_of(strip).linear + coupling::momentum_of(particle).linear;
  const double                  start   = particle.energy().kinetic;
  double                        pressed = 0, made = 0;
  for (int n = 0; n < 3000; ++n)
    {
      contacts.push();
      strip.advance(step, 1);
      particle.advance(step, 1);
      contacts.account(step);
      pressed = std::max(pressed, contacts.stored());
      made    = std::max(made, std::abs(contacts.spurious()));
    }
  const Vector3d after = coupling::momentum_of(strip).linear + coupling::momentum_of(particle).linear;
  CHECK(pressed > 0.05 * start);
  CHECK_FALSE(contacts.touching());
  CHECK((after - before).norm() < 1e-10 * before.norm());
  CHECK(particle.velocity(0).x() > -1); // it has been stopped
  CHECK(made < 1e-3 * start);
  const auto a = strip.energy(), b = particle.energy();
  CHECK(a.kinetic + a.internal + b.kinetic + b.internal == Approx(start).epsilon(1e-3));
  CHECK(a.balance_error < 1e-3);
}
