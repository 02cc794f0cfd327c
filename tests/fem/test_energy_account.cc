// The energies of static solids: what materials store and dissipate by their own account, against the work that the solver counts.
#include "fem/materials/step_dissipation.h"
#include "fem/references/concrete_points.h"
#include "fem/solvers/step_control.h"
#include "tests/fem/solid_fixture.h"

using namespace fem::references;

using namespace dealii;

namespace
{
  struct Account
  {
    double           work = 0, stored = 0;
    fem::Dissipation dissipated;

    double error() const
    {
      return std::fabs(work - stored - dissipated.total()) / std::max({work, stored, dissipated.total()});
    }
  };

  Account account_of(Model<2> &model)
  {
    Account account;
    account.work       = model.solver->energy().external;
    account.dissipated = model.solver->energy().dissipated;
    model.solid.visit_points(model.solver->displacement(), [&](const fem::PointView<2> &point) {
      account.stored += point.volume * point.material->stored_energy(point.index, point.strain, point.stress);
    });
    return account;
  }

  /// An element that is pulled far beyond its strength, in equal steps.
  Account pulled_in(const int steps, const fem::Plane plane, const double nonlocal_length = 0)
  {
    auto p              = material_m1();
    p.largest_increment = 2e-4;
    p.element_size      = 0.1;
    p.crack_opening     = 4e-5;
    p.nonlocal_length   = nonlocal_length;
    fem::Loads<2> loads;
    loads.displacements.push_back({"0", 0, zero});
    loads.displacements.push_back({"2", 1, zero});
    loads.displacements.push_back({"1", 0, [](const Point<2> &, double t) { return 6e-5 * t; }});
    fem::SolidOptions options;
    options.plane = plane;
    Model<2> model(box<2>({0.1, 0.1}, {1, 1}), fem::ElementFamily::hypercube, options, fem::DamagePlasticConcrete(p),
                   loads);
    for (int step = 1; step <= steps; ++step)
      {
        const auto report = model.solver->advance_to(double(step) / steps);
        INFO(report.reason);
        REQUIRE(report.converged);
      }
    return account_of(model);
  }
}

TEST_CASE(
  "energy of a static solid: one long step dissipates as much as many short ones, and its balance shows its error",
  "[fem]")
{
  struct Case
  {
    fem::Plane plane;
    double     nonlocal_length, tolerance;
  };
  // The free side of the element does not go straight within the step, as the estimate has it.
  for (const Case &c :
       {Case{fem::Plane::stress, 0, 0.05}, Case{fem::Plane::strain, 0, 0.08}, Case{fem::Plane::strain, 0.15, 0.08}})
    {
      const Account one = pulled_in(1, c.plane, c.nonlocal_length), some = pulled_in(50, c.plane, c.nonlocal_length),
                    many = pulled_in(200, c.plane, c.nonlocal_length);
      CAPTURE(c.plane == fem::Plane::stress, c.nonlocal_length, one.work, some.work, many.work, one.stored, many.stored,
              one.dissipated.total(), some.dissipated.total(), many.dissipated.total(), one.error(), some.error(),
              many.error());
      CHECK(one.error() > 0.3);
      CHECK(one.error() == Approx(std::fabs(one.work - many.work) / many.work).epsilon(0.1)); // of the right size
      CHECK(one.dissipated.total() == Approx(many.dissipated.total()).epsilon(c.tolerance));
      CHECK(one.dissipated.damage == Approx(many.dissipated.damage).epsilon(c.tolerance));
      CHECK(one.dissipated.plasticity == Approx(many.dissipated.plasticity).epsilon(c.tolerance));
      CHECK(some.error() < 0.02);
      const double order = std::log(some.error() / many.error()) / std::log(200.0 / 50.0);
      CHECK(order > 1.7); // of second order, but where damage begins within a step
      CHECK(order < 2.1);
      CHECK(many.dissipated.damage > 0);
      CHECK(many.dissipated.plasticity > many.dissipated.damage);
    }
}

TEST_CASE("energy of a static solid: stretched by half in steps, St. Venant and Kirchhoff's balances to second order",
          "[fem]")
{
  double error[2];
  for (const int finer : {0, 1})
    {
      fem::Loads<2> loads;
      loads.displacements.push_back({"0", 0, zero});
      loads.displacements.push_back({"2", 1, zero});
      loads.displacements.push_back({"1", 0, [](const Point<2> &, double t) { return 0.5 * t; }});
      fem::SolidOptions options;
      options.large_displacement = true;
      Model<2>  model(box<2>({1, 1}, {1, 1}), fem::ElementFamily::hypercube, options, elastic(1e9, 0.3), loads);
      const int steps = finer ? 8 : 4;
      for (int step = 1; step <= steps; ++step)
        REQUIRE(model.solver->advance_to(double(step) / steps).converged);
      const Account account = account_of(model);
      CHECK(account.dissipated.total() == 0);
      error[finer] = account.error();
    }
  CHECK(error[0] > 1e-4);
  CHECK(error[0] / error[1] == Approx(4).epsilon(0.05));
}

TEST_CASE("dissipation of concrete: what a point stores and dissipates is the work of its stresses, on paths that turn",
          "[fem]")
{
  auto p         = material_m1();
  p.element_size = 0.1;
  const fem::DamagePlasticConcrete law(p);
  const auto                       account = [&](const int steps) {
    fem::DamagePlasticState state;
    double                  work = 0;
    fem::Dissipation        lost;
    const base::Voigt       start = base::Voigt::Zero();
    base::Voigt             last  = start;
    for (const base::Voigt &corner : {(base::Voigt() << 4e-4, 0, 0, 0, 1e-4, 0).finished(),
                                      (base::Voigt() << -1e-3, 2e-4, 2e-4, 0, 1e-4, 3e-4).finished(),
                                      (base::Voigt() << -1e-4, 6e-4, 1e-4, 2e-4, 0, -4e-4).finished()})
      {
        for (int k = 1; k <= steps; ++k)
          {
            const auto next = law.evaluate(last + (corner - last) * (double(k) / steps), state, {}).trial;
            const auto d = law.dissipation(state, next);
            CHECK(d.plasticity >= 0);
            CHECK(d.damage >= 0);
            lost.add(d);
            work += 0.5 * (state.stress + next.stress).dot(next.strain - state.strain);
            state = next;
          }
        last = corner;
      }
    CHECK(state.damage > 0.1);
    return std::fabs(work - law.stored_energy(state.strain, state.stress, state) - lost.total()) / work;
  };
  const double coarse = account(50), fine = account(100);
  CAPTURE(coarse, fine);
  CHECK(coarse < 1e-2);
  CHECK(coarse / fine == Approx(4).epsilon(0.1)); // second order
}
