// Particles glued to surfaces: couples on facets, springs in series, rigid turns, strength, balance, restart.
#include "base/errors.h"
#include "closed_system.h"
#include "clusters.h"
#include "dem/facets/facet_spin.h"
#include "dem/laws/flat_joint.h"
#include "dem/laws/parallel_bond.h"
#include "facets_fixture.h"
#include "memory_state.h"

#include <catch2/catch.hpp>

#include <omp.h>

using namespace walls;
using Catch::Contains;

namespace
{
  constexpr double R = 0.01;

  dem::ParallelBondParameters mortar(const double strength = 1e9)
  {
    dem::ParallelBondParameters p;
    p.effective_modulus    = 1e8;
    p.stiffness_ratio      = 2;
    p.friction_coefficient = 0.3;
    p.tensile_strength     = strength;
    p.cohesion             = 2 * strength;
    return p;
  }

  std::shared_ptr<const dem::LinkLaw> glue_of(const dem::ParallelBondParameters &p, const dem::Physics &physics)
  {
    return dem::LinkMaterials(p).bonds(physics);
  }

  dem::SurfaceParameters
  glued(dem::SurfaceParameters surface, const double within, std::shared_ptr<const dem::LinkLaw> law = nullptr)
  {
    surface.glue = {within, std::move(law)};
    return surface;
  }

  /** Vertices that turn about an axis through the origin, exactly in every step. */
  std::vector<Vector3d> turning(const std::vector<Vector3d> &place, const Vector3d &turn, const double step)
  {
    std::vector<Vector3d>   velocity;
    const Eigen::AngleAxisd by(turn.norm(), turn.normalized());
    for (const Vector3d &x : place)
      velocity.push_back((by * x - x) / step);
    return velocity;
  }
} // namespace

TEST_CASE("a couple becomes the smallest forces on the corners of a facet that are one, and turns as their transpose",
          "[dem][facets]")
{
  dem::UniformRandom random(3);
  for (int n = 0; n < 200; ++n)
    {
      dem::FacetMesh mesh;
      const bool     plane = n % 4 == 0;
      mesh.corners         = plane ? 2 : 3;
      for (int c = 0; c < mesh.corners; ++c)
        {
          mesh.vertex.push_back(random_place(random, 1));
          if (plane)
            mesh.vertex.back().z() = 0;
        }
      mesh.facet = {{0, 1, plane ? 0 : 2}};
      const dem::Surface      surface({"facet", mesh, contact()}, dem::Physics());
      const dem::FacetSpin    spin(surface, 0);
      const Vector3d          couple = plane ? Vector3d(0, 0, 1) : random_place(random, 1);
      const auto              force  = spin.forces(couple);
      Vector3d                sum = Vector3d::Zero(), moment = Vector3d::Zero();
      Eigen::MatrixXd         rows = Eigen::MatrixXd::Zero(6, 3 * mesh.corners);
      Eigen::VectorXd         all(3 * mesh.corners), wanted(6);
      std::array<Vector3d, 3> velocity;
      double                  power = 0, largest = 0;
      for (int c = 0; c < mesh.corners; ++c)
        {
          const auto k = static_cast<std::size_t>(c);
          sum += force[k];
          moment += mesh.vertex[k].cross(force[k]);
          for (int d = 0; d < 3; ++d)
            {
              const Vector3d unit            = Vector3d::Unit(d);
              rows.block<3, 1>(0, 3 * c + d) = unit;
              rows.block<3, 1>(3, 3 * c + d) = mesh.vertex[k].cross(unit);
              all[3 * c + d]                 = force[k][d];
            }
          velocity[k] = random_place(random, 1);
          power += force[k].dot(velocity[k]);
          largest = std::max(largest, force[k].norm());
        }
      CHECK(sum.norm() < 1e-12 * largest);
      CHECK((moment - couple).norm() < 1e-12 * std::max(largest, couple.norm()));
      CHECK(power == Approx(couple.dot(spin.turn(velocity))).epsilon(1e-10));
      wanted << 0, 0, 0, couple[0], couple[1], couple[2];
      const Eigen::VectorXd smallest = rows.completeOrthogonalDecomposition().solve(wanted);
      CHECK((smallest - all).norm() < 1e-10 * all.norm());
    }
}

TEST_CASE("a glued column hangs as springs in series do: half a link on the face, whole ones below", "[dem][facets]")
{
  // CPM: k = E A / L0, with half the length on the face.
  const int             many = 5;
  std::vector<Vector3d> centres;
  for (int k = 0; k < many; ++k)
    centres.push_back({0.003, -0.002, -(2 * k + 1) * R});
  auto             how  = cluster::elastic(cluster::bonded(1.05));
  constexpr double fall = 981; // so heavy that the sag is 1e9 times the last digit of a place
  how.gravity           = {0, 0, -fall};
  how.damping           = 0.5;
  dem::Specimen     column(balls(centres, R), how, cluster::concrete());
  const std::size_t roof = column.surfaces().add(glued(wall(patch(5 * R, 3)), 1e-6));
  CHECK(column.surfaces().at(roof).glued == 1);
  column.advance(20000);
  const double weight = column.particle(0).mass * fall, stiff = 25e9 * pi * R * R / (2 * R);
  CHECK(column.surfaces().at(roof).total_force.z() == Approx(-many * weight).epsilon(1e-9));
  CHECK(column.surfaces().at(roof).glued == 1);
  CHECK(column.force_on({0, 1, 2, 3, 4}).z() == Approx(many * weight).epsilon(1e-9)); // of the glue
  CHECK(column.force_on({3, 4}).z() == Approx(2 * weight).epsilon(1e-6));
  double sag = many * weight / (2 * stiff);
  for (std::size_t k = 0; k < many; ++k)
    {
      CHECK(column.displacement(k).z() == Approx(-sag).epsilon(1e-5));
      sag += (many - 1 - static_cast<double>(k)) * weight / stiff;
    }
  CHECK(column.energy().balance_error() < 1e-9);
}

TEST_CASE("a face that turns as a rigid body with what is glued to it strains nothing", "[dem][facets]")
{
  for (const bool with_moments : {false, true})
    {
      auto how                      = cluster::bonded(1.0);
      how.physics.contacts          = false;
      std::vector<Vector3d> centres = {{0.004, 0.003, R}, {-0.012, 0.011, 1.02 * R}, {0.02, -0.006, 0.97 * R}};
      dem::Specimen         layer(balls(centres, R), how,
                          with_moments ? dem::LinkMaterials(mortar()) : dem::LinkMaterials(cluster::concrete()));
      const std::size_t     face = layer.surfaces().add(glued(wall(patch(4 * R, 3)), 0.03 * R));
      REQUIRE(layer.surfaces().at(face).glued == 3);
      dem::Grip grip;
      grip.particles      = {0, 1, 2};
      grip.prescribed     = {true, true, true, true, true, true};
      const auto     held = layer.grips().add(grip);
      const Vector3d turn(0.004, -0.007, 0.005); // a step; two radians and more in all
      for (int n = 0; n < 250; ++n)
        {
          const double          step = layer.time_step();
          std::vector<Vector3d> places;
          for (std::size_t i = 0; i < 3; ++i)
            places.push_back(layer.particle(i).position);
          layer.surfaces().set_vertex_velocities(face, turning(layer.surfaces().at(face).place, turn, step));
          layer.grips().set_velocities(held, turning(places, turn, step), std::vector<Vector3d>(3, turn / step));
          layer.advance(1);
        }
      layer.partners().find_surface_forces();
      const double stiff = (with_moments ? 1e8 : 25e9) * pi * R;
      CHECK(layer.surfaces().at(face).total_force.norm() < 1e-10 * stiff * R);
      CHECK(layer.surfaces().at(face).total_moment.norm() < 1e-10 * stiff * R * R);
      CHECK(layer.energy().elastic < 1e-18 * stiff * R * R);
    }
}

TEST_CASE("what is glued is torn off at the strength of the glue, and is an ordinary contact from then on",
          "[dem][facets]")
{
  const double  strength = 1e6, area = pi * R * R;
  dem::Specimen ball(balls({{0, 0, R}}, R), loose(), contact());
  const auto    face =
    ball.surfaces().add(glued(wall(patch(4 * R, 3), 0.3), 1e-6, glue_of(mortar(strength), ball.parameters().physics)));
  Driven driven(ball, 0);
  double most = 0;
  for (int n = 1; n <= 400; ++n)
    {
      driven.to({0, 0, R + 5e-5 * R * n});
      most = std::max(most, ball.surfaces().at(face).total_force.z());
      if (n == 100)
        {
          const dem::GlueOutput whole = ball.links().glue;
          CHECK(whole.torn[0] == 0);
          CHECK(whole.normal_force[0] == Approx(ball.surfaces().at(face).total_force.z()).epsilon(1e-12));
          CHECK(whole.normal_stress[0] == Approx(whole.normal_force[0] / area).epsilon(1e-12));
        }
    }
  CHECK(most == Approx(strength * area).epsilon(0.01)); // a step is a two hundredth of it
  CHECK(most <= strength * area * (1 + 1e-12));
  CHECK(ball.surfaces().at(face).glued == 0);
  CHECK(ball.surfaces().at(face).torn == 1);
  const dem::GlueOutput crack = ball.links().glue;
  REQUIRE(crack.particle.size() == 1);
  CHECK(crack.particle[0] == 0);
  CHECK(crack.surface[0] == static_cast<std::int32_t>(face));
  CHECK(crack.anchor[0].norm() < 1e-12 * R);
  CHECK(crack.torn[0] == 1);
  CHECK(crack.damage[0] == 1);
  CHECK(crack.normal_force[0] == 0);
  CHECK(ball.surfaces().at(face).total_force.norm() == 0);
  REQUIRE(ball.logged_breaks() == 1);
  const dem::Break logged = ball.breaks().front();
  CHECK(logged.ends == std::array<std::int32_t, 2>{0, -1});
  CHECK(logged.surface == static_cast<std::int32_t>(face));
  CHECK(logged.mode == dem::BreakMode::tension);
  CHECK(logged.place.norm() < 1e-9 * R);
  CHECK((logged.normal + Vector3d::UnitZ()).norm() < 1e-9);
  CHECK(logged.area == Approx(area).epsilon(1e-12));
  CHECK(logged.time > 0);
  // Released: what the bond held in that moment.
  CHECK(ball.energy().released == Approx(0.5 * strength * area * strength / 1e8 * R).epsilon(0.02));
  for (int n = 400; n >= -200; --n)
    driven.to({0, 0, R + 5e-5 * R * n});
  driven.to({0, 0, R - 0.01 * R});
  CHECK(ball.surfaces().contacts().size() == 1);
  CHECK(ball.surfaces().at(face).total_force.z() == Approx(-pi * R * 1e7 * 0.01 * R).epsilon(1e-9));
  CHECK(ball.energy().balance_error() < 0.02);
  CHECK(ball.logged_breaks() == 1); // once
}

TEST_CASE("glue that is sheared off, and glue of several elements, is logged as what broke", "[dem][facets]")
{
  dem::Specimen ball(balls({{0, 0, R}}, R), loose(), contact());
  ball.surfaces().add(glued(wall(patch(4 * R, 3), 0.3), 1e-6, glue_of(mortar(1e6), ball.parameters().physics)));
  Driven driven(ball, 0);
  for (int n = 1; n <= 4000 && ball.logged_breaks() == 0; ++n)
    driven.to({5e-5 * R * n, 0, R});
  REQUIRE(ball.logged_breaks() == 1);
  CHECK(ball.breaks().front().mode == dem::BreakMode::shear);
  // A disc whose joint with a line opens on one side: element after element, each with its place along the line.
  dem::FlatJointParameters joint;
  joint.effective_modulus = 1e8;
  joint.tensile_strength  = 1e5;
  joint.cohesion          = 1e6;
  dem::FacetMesh line;
  line.corners = 2;
  line.vertex  = {{-3 * R, 0, 0}, {3 * R, 0, 0}};
  line.facet   = {{0, 1, 0}};
  dem::Specimen disc(balls({{0, R, 0}}, R), loose(2), contact());
  const auto    face =
    disc.surfaces().add(glued(wall(line), 1e-6, dem::LinkMaterials(joint).bonds(disc.parameters().physics)));
  dem::Grip grip;
  grip.particles  = {0};
  grip.prescribed = {true, true, true, true, true, true};
  const auto held = disc.grips().add(grip);
  for (int n = 0; n < 20000 && disc.logged_breaks() < 2; ++n)
    {
      const double spin = 1; // about its foot
      disc.grips().set_velocity(held, spin * Vector3d(-disc.particle(0).position.y(), disc.particle(0).position.x(), 0),
                                {0, 0, spin});
      disc.advance(1);
    }
  REQUIRE(disc.logged_breaks() == 2);
  const auto all = disc.breaks();
  CHECK(all[0].mode == dem::BreakMode::tension);
  CHECK(all[0].element != all[1].element);
  CHECK(std::abs(all[0].place.x()) == Approx(0.75 * R).epsilon(1e-2));
  CHECK(all[1].place.x() == Approx(all[0].place.x() / 3).epsilon(1e-2)); // further in, on the same side
  CHECK(all[0].area == Approx(0.5 * R * disc.parameters().thickness).epsilon(1e-9));
  CHECK(disc.surfaces().at(face).torn == 0); // half of it still holds
}

namespace
{
  /** A layer of bonded balls, glued to a patch that shakes, until some of it is torn off. */
  struct Shaken
  {
    explicit Shaken(const double strength = 1e5, const double factor = 0.2)
      : specimen(layer(), with(factor), mortar())
    {
      face = specimen.surfaces().add(
        glued(wall(patch(6 * R, 5), 0.3, 1e8), 0.1 * R, glue_of(mortar(strength), specimen.parameters().physics)));
    }
    static dem::Packing layer()
    {
      dem::Packing       packing;
      dem::UniformRandom random(9);
      for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 5; ++i)
          {
            packing.radius.push_back(R * (0.9 + 0.1 * random()));
            packing.centre.push_back({2 * R * (i - 2), 2 * R * (j - 2), packing.radius.back() + 0.05 * R * random()});
          }
      return packing;
    }
    static dem::SpecimenParameters with(const double factor)
    {
      auto p              = loose();
      p.step_factor       = factor;
      p.interaction_ratio = 1.06;
      return p;
    }
    void until(const double time)
    {
      while (specimen.time() < time)
        {
          const double          t = specimen.time();
          std::vector<Vector3d> velocity;
          for (const Vector3d &x : specimen.surfaces().at(face).place)
            velocity.push_back(0.5 * std::sin(2000 * t) * Vector3d(20 * x.y(), 0.3, 1 + 30 * x.x()));
          specimen.surfaces().set_vertex_velocities(face, velocity);
          specimen.advance(1);
        }
    }
    dem::Specimen specimen;
    std::size_t   face;
  };
} // namespace

TEST_CASE("glue keeps momentum, angular momentum and energy of both sides", "[dem][facets]")
{
  double missing[2];
  for (const int finer : {0, 1})
    {
      Shaken       shaken(1e5, finer == 1 ? 0.05 : 0.2);
      auto        &s          = shaken.specimen;
      std::int64_t most_glued = 0; // after the first was torn
      for (double t = 1e-4; t < 2e-3; t += 2e-5)
        {
          shaken.until(t);
          if (s.surfaces().at(shaken.face).torn > 0)
            most_glued = std::max(most_glued, s.surfaces().at(shaken.face).glued);
          const dem::Surface &face = s.surfaces().at(shaken.face);
          Vector3d            lost = Vector3d::Zero(), turned = Vector3d::Zero();
          for (std::size_t i = 0; i < 25; ++i)
            {
              const dem::ParticleState p = s.particle(i);
              lost -= p.mass * p.velocity;
              turned -= (p.position - p.moved).cross(p.mass * p.velocity) + p.inertia * p.spin;
            }
          CHECK((lost - face.momentum).norm() < 1e-12 + 1e-10 * lost.norm());
          CHECK((turned - face.angular_momentum).norm() < 1e-13 + 1e-10 * turned.norm());
          Vector3d sum = Vector3d::Zero(), moment = Vector3d::Zero();
          double   size = 0;
          for (std::size_t v = 0; v < face.force.size(); ++v)
            {
              sum += face.force[v];
              moment += (face.place[v] - face.motion[v]).cross(face.force[v]); // where they were at t_n
              size += face.force[v].norm();
            }
          CHECK((sum - face.total_force).norm() <= 1e-12 * size);
          CHECK((moment - face.total_moment).norm() <= 1e-12 * size * 6 * R);
        }
      CHECK(s.surfaces().at(shaken.face).torn > 0);
      CHECK(most_glued > 5);
      missing[finer] = s.energy().balance_error();
    }
  CHECK(missing[0] < 0.01);
  CHECK(missing[1] < 0.5 * missing[0]);
}

TEST_CASE("glued particles move to the same bits with 1 and 2 threads, as a copy, and after a restart",
          "[dem][facets][S13]")
{
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  Shaken one;
  one.until(0.001);
  CHECK(one.specimen.surfaces().at(0).torn > 0);
  omp_set_num_threads(2);
  Shaken two;
  two.until(0.0006);
  Shaken      copy(two);
  MemoryState state;
  {
    MemoryState::Writer writer(state);
    two.specimen.visit_state(writer);
  }
  Shaken              resumed;
  MemoryState::Reader reader(state);
  resumed.specimen.surfaces().set_vertex_velocities(resumed.face, two.specimen.surfaces().at(two.face).rate);
  resumed.specimen.visit_state(reader);
  CHECK(two.specimen.energy().elastic == resumed.specimen.energy().elastic);
  for (Shaken *each : {&two, &copy, &resumed})
    each->until(0.001);
  omp_set_num_threads(threads);
  for (const Shaken *other : {&two, &copy, &resumed})
    {
      CHECK(difference(one.specimen.particles().position, other->specimen.particles().position) == 0);
      CHECK(one.specimen.energy().residual() == other->specimen.energy().residual());
      CHECK(one.specimen.surfaces().at(0).torn == other->specimen.surfaces().at(0).torn);
      CHECK(static_cast<std::int64_t>(one.specimen.logged_breaks()) >= one.specimen.surfaces().at(0).torn);
      REQUIRE(one.specimen.logged_breaks() == other->specimen.logged_breaks());
      CHECK(one.specimen.breaks().back().place == other->specimen.breaks().back().place);
      CHECK(difference(one.specimen.surfaces().at(0).impulse, other->specimen.surfaces().at(0).impulse) == 0);
    }
}

TEST_CASE("glue that cannot be is refused by name", "[dem][facets][S14]")
{
  dem::Specimen ball(balls({{0, 0, 1.5 * R}}, R), loose(), contact());
  const auto    law   = glue_of(mortar(), ball.parameters().physics);
  const auto    plate = wall(patch(4 * R, 3)), plane = wall(dem::FacetMesh::plane({0, 0, 0}, {0, 0, 1}));
  CHECK_THROWS_WITH(ball.surfaces().add(glued(plate, 0.1 * R, law)), Contains("no particle is within 0.001 m"));
  CHECK_THROWS_WITH(ball.surfaces().add(glued(plate, R)), Contains("carry no tension"));
  CHECK_THROWS_WITH(ball.surfaces().add(glued(plate, -1, law)), Contains("above 0 m"));
  CHECK_THROWS_WITH(ball.surfaces().add(glued(plane, R, law)), Contains("unbounded plane"));
  dem::Specimen sunk(balls({{0, 0, 0.4 * R}}, R), loose(), contact());
  CHECK_THROWS_WITH(sunk.surfaces().add(glued(plate, R, law)), Contains("particle 1") && Contains("lies in it"));
}

TEST_CASE("stiff glue shortens the step of glued particles", "[dem][facets]")
{
  dem::Specimen ball(balls({{0, 0, R}}, R), loose(), contact());
  const double  before    = ball.time_step();
  auto          stiff     = mortar();
  stiff.effective_modulus = 1e10;
  const auto face = ball.surfaces().add(glued(wall(patch(4 * R, 3)), 1e-6, glue_of(stiff, ball.parameters().physics)));
  CHECK(ball.time_step() < 0.2 * before);
  ball.partners().find_surface_forces();
  double felt = 0;
  for (const double k : ball.surfaces().at(face).stiffness)
    felt += k;
  CHECK(felt >= 2e10 * pi * R); // bond and contact in parallel
}
