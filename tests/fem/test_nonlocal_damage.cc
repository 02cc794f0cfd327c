#include "fem/points/nonlocal_weights.h"
#include "fem/references/concrete_points.h"
#include "fem/solvers/step_control.h"
#include "tests/fem/solid_fixture.h"

#include <random>

using namespace fem::references;

using namespace dealii;

namespace
{
  /// M1 with softening over a zone of 20 mm, averaged over a radius [m]; 0: local.
  fem::DamagePlasticParameters averaging_concrete(const double radius)
  {
    auto p              = material_m1();
    p.element_size      = 0.02;
    p.crack_opening     = 4e-5;
    p.nonlocal_length   = radius;
    p.largest_increment = 2e-4;
    return p;
  }

  constexpr double length = 0.1, height = 0.005;

  /// A bar with a waist in its middle, whose depth does not depend on the mesh.
  fem::BuildMesh<2> waisted(const unsigned int n)
  {
    return [=](Triangulation<2> &mesh) {
      GridGenerator::subdivided_hyper_rectangle(mesh, {n, 1u}, Point<2>(), Point<2>(length, height), true);
      GridTools::transform(
        [](const Point<2> &x) {
          const double off = (x[0] - 0.5 * length) / (0.1 * length);
          return Point<2>(x[0], x[1] * (1 - 0.1 * std::exp(-off * off)));
        },
        mesh);
    };
  }

  /// Straining of the bar: the load that it carries at most [N/m], and the work of softening until a twentieth is left [J/m].
  struct Pulled
  {
    double peak = 0, work = 0;
  };

  Pulled pull(const double radius, const unsigned int n)
  {
    fem::Loads<2> loads;
    loads.displacements.push_back({"0", 0, zero});
    loads.displacements.push_back({"2", 1, zero});
    loads.displacements.push_back({"1", 0, [](const Point<2> &, double t) { return t; }});
    Model<2> bar(waisted(n), fem::ElementFamily::hypercube, {}, fem::DamagePlasticConcrete(averaging_concrete(radius)),
                 loads);
    fem::StepControl steps;
    steps.first    = 1e-6;
    steps.smallest = 1e-10;
    steps.largest  = 2e-6;
    Pulled pulled;
    fem::run_to(*bar.solver, 3e-4, steps, [&](const fem::StepReport &, double) {
      const double load = bar.solver->reaction("1")[0];
      pulled.peak       = std::max(pulled.peak, load);
      return load > 0.05 * pulled.peak;
    });
    pulled.work = bar.solver->energy().internal;
    CHECK(bar.solver->energy().external == Approx(pulled.work).epsilon(1e-6));
    return pulled;
  }
}

TEST_CASE("nonlocal weights average over what lies within the radius, and leave a uniform field as it is")
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> in(0.0, 1.0);
  std::vector<Eigen::Vector3d>           places;
  std::vector<double>                    volumes, uniform(200, 0.1), linear;
  for (int i = 0; i < 200; ++i)
    {
      places.emplace_back(in(random), in(random), in(random));
      volumes.push_back(in(random));
      linear.push_back(places.back()[0]);
    }
  constexpr double           radius = 0.3;
  const fem::NonlocalWeights weights(places, volumes, radius);
  CHECK(weights.averaged(uniform, 2.0) == uniform); // the same bits
  const auto averaged = weights.averaged(linear, 1.0);
  for (std::size_t i = 0; i < places.size(); ++i)
    {
      double sum = 0, value = 0, all = 0;
      for (std::size_t j = 0; j < places.size(); ++j) // every pair, without a search
        {
          const double share = std::max(0.0, 1 - (places[i] - places[j]).squaredNorm() / (radius * radius));
          all += volumes[j] * share * share;
          value += volumes[j] * share * share * linear[j];
        }
      for (const auto &entry : weights.row(i))
        sum += entry.second;
      CHECK(sum == Approx(1).epsilon(1e-14));
      CHECK(averaged[i] == Approx(value / all).epsilon(1e-12));
    }
}

TEST_CASE("the tangent of nonlocal damage is the derivative of the forces, over elements too")
{
  const auto p     = averaging_concrete(0.04);
  const auto loads = hold_all<3>([](const Point<3> &x, const double t) {
    Tensor<1, 3> u;
    u[2] = 2e-4 * t * x[2] * (1 + 4 * x[0] + 3 * x[2]); // uneven
    return u;
  });
  Model<3>   cube(box<3>({0.06, 0.06, 0.06}, {3, 3, 3}, 0.1), fem::ElementFamily::hypercube, {},
                  fem::DamagePlasticConcrete(p), loads);
  for (int i = 1; i <= 4; ++i)
    REQUIRE(cube.solver->advance_to(0.5 * i).converged);

  // Further on along a direction that strains every element, no kink within the difference quotient.
  fem::Vector u = cube.solver->displacement(), direction = cube.solid.make_vector(), product = cube.solid.make_vector();
  cube.solid.prescribed(2.2, u);
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  for (auto &value : direction)
    value = in(random);
  direction.update_ghost_values();
  u.update_ghost_values();
  fem::Matrix tangent;
  cube.solid.make_matrix(tangent);
  fem::Vector force = cube.solid.make_vector();
  fem::Sweep  wanted;
  wanted.internal_force = &force;
  wanted.tangent        = &tangent;
  wanted.products       = {{&direction, &product}};
  cube.solid.sweep(u, wanted);

  constexpr double h       = 1e-11; // [m], of displacements of 1e-5
  fem::Vector      forward = cube.solid.make_vector(), backward = forward, there = u;
  there.add(h, direction);
  there.update_ghost_values();
  cube.solid.internal_force(there, forward);
  there.add(-2 * h, direction);
  there.update_ghost_values();
  cube.solid.internal_force(there, backward);
  forward -= backward;
  forward /= 2 * h;
  fem::Vector off = forward;
  off -= product;
  CHECK(off.l2_norm() < 1e-5 * forward.l2_norm());

  // The matrix is the same operator on free displacements.
  fem::Vector free = direction, by_matrix = cube.solid.make_vector(), by_product = cube.solid.make_vector();
  cube.solid.constraints().set_zero(free);
  free.update_ghost_values();
  wanted.products = {{&free, &by_product}};
  cube.solid.sweep(u, wanted);
  tangent.vmult(by_matrix, free);
  cube.solid.constraints().set_zero(by_product);
  cube.solid.constraints().set_zero(by_matrix);
  by_matrix -= by_product;
  CHECK(by_matrix.l2_norm() < 1e-10 * by_product.l2_norm());
}

TEST_CASE("a softening bar dissipates the same on any mesh finer than its nonlocal length", "[slow]")
{
  const Pulled coarse = pull(0.02, 20), middle = pull(0.02, 40), fine = pull(0.02, 80);
  INFO("peaks " << coarse.peak << ' ' << middle.peak << ' ' << fine.peak << ", work " << coarse.work << ' '
                << middle.work << ' ' << fine.work);
  CHECK(fine.peak == Approx(middle.peak).epsilon(0.005));
  CHECK(fine.work == Approx(middle.work).epsilon(0.02));
  CHECK(coarse.work == Approx(fine.work).epsilon(0.08));
}

TEST_CASE("a nonlocal length without a size of its own is refused")
{
  auto p         = averaging_concrete(0.02);
  p.element_size = 0;
  CHECK_THROWS_WITH(fem::DamagePlasticConcrete(p), Catch::Contains("Nonlocal length"));
  CHECK_THROWS_WITH(fem::make_points(fem::DamagePlasticConcrete(averaging_concrete(0.02)), fem::Plane::stress),
                    Catch::Contains("plane stress"));
}
