// Groups of particles that are driven on circles: by formulas of their place, and about an axis as rigid bodies.
#include "apps/scene/particles/motion.h"
#include "base/flat_state.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/two_balls.h"
#include "tests/places.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

using namespace apps_tests;
using Catch::Contains;
using Eigen::Vector3d;

namespace
{
  struct DrivenBalls : TwoBalls
  {
    explicit DrivenBalls(const std::vector<std::string> &more)
      : TwoBalls({"More particles/large/Centre=0.05, 0, 0", "More particles/small/Centre=-0.02, 0.03, 0.04"}, more)
    {
    }
  };

  Vector3d turned(const Vector3d &rotation, const Vector3d &arm)
  {
    return Eigen::AngleAxisd(rotation.norm(), rotation.normalized()) * arm;
  }
} // namespace

TEST_CASE("Particles driven by the field of a turn stay on their circles", "[apps][particles]")
{
  DrivenBalls  balls({"Motion/all/Velocity x=-100*y", "Motion/all/Velocity y=100*x", "Motion/all/Velocity z=0"});
  const double radii[2] = {0.05, std::hypot(0.02, 0.03)};
  balls.body->advance_to(2 * M_PI / 100 * 10); // ten turns
  for (std::size_t i = 0; i < 2; ++i)
    CHECK(balls.place(i).head<2>().norm() == Approx(radii[i]).epsilon(1e-9));
  // The midpoint rule turns by 2 atan(w dt/2) a step: of second order.
  const double step = balls.body->specimen().time_step(), angle = std::atan2(balls.place(0).y(), balls.place(0).x());
  const double exact = std::remainder(100 * balls.time(), 2 * M_PI),
               late  = 100 * balls.time() * std::pow(100 * step, 2) / 12;
  CHECK(exact - angle == Approx(late).epsilon(0.01).margin(1e-9));
}

TEST_CASE("A field that drives particles is that of the place where they are in the middle of a step",
          "[apps][particles]")
{
  // dx/dt = 50 x: the implicit midpoint rule grows by (1 + h)/(1 - h) a step, h = 50 dt/2.
  DrivenBalls  balls({"Motion/large/Velocity x=50*x"});
  const double h = 25 * balls.body->specimen().time_step();
  balls.body->advance(100);
  CHECK(balls.place(0).x() == Approx(0.05 * std::pow((1 + h) / (1 - h), 100)).epsilon(1e-10));
}

TEST_CASE("A group turns about an axis that moves, as one rigid body, spins included", "[apps][particles]")
{
  const Vector3d centre(0.01, -0.02, 0.03), rate(3, -40, 25), speed(0.5, 0, -0.2);
  DrivenBalls    balls({"Motion/all/Turn x=6*t", "Motion/all/Turn y=-80*t", "Motion/all/Turn z=50*t",
                        "Motion/all/Centre=0.01, -0.02, 0.03", "Motion/all/Velocity x=0.5", "Motion/all/Velocity z=-0.2"});
  const Vector3d start[2] = {balls.place(0), balls.place(1)};
  balls.body->advance_to(0.3);
  const double t = balls.time(); // turned by rate t^2: the rate in the middle of each step is its mean
  for (std::size_t i = 0; i < 2; ++i)
    CHECK((balls.place(i) - (centre + t * speed + turned(t * t * rate, start[i] - centre))).norm() < 1e-11);
  CHECK((balls.place(1) - balls.place(0)).norm() == Approx((start[1] - start[0]).norm()).epsilon(1e-12));
  const double middle = t - 0.5 * balls.body->specimen().time_step();
  // The velocities are those of the next step already.
  CHECK((balls.body->specimen().particle(0).spin - 2 * (middle + balls.body->specimen().time_step()) * rate).norm() <
        1e-9 * rate.norm());
}

TEST_CASE("A turn about one axis leaves free what it does not move", "[apps][particles]")
{
  DrivenBalls balls({"Motion/small/Turn z=30", "Gravity/Acceleration=0, 0, -9.81", "Gravity/Initial equilibrium=none",
                     "Probes/weight/Quantity=reaction", "Probes/weight/Group=small", "Probes/weight/Component=z"});
  balls.body->advance_to(0.02);
  CHECK(balls.body->row().at(1) == 0); // it falls, nothing holds it
  const double t = balls.time(), fallen = balls.place(1).z() - 0.04;
  CHECK((balls.place(1).head<2>() - turned(30 * t * Vector3d::UnitZ(), {-0.02, 0.03, 0}).head<2>()).norm() < 1e-13);
  CHECK(fallen ==
        Approx(-0.5 * 9.81 * t * t).epsilon(0.02)); // the first step of leap-frog falls for half a step longer
  CHECK(balls.body->specimen().particle(1).held == std::array<bool, 6>{true, true, false, false, false, true});
}

TEST_CASE("A group that turns goes on from its state to the same bits", "[apps][particles][S13]")
{
  const std::vector<std::string> motion = {"Motion/all/Turn y=20*sin(30*t)", "Motion/all/Turn z=7",
                                           "Motion/all/Velocity x=0.1*t", "Motion/all/Centre=0.02, 0, 0.01"};
  DrivenBalls                    whole(motion), resumed(motion);
  whole.body->advance(100);
  base::Column          state;
  base::FlatStateWriter writer(state);
  whole.body->visit_state(writer);
  base::FlatStateReader reader(state);
  resumed.body->visit_state(reader);
  for (const DrivenBalls *balls : {&whole, &resumed})
    balls->body->advance(100);
  for (std::size_t i = 0; i < 2; ++i)
    CHECK(whole.place(i) == resumed.place(i));
}

TEST_CASE("Turns that mean nothing are refused with the place", "[apps][particles][S14]")
{
  const ScratchFolder folder;
  const std::string   scene   = places::sources() + "/apps/scenes/bouncing_sphere.prm";
  const auto          refused = [&](const std::vector<std::string> &changes, const char *words) {
    is_refused(folder, scene, changes, words);
  };
  refused({"Motion/ball/Turn z=100*x"}, "a group turns as a rigid body: a formula of t alone");
  refused({"Motion/ball/Turn z=100", "Motion/ball/Velocity y=x"}, "moves as a rigid body: a formula of t alone");
  refused({"Motion/ball/Turn z=100", "Motion/ball/Spin z=1"}, "the turn prescribes it already");
  refused({"Motion/ball/Turn z=100", "Motion/all/Velocity x=1"}, "which prescribes the same");
  refused({"Motion/ball/Centre=0, 0, 1"}, "the group does not turn");
  REQUIRE_THROWS_WITH(DrivenBalls({"Physics/Dimension=2", "Specimen/Thickness=0.01",
                                   "More particles/small/Centre=-0.02, 0.03, 0", "Motion/small/Turn x=1"}),
                      Contains("in two dimensions a group turns about z"));
}

namespace
{
  /** Layers of spheres.txt, one held and one that turns about z. */
  const char *const two_layers = R"(set Kind = particles
subsection Specimen
  set Source            = file
  set File              = spheres.txt
  set Density           = 2500
  set Interaction ratio = 1.01
end
subsection Material
  set Law = parallel-bond
  subsection parallel-bond
    set Effective modulus = 1e9
    set Stiffness ratio   = 2.5
    set Tensile strength  = 1e12
    set Cohesion          = 1e12
  end
end
subsection Groups
  subsection low
    set Members   = layer
    set Axis      = z
    set Thickness = 1e-4
  end
  subsection high
    set Members   = layer
    set Axis      = z
    set Side      = high
    set Thickness = 1e-4
  end
end
subsection Motion
  subsection low
    set Velocity x = 0
    set Velocity y = 0
    set Velocity z = 0
    set Spin x     = 0
    set Spin y     = 0
    set Spin z     = 0
  end
  subsection high
    set Turn x = 0
    set Turn y = 0
    set Turn z = 0.5
  end
end
subsection Probes
  subsection torque
    set Quantity  = reaction torque
    set Group     = high
    set Component = z
  end
  subsection below
    set Quantity  = reaction torque
    set Group     = low
    set Component = z
  end
  subsection elsewhere
    set Quantity  = reaction torque
    set Group     = high
    set Point     = 0.3, -0.2, 0.1
    set Component = z
  end
  subsection own
    set Quantity  = reaction moment
    set Group     = high
    set Component = z
  end
end
subsection Time
  set End time = 1e-5
  set Damping  = 0
end
subsection Output
  set Samples   = 1
  set Snapshots = 0
end
)";
} // namespace

TEST_CASE("The torque that twists eight spheres is that of their bonds about the axis", "[apps][particles]")
{
  // Two layers of four spheres, each layer held as a rigid body: four bonds along z, at sqrt(2) R from the axis.
  const double        R = 1e-3, E = 1e9, kappa = 2.5, rate = 0.5;
  const ScratchFolder folder;
  std::string         spheres;
  for (const double z : {0.0, 2 * R})
    for (const double y : {-R, R})
      for (const double x : {-R, R})
        spheres += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + " 0.001\n";
  folder.file("spheres.txt", spheres);
  folder.file("x.prm", two_layers);
  const Results found = results_of(folder, "x.prm");
  // Forces are those of the last step's start.
  const double time  = found.series.column("time").back();
  const double step  = found.summary["cost"]["time_step"].get<double>();
  const double angle = rate * (time - step);
  const double k_s   = E / kappa / (2 * R); // per area
  const double area = M_PI * R * R, polar = 0.5 * area * R * R;
  const double torque = 4 * k_s * (area * 2 * R * R + polar) * angle;
  CHECK(found.series.column("torque").back() == Approx(torque).epsilon(1e-5));
  CHECK(found.series.column("below").back() == Approx(-torque).epsilon(1e-5));
  CHECK(found.series.column("elsewhere").back() == Approx(torque).epsilon(1e-5)); // a couple, about any point
  CHECK(found.series.column("own").back() == Approx(torque / 5).epsilon(1e-5));
}

TEST_CASE("The torque of a held group is that of its weights about the given point", "[apps][particles]")
{
  DrivenBalls  balls({"Motion/all/Velocity x=0", "Motion/all/Velocity y=0", "Motion/all/Velocity z=0",
                      "Gravity/Acceleration=0, 0, -9.81", "Gravity/Initial equilibrium=none",
                      "Probes/torque/Quantity=reaction torque", "Probes/torque/Point=0.01, 0, 0",
                      "Probes/torque/Component=y"});
  const double mass = 2500 * 4.0 / 3 * M_PI * 1e-6;
  balls.body->advance(3);
  // (place - point) x force upwards.
  CHECK(balls.body->row().at(1) == Approx(-9.81 * (mass * 0.04 + mass / 8 * -0.03)).epsilon(1e-12));
}
