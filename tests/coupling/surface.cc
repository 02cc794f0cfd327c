// Particles that touch a deformable solid: momentum, power and energy of the surface coupling.
#include "dem/facets/surface.h"

#include "coupling/concurrent/concurrent_motion.h"
#include "fem/materials/isotropic_elastic.h"
#include "tests/dem/clusters.h"
#include "tests/fem/solid_fixture.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <memory>

using Eigen::Vector3d;

namespace
{
  constexpr double side = 0.1; ///< of the block [m]

  /** A block of the given number of elements along each side, its first corner in the origin. */
  template <int dim>
  struct Block
  {
    explicit Block(const unsigned int elements, const std::function<void(fem::Loads<dim> &)> &hold = {})
      : solid(fem::make_mesh<dim>(box<dim>(corner(), std::vector<unsigned int>(dim, elements)),
                                  fem::ElementFamily::hypercube,
                                  MPI_COMM_SELF),
              options())
    {
      solid.assign("0", fem::make_points(elastic(10e9, 0.2), fem::Plane::strain));
      fem::Loads<dim> loads;
      loads.may_move_freely = !hold;
      if (hold)
        hold(loads);
      solid.set_loads(loads);
      fem::ExplicitOptions explicitly;
      explicitly.density = {{"0", 2400}};
      motion             = std::make_unique<fem::ExplicitSolver<dim>>(solid, explicitly);
      participant        = std::make_unique<coupling::SolidParticipant<dim>>(solid, *motion);
    }
    static dealii::Point<dim> corner()
    {
      dealii::Point<dim> p;
      for (int d = 0; d < dim; ++d)
        p[d] = side;
      return p;
    }
    static fem::SolidOptions options()
    {
      fem::SolidOptions o;
      o.large_displacement = true;
      return o;
    }
    Vector3d momentum() const
    {
      Vector3d sum = Vector3d::Zero();
      for (std::size_t i = 0; i < participant->carriers(); ++i)
        sum += participant->mass(i) * participant->velocity(i);
      return sum;
    }

    fem::Solid<dim>                                  solid;
    std::unique_ptr<fem::ExplicitSolver<dim>>        motion;
    std::unique_ptr<coupling::SolidParticipant<dim>> participant;
  };

  dem::LinearContactParameters rough()
  {
    dem::LinearContactParameters law;
    law.effective_modulus    = 1e8;
    law.stiffness_ratio      = 2.5;
    law.friction_coefficient = 0.4;
    return law;
  }

  /** Its lower face is held. */
  void stands(fem::Loads<3> &loads)
  {
    for (unsigned int c = 0; c < 3; ++c)
      loads.displacements.push_back({"4", c, [](const dealii::Point<3> &, double) { return 0.0; }});
  }

  /** One ball. */
  dem::Specimen ball(const double    radius,
                     const Vector3d &centre,
                     const Vector3d &velocity,
                     const Vector3d &spin,
                     const double    step_factor = 0.2)
  {
    dem::Packing packing;
    packing.centre = {centre};
    packing.radius = {radius};
    auto p         = cluster::bonded(1.0);
    p.density      = 7800;
    p.step_factor  = step_factor;
    p.damping      = 0;
    dem::Specimen specimen(packing, p, rough());
    specimen.set_velocity(0, velocity, spin);
    return specimen;
  }

  Vector3d momentum(const dem::Specimen &specimen)
  {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < specimen.counts().particles; ++i)
      sum += specimen.particle(i).mass * specimen.particle(i).velocity;
    return sum;
  }

  struct Collision
  {
    Block<3>                      block;
    dem::Specimen                 specimen;
    coupling::ConcurrentMotion<3> both;

    /** A spinning ball on its way to an edge of the free block, which it leaves again. */
    explicit Collision(const double step_factor = 0.2)
      : block(3)
      , specimen(ball(0.02, {0.03, 0.062, 0.1205}, {2, -1, -5}, {40, 100, -60}, step_factor))
      , both(specimen, block.solid, *block.motion, *block.participant)
    {
      both.add_surface({"block", {}, rough()});
    }
    const coupling::SurfaceCoupling<3> &surface() const { return *both.surfaces().front(); }
    /** Half the longest step of both. */
    double   step() const { return 0.5 * std::min(both.solid_step(), both.particle_step()); }
    Vector3d total_momentum() const { return momentum(specimen) + block.momentum(); }
    double   energy() const
    {
      const dem::EnergyAccount e = specimen.energy();
      const auto               s = block.motion->energy();
      return e.kinetic + e.elastic + e.friction + e.released + s.kinetic + s.internal;
    }
  };
} // namespace

TEST_CASE("surface coupling: a closed system keeps its momentum, and power is the same on both sides", "[coupling]")
{
  Collision      c;
  const double   step  = c.step();
  const Vector3d start = c.total_momentum();
  double         most = 0, force = 0;
  bool           met = false;
  for (int n = 0; n < 3000; ++n)
    {
      c.both.advance(step);
      most  = std::max(most, (c.total_momentum() - start).norm());
      force = std::max(force, c.specimen.surface(c.surface().surface()).total_force.norm());
      met   = met || force > 0;
      // Forces on vertices are one and the same as those on the ball, moments too.
      Vector3d            on_vertices = Vector3d::Zero(), turning = Vector3d::Zero();
      const dem::Surface &s = c.specimen.surface(c.surface().surface());
      for (const auto &contact : c.specimen.wall_contacts())
        {
          on_vertices -= contact.force;
          turning -= contact.place.cross(contact.force);
        }
      CHECK((on_vertices - s.total_force).norm() <= 1e-12 * force);
      CHECK((turning - s.total_moment).norm() <= 1e-12 * side * force);
    }
  REQUIRE(met);
  CHECK(c.specimen.surface(c.surface().surface()).touching == 0); // it has left again
  CHECK(most < 1e-12 * start.norm());
  const coupling::SurfaceBalance b = c.surface().balance();
  CHECK((b.to_particles + b.to_solid).norm() < 1e-12 * b.to_solid.norm());
  CHECK(b.to_solid.norm() > 0.1 * start.norm());
  CHECK(std::fabs(b.made()) < 1e-12 * std::fabs(b.work_on_solid));
  CHECK(c.block.motion->energy().external == Approx(b.work_on_solid).epsilon(1e-10)); // the solid's own account of it
}

TEST_CASE("surface coupling: energy of a glancing collision is kept to a thousandth", "[coupling]")
{
  Collision    c;
  const double step = c.step();
  c.both.advance(step);
  const double start = c.energy();
  for (int n = 0; n < 1800; ++n)
    c.both.advance(step);
  CHECK(c.specimen.surface(c.surface().surface()).touching == 0);
  CHECK(c.energy() == Approx(start).epsilon(1e-3));
  CHECK(c.specimen.energy().balance_error() < 1e-3);
  CHECK(c.block.motion->energy().balance() < 1e-10);
}

TEST_CASE("surface coupling: with particles sub-cycled momentum is kept, and energy to the order of the solid's step",
          "[coupling]")
{
  double made[2];
  for (const int halved : {0, 1})
    {
      Collision c(0.02);
      c.both.set_largest_ratio(4);
      const Vector3d        start = c.total_momentum();
      coupling::WindowSteps steps;
      for (double time = 0; time < 6e-3; time += steps.window)
        steps = c.both.advance(halved == 1 ? 0.5 * c.both.next_window(1).window : 1);
      CHECK(steps.particles > 1);
      CHECK(c.specimen.surface(c.surface().surface()).touching == 0);
      CHECK((c.total_momentum() - start).norm() < 1e-12 * start.norm());
      const coupling::SurfaceBalance b = c.surface().balance();
      CHECK(b.to_solid.norm() > 0.1 * start.norm());
      CHECK((b.to_particles + b.to_solid).norm() < 1e-12 * b.to_solid.norm());
      CHECK(c.block.motion->energy().external == Approx(b.work_on_solid).epsilon(1e-10));
      made[halved] = std::fabs(b.made() / b.work_on_particles);
    }
  CHECK(made[0] < 0.1);
  CHECK(made[1] < 0.7 * made[0]);
}

TEST_CASE("surface coupling: S11, a heavy ball on a light block keeps it stable", "[coupling][stability]")
{
  // A hundred times the mass of an element, resting under its weight on a block that stands on its lower face.
  Block<3>                      block(4, stands);
  const double                  element  = 2400 * std::pow(side / 4, 3);
  const double                  radius   = std::cbrt(100 * element / (7800 * 4.0 / 3.0 * M_PI));
  dem::Specimen                 specimen = ball(radius, {0.05, 0.05, side + radius}, {0, 0, -0.2}, {0, 0, 0});
  coupling::ConcurrentMotion<3> both(specimen, block.solid, *block.motion, *block.participant);
  const auto                   &surface = both.add_surface({"block", {"5"}, rough()});
  const double                  start   = specimen.energy().kinetic + 0.5 * specimen.particle(0).mass * 0.04;
  double                        most    = 0;
  for (int n = 0; n < 4000; ++n)
    {
      both.advance(1); // the longest window
      most =
        std::max(most, specimen.energy().kinetic + block.motion->energy().kinetic + block.motion->energy().internal);
    }
  CHECK(most < 1.02 * start);
  CHECK(std::fabs(surface.balance().made()) < 1e-12 * start + 1e-12 * std::fabs(surface.balance().work_on_solid));
}

TEST_CASE("surface coupling: a uniform layer of balls loads the nodes of a face consistently", "[coupling]")
{
  // 8 x 8 balls over 4 x 4 faces, each pressed in by the same overlap: nodal forces of a uniform pressure to 1 %.
  Block<3>     block(4, stands);
  dem::Packing packing;
  const int    many   = 8;
  const double radius = 0.5 * side / many, overlap = 1e-3 * radius;
  for (int i = 0; i < many; ++i)
    for (int j = 0; j < many; ++j)
      packing.centre.emplace_back((2 * i + 1) * radius, (2 * j + 1) * radius, side + radius - overlap);
  packing.radius.assign(packing.centre.size(), radius * (1 - 1e-9));
  auto                         p = cluster::bonded(1.0);
  dem::Specimen                specimen(packing, p, rough());
  coupling::SurfaceCoupling<3> surface(specimen, block.solid, *block.participant, {"top", {"5"}, rough()});
  specimen.find_surface_forces();
  const dem::Surface &top   = specimen.surface(surface.surface());
  const double        whole = top.total_force.norm();
  CHECK(top.touching == many * many);
  for (std::size_t v = 0; v < top.force.size(); ++v)
    {
      double share = 1.0 / 16; // of the face, an inner node's
      for (int d = 0; d < 2; ++d)
        if (top.place[v][d] < 1e-9 || top.place[v][d] > side - 1e-9)
          share /= 2;
      // A corner of the block that ends a diagonal gets 3/8 of its face's balls, another 1/8.
      const bool on_diagonal = std::fabs(top.place[v][0] - top.place[v][1]) < 1e-9;
      if (share > 1.0 / 63)
        CHECK(top.force[v].norm() == Approx(share * whole).epsilon(0.01));
      else
        CHECK(top.force[v].norm() == Approx((on_diagonal ? 1.5 : 0.5) * share * whole).epsilon(0.01));
    }
}

TEST_CASE("surface coupling: in the plane a disc bounces off a block of segments", "[coupling]")
{
  Block<2>     block(4);
  dem::Packing packing;
  packing.centre      = {{0.03, side + 0.0205, 0}};
  packing.radius      = {0.02};
  auto p              = cluster::bonded(1.0);
  p.physics.dimension = 2;
  p.thickness         = 1;
  p.step_factor       = 0.2;
  dem::Specimen specimen(packing, p, rough());
  specimen.set_velocity(0, {1, -5, 0}, {0, 0, 50});
  coupling::ConcurrentMotion<2> both(specimen, block.solid, *block.motion, *block.participant);
  const auto                   &surface = both.add_surface({"block", {}, rough()});
  const double                  step    = 0.5 * std::min(both.solid_step(), both.particle_step());
  const Vector3d                start   = momentum(specimen);
  for (int n = 0; n < 3000; ++n)
    both.advance(step);
  CHECK(specimen.particle(0).velocity.y() > 0);
  CHECK((momentum(specimen) + block.momentum() - start).norm() < 1e-12 * start.norm());
  CHECK(std::fabs(surface.balance().made()) < 1e-12 * std::fabs(surface.balance().work_on_solid));
}

TEST_CASE("surface coupling: a part of the boundary that is not there is refused by name", "[coupling]")
{
  Block<3>      block(2);
  dem::Specimen specimen = ball(0.02, {0.05, 0.05, 0.2}, {0, 0, 0}, {0, 0, 0});
  using Surface          = coupling::SurfaceCoupling<3>;
  CHECK_THROWS_WITH(Surface(specimen, block.solid, *block.participant, {"block", {"lid"}, rough()}),
                    Catch::Contains("lid"));
}
