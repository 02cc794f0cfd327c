#include "fem/explicit/explicit_solver.h"
#include "fem/materials/anisotropic_elastic.h"
#include "tests/fem/solid_fixture.h"

using namespace dealii;
using fem::ElementFamily;

namespace
{
  const double young = 30e9, density = 2400, speed = std::sqrt(30e9 / 2400.0); // nu = 0: waves of a bar

  /// A bar of section 1 x 1 elements, sides free (nu = 0: one-dimensional), end x = 0 held along x or free.
  struct Bar
  {
    Bar(const double                length,
        const unsigned int          n,
        const bool                  held,
        const fem::ExplicitOptions &options,
        const ElementFamily         family = ElementFamily::hypercube)
      : solid(fem::make_mesh<3>(box<3>({length, length / n, length / n}, {n, 1, 1}), family, MPI_COMM_SELF), {})
    {
      fem::Loads<3> loads;
      const auto    zero = [](const Point<3> &, double) { return 0.0; };
      if (held)
        loads.displacements.push_back({"0", 0, zero});
      loads.displacements.push_back({"2", 1, zero});
      loads.displacements.push_back({"4", 2, zero});
      if (!held)
        loads.nodes.push_back({Point<3>(), 1, zero});
      solid.assign("0", fem::make_points(elastic(young, 0), fem::Plane::strain));
      if (!held)
        loads.displacements.push_back(
          {"0", 0, [](const Point<3> &, double t) { return 0.1 * t; }}); // pushed at 0.1 m/s
      solid.set_loads(loads);
      motion = std::make_unique<fem::ExplicitSolver<3>>(solid, options);
    }

    double end_displacement(const double length) const
    {
      double u = 0;
      for (const auto &[dof, weight] : solid.interpolation(Point<3>(length, 0, 0), 0))
        u += weight * motion->displacement()[dof];
      return u;
    }

    fem::Solid<3>                           solid;
    std::unique_ptr<fem::ExplicitSolver<3>> motion;
  };

  fem::ExplicitOptions plain(const double damping = 0)
  {
    fem::ExplicitOptions options;
    options.density = {{"0", density}};
    options.damping = damping;
    return options;
  }
}

TEST_CASE("explicit: period and energy of a bar in its first mode", "[fem]")
{
  const double length = 1;
  Bar          bar(length, 40, true, plain());
  const double omega = numbers::PI / 2 * speed / length; // fixed-free
  bar.motion->set_velocity([&](const Point<3> &x, double) {
    return Tensor<1, 3>({std::sin(numbers::PI / 2 * x[0] / length), 0, 0});
  });
  const double start = bar.motion->energy().start;
  // sum over the bar of rho sin^2 / 2 times the section; lumping changes nothing of order 1e-3
  CHECK(start == Approx(0.5 * density * 0.5 * length / 1600).epsilon(1e-3));
  double last = 0, crossing = 0, worst = 0;
  while (crossing == 0)
    {
      const double before = bar.motion->time();
      bar.motion->advance(bar.motion->step());
      const double now = bar.end_displacement(length);
      if (last > 0 && now <= 0)
        crossing = before + (bar.motion->time() - before) * last / (last - now);
      last  = now;
      worst = std::max(worst, std::fabs(bar.motion->energy().balance()));
      REQUIRE(bar.motion->time() < 10 / omega);
    }
  // Half a period; lumped linear elements and central differences err by (pi/2/40)^2/24 and less.
  CHECK(crossing == Approx(numbers::PI / omega).epsilon(1e-3));
  CHECK(worst < 1e-10); // the account is exact for central differences: rounding
}

TEST_CASE("explicit: a push travels along the bar at the wave speed", "[fem]")
{
  const double length = 1;
  Bar          bar(length, 100, false, plain());
  double       arrival = 0;
  while (arrival == 0)
    {
      bar.motion->advance(bar.motion->step());
      // Behind the front the bar moves with the pushed end; the front passes the middle when that has half of a front's share.
      if (bar.motion->time() > 0.5 * length / speed)
        arrival = bar.motion->time();
    }
  // At that moment the end half is still at rest and the near half moves with 0.1 m/s: displacement of the middle is small, of the
  // end nothing; of the start 0.1 t. Momentum rho A c t v, from the reaction alone.
  double momentum = 0;
  for (unsigned int i = 0; i < bar.motion->mass().locally_owned_size(); ++i)
    momentum += bar.motion->mass().local_element(i) * bar.motion->velocity().local_element(i);
  CHECK(momentum ==
        Approx(density * 1e-4 * speed * arrival * 0.1).epsilon(0.02)); // 2 %: half an element and the half step
  CHECK(std::fabs(bar.end_displacement(length)) < 1e-6 * 0.1 * arrival);
  CHECK(std::fabs(bar.motion->energy().balance()) < 1e-10);
}

TEST_CASE("explicit: the element eigenvalue bounds the mesh's, closely, and the step is stable up to it", "[fem]")
{
  for (const auto family : {ElementFamily::hypercube, ElementFamily::simplex})
    {
      Bar         bar(1, 10, true, plain(), family);
      fem::Vector v = bar.solid.make_vector(), f = bar.solid.make_vector();
      for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
        v.local_element(i) = std::cos(3.7 * i * i);
      double top = 0;
      for (int i = 0; i < 3000; ++i) // power iteration on M^-1 K
        {
          bar.solid.constraints().set_zero(v);
          v /= v.l2_norm();
          v.update_ghost_values();
          bar.motion->internal_force_at(v, f);
          bar.solid.constraints().set_zero(f);
          for (unsigned int j = 0; j < f.locally_owned_size(); ++j)
            f.local_element(j) /= bar.motion->mass().local_element(j);
          top = f.l2_norm();
          v   = f;
        }
      CHECK(top <= bar.motion->largest_element_eigenvalue() * (1 + 1e-10));
      CHECK(top >= 0.5 * bar.motion->largest_element_eigenvalue());

      // At 0.99 of the sharp limit the energy of a random start stays; at 1.02 it grows without bound.
      for (const double factor : {0.99, 1.02})
        {
          Bar run(1, 10, true, plain(), family);
          run.motion->set_velocity([](const Point<3> &x, double) {
            return Tensor<1, 3>({std::sin(50 * x[0]), std::cos(70 * x[0] + 30 * x[1]), std::sin(90 * x[0] * x[2])});
          });
          const double step = factor * 2 / std::sqrt(top);
          double       most = 0;
          for (int i = 0; i < 2000 && most < 1e3; ++i)
            {
              run.motion->advance(step);
              most = std::max(most, run.motion->energy().internal / run.motion->energy().start);
            }
          if (factor < 1)
            CHECK(most < 20);
          else
            CHECK(most > 1e3);
        }
    }
}

TEST_CASE("explicit: mass-proportional damping decays by exp(-alpha t / 2), and its work is in the account", "[fem]")
{
  const double length = 1, omega = numbers::PI / 2 * speed / length, alpha = 0.1 * omega;
  Bar          bar(length, 20, true, plain(alpha));
  bar.motion->set_velocity([&](const Point<3> &x, double) {
    return Tensor<1, 3>({std::sin(numbers::PI / 2 * x[0] / length), 0, 0});
  });
  const double start = bar.motion->energy().start;
  const double end   = 4 * 2 * numbers::PI / omega;
  const int    steps = static_cast<int>(std::ceil(end / bar.motion->step()));
  for (int i = 0; i < steps; ++i)
    bar.motion->advance(end / steps);
  const auto &e = bar.motion->energy();
  // Energy falls by exp(-alpha t) up to an oscillation of alpha/(2 omega) = 5 %.
  CHECK((e.kinetic + e.internal) / start == Approx(std::exp(-alpha * end)).epsilon(0.06));
  CHECK(e.damped == Approx(start - e.kinetic - e.internal).epsilon(1e-6)); // (alpha dt)^2 = 5e-5 of the first half step
}

namespace
{
  /** Without a symmetry but its own [Pa]. */
  base::Stiffness full_stiffness()
  {
    base::Matrix6 full = base::Matrix6::Identity() * 20e9;
    for (int i = 0; i < 6; ++i)
      for (int j = i + 1; j < 6; ++j)
        full(i, j) = full(j, i) = 1e9 * std::cos(i + 3.0 * j);
    return base::Stiffness(full);
  }

  template <int dim>
  void move_freely(fem::Solid<dim> &solid)
  {
    fem::Loads<dim> loads;
    loads.remove_rigid_motion = true;
    solid.set_loads(loads);
  }

  /** Largest force by which the kernel differs from the general sweep, over the largest. */
  template <int dim>
  double error_of_fast_kernel(fem::Solid<dim> &solid)
  {
    fem::ExplicitSolver<dim> motion(solid, plain());
    fem::Vector              u = solid.make_vector(), fast = solid.make_vector(), slow = solid.make_vector();
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      u.local_element(i) = 1e-4 * std::sin(1.3 * i);
    u.update_ghost_values();
    motion.internal_force_at(u, fast);
    fem::Sweep wanted;
    wanted.internal_force = &slow;
    solid.sweep(u, wanted);
    fast -= slow;
    return fast.linfty_norm() / slow.linfty_norm();
  }
} // namespace

TEST_CASE("explicit: the fast kernel gives the forces of the general sweep", "[fem]")
{
  for (const auto family : {ElementFamily::hypercube, ElementFamily::simplex})
    for (const bool anisotropic : {false, true})
      {
        fem::Solid<3> solid(fem::make_mesh<3>(box<3>({1, 2, 3}, {3, 2, 3}, 0.2), family, MPI_COMM_SELF), {});
        solid.assign("0", anisotropic ?
                            fem::make_points(fem::AnisotropicElastic(full_stiffness()), fem::Plane::strain) :
                            fem::make_points(elastic(young, 0.3), fem::Plane::strain));
        move_freely(solid);
        CHECK(error_of_fast_kernel(solid) <= 1e-12);
      }
}

TEST_CASE("explicit: linear solids in plane stress have the fast kernel, with the forces of the general sweep", "[fem]")
{
  for (const bool anisotropic : {false, true})
    {
      fem::SolidOptions options;
      options.plane = fem::Plane::stress;
      fem::Solid<2> solid(fem::make_mesh<2>(box<2>({1, 2}, {3, 2}, 0.2), ElementFamily::hypercube, MPI_COMM_SELF),
                          options);
      solid.assign("0", anisotropic ? fem::make_points(fem::AnisotropicElastic(full_stiffness()), fem::Plane::stress) :
                                      fem::make_points(elastic(young, 0.3), fem::Plane::stress));
      move_freely(solid);
      CHECK(solid.has_blocks()); // before: 22 times the time of plane strain, spent on finding known constants
      CHECK(error_of_fast_kernel(solid) <= 1e-10);
    }
}

TEST_CASE("explicit: the step follows elements that stiffen as they are stretched", "[fem]")
{
  // Green strain with a constant modulus: along the bar the stiffness is E (3 s^2 - 1)/2 at the stretch s, 2.44 E at 1.4. Steps of the
  // undeformed bar would be beyond the critical one from s = 1.04 on.
  constexpr double  length = 1, stretch = 1.4, moved_in = 0.02;
  fem::SolidOptions large;
  large.large_displacement = true;
  fem::Solid<3> solid(
    fem::make_mesh<3>(box<3>({length, length / 8, length / 8}, {8, 1, 1}), ElementFamily::hypercube, MPI_COMM_SELF),
    large);
  solid.assign("0", fem::make_points(elastic(young, 0), fem::Plane::strain));
  fem::Loads<3> loads;
  const auto    zero = [](const Point<3> &, double) { return 0.0; };
  for (const auto &[side, axis] : {std::pair{"0", 0u}, std::pair{"2", 1u}, std::pair{"4", 2u}})
    loads.displacements.push_back({side, axis, zero});
  loads.displacements.push_back(
    {"1", 0, [&](const Point<3> &, const double t) { return (stretch - 1) * length * std::min(t / moved_in, 1.0); }});
  solid.set_loads(loads);
  fem::ExplicitOptions options = plain();
  options.safety               = 0.95;
  fem::ExplicitSolver<3> motion(solid, options);
  const double           undeformed = motion.critical_step();
  double                 worst = 0, shortest = undeformed;
  for (int step = 0; motion.time() < 2 * moved_in; ++step)
    {
      motion.advance(motion.step());
      worst    = std::max(worst, std::fabs(motion.energy().balance()));
      shortest = std::min(shortest, motion.critical_step());
    }
  CHECK(shortest < 0.75 * undeformed);
  CHECK(shortest > 0.55 * undeformed); // of a wave along the bar 1/sqrt(2.44), of waves in it somewhat more
  CHECK(worst < 1e-3);

  // What is saved goes on to the same bits.
  const fem::ExplicitState saved = motion.state();
  const double             next  = motion.step();
  motion.advance(next);
  const double after = motion.critical_step();
  motion.restore(saved);
  CHECK(motion.step() == next);
  motion.advance(next);
  CHECK(motion.critical_step() == after);
}
