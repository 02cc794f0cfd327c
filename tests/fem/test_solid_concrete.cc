#include "fem/references/concrete_points.h"
#include "fem/solvers/step_control.h"
#include "tests/fem/solid_fixture.h"

#include <algorithm>

using namespace fem::references;

using namespace dealii;
using fem::ElementFamily;

namespace
{
  /// A bar along x of n elements of which one, number `weak`, has material 1.
  fem::BuildMesh<2> bar(const double length, const double height, const unsigned int n, const unsigned int weak)
  {
    return [=](Triangulation<2> &mesh) {
      GridGenerator::subdivided_hyper_rectangle(mesh, {n, 1u}, Point<2>(), Point<2>(length, height), true);
      for (const auto &cell : mesh.active_cell_iterators())
        cell->set_material_id(static_cast<unsigned int>(cell->center()[0] / length * n) == weak ? 1 : 0);
    };
  }

  /// A bar of so many elements, pulled at its end by the time; the middle one has 99 % of the others' strength.
  struct WeakBar
  {
    double        length = 0.1, height = 0.01;
    unsigned int  n;
    double        crack_opening;
    fem::Solid<2> solid;

    WeakBar(const unsigned int elements, const double poisson_ratio)
      : n(elements)
      , solid(fem::make_mesh<2>(bar(length, height, n, n / 2), ElementFamily::hypercube, MPI_COMM_SELF), plane_stress())
    {
      auto p              = material_m1();
      p.element_size      = 0;
      p.largest_increment = 2e-4;
      p.poisson_ratio     = poisson_ratio;
      crack_opening       = p.crack_opening;
      fem::Loads<2> loads;
      loads.displacements.push_back({"0", 0, zero});
      loads.displacements.push_back({"1", 0, [](const Point<2> &, double t) { return t; }});
      loads.nodes.push_back({Point<2>(), 1, zero});
      solid.assign("0", fem::make_points(fem::DamagePlasticConcrete(p), fem::Plane::stress));
      p.tensile_strength *= 0.99;
      solid.assign("1", fem::make_points(fem::DamagePlasticConcrete(p), fem::Plane::stress));
      solid.set_loads(loads);
    }

    static fem::SolidOptions plane_stress()
    {
      fem::SolidOptions options;
      options.plane = fem::Plane::stress;
      return options;
    }

    void pull(fem::StaticSolver<2> &solver, const double to) const
    {
      fem::StepControl steps;
      steps.first    = 2e-6;
      steps.smallest = 1e-10;
      steps.largest  = 2e-5;
      fem::run_to(solver, to, steps, [](const fem::StepReport &, double) { return true; });
    }

    /// Strain of an element along the bar, at its lower edge.
    double strain(const fem::StaticSolver<2> &solver, const unsigned int element) const
    {
      double opening = 0;
      for (const double side : {1.0, -1.0})
        for (const auto &[dof, weight] :
             solid.interpolation(Point<2>((element + (side > 0 ? 1 : 0)) * length / n, 0), 0))
          opening += side * weight * solver.displacement()[dof];
      return opening * n / length;
    }
  };

  /// Work to pull a bar apart [J/m^2 of section].
  double work_of_separation(const unsigned int n)
  {
    WeakBar              bar_data(n, 0.2);
    fem::StaticSolver<2> solver(bar_data.solid);
    bar_data.pull(solver, 10 * bar_data.crack_opening);
    CHECK(solver.energy().external == Approx(solver.energy().internal).epsilon(1e-6));
    return solver.energy().internal / bar_data.height;
  }

  struct SnapBack
  {
    fem::DamagePlasticParameters p;
    double                       length = 10.0, height = 0.1;
    unsigned int                 n = 100; // elements of h = 0.1 m

    /// Elongation at a stress past the peak. Elastic bar; in the damaging element sigma = f_t exp(-w_c/w_f), with
    /// w_c = h (kappa_D + omega f_t/E), and the plastic strain reached at the peak stays.
    double closed_form(const double stress, const double plastic_at_peak) const
    {
      return stress * length / p.young_modulus - p.crack_opening * std::log(stress / p.tensile_strength) +
             plastic_at_peak * length / n;
    }
  };

  SnapBack one_dimensional_bar()
  {
    SnapBack bar_data;
    bar_data.p                   = material_m1();
    bar_data.p.poisson_ratio     = 0;
    bar_data.p.element_size      = 0;
    bar_data.p.largest_increment = 2e-4;
    return bar_data;
  }

  /// The bar held at x = 0, under further loads; element 50 is of concrete, the rest elastic.
  std::unique_ptr<fem::Solid<2>> solid_of(const SnapBack &bar_data, fem::Loads<2> loads)
  {
    loads.displacements.push_back({"0", 0, zero});
    loads.nodes.push_back({Point<2>(), 1, zero});
    auto solid = std::make_unique<fem::Solid<2>>(
      fem::make_mesh<2>(bar(bar_data.length, bar_data.height, bar_data.n, 50), ElementFamily::hypercube, MPI_COMM_SELF),
      fem::SolidOptions());
    solid->assign("0", fem::make_points(elastic(bar_data.p.young_modulus, 0), fem::Plane::strain));
    solid->assign("1", fem::make_points(fem::DamagePlasticConcrete(bar_data.p), fem::Plane::strain));
    solid->set_loads(loads);
    return solid;
  }

  /// Worst relative error of the end displacement past the peak; the path must turn back on the way.
  double follow_snap_back()
  {
    const SnapBack bar_data = one_dimensional_bar();
    const auto    &p        = bar_data.p;
    const double   h        = bar_data.length / bar_data.n;
    fem::Loads<2>  loads;
    loads.tractions.push_back({"1", [](const Point<2> &, double t) { return Tensor<1, 2>({1e6 * t, 0}); }});
    const auto           holder = solid_of(bar_data, loads);
    fem::Solid<2>       &solid  = *holder;
    fem::StaticSolver<2> solver(solid);

    fem::PathControl control; // the elongation of the damaging element only grows
    for (const double side : {1.0, -1.0})
      for (const auto &[dof, weight] : solid.interpolation(Point<2>(50 * h + (side > 0 ? h : 0), 0), 0))
        control.weights.emplace_back(dof, side * weight);
    fem::StepControl steps;
    steps.first = steps.largest = 1e-6;
    steps.smallest              = 1e-11;
    const auto end              = solid.interpolation(Point<2>(bar_data.length, 0), 0);

    double peak = 0, plastic_at_peak = 0, worst = 0, largest = 0, last = 0;
    int    past = 0, accepted = 0;
    fem::run_along(solver, control, steps, [&](const fem::StepReport &, double) {
      const double stress = 1e6 * solver.time();
      double       u      = 0;
      for (const auto &[dof, weight] : end)
        u += weight * solver.displacement()[dof];
      if (stress > peak)
        {
          peak            = stress;
          plastic_at_peak = u / h - stress * bar_data.length / (p.young_modulus * h);
        }
      else if (stress < 0.98 * peak)
        {
          ++past;
          worst = std::max(worst, std::fabs(u / bar_data.closed_form(stress, plastic_at_peak) - 1));
        }
      largest = std::max(largest, u);
      last    = u;
      return ++accepted < 5000 && (stress > 0.2 * p.tensile_strength || past == 0);
    });
    CHECK(peak == Approx(p.tensile_strength).epsilon(0.01));
    CHECK(last < 0.75 * largest); // it did snap back
    CHECK(past > 20);
    CHECK(accepted < 5000);
    return worst;
  }
}

TEST_CASE("each iteration towards equilibrium is reported, with its unbalanced force over the tolerance", "[fem]")
{
  WeakBar                                      bar_data(6, 0);
  std::vector<std::pair<unsigned int, double>> reported;
  fem::NewtonOptions                           newton;
  newton.on_iteration = [&](const unsigned int iteration, const double over) {
    reported.emplace_back(iteration, over);
  };
  fem::StaticSolver<2> solver(bar_data.solid, newton);
  // Pressed to half its strength, where concrete yields, in one step.
  const fem::StepReport step = solver.advance_to(-6e-4 * bar_data.length);
  REQUIRE(step.converged);
  REQUIRE(step.iterations > 1);
  REQUIRE(reported.size() >= step.iterations);
  for (std::size_t i = 0; i < reported.size(); ++i)
    CHECK(reported[i].first == i + 1);
  CHECK(reported.front().second > 1);
  CHECK(reported.back().second <= 1);
  CHECK(reported.back().second == Approx(step.residual / newton.tolerance));
}

TEST_CASE("concrete bar: the work of separation does not depend on the mesh", "[fem][slow]")
{
  const double fracture_energy = 0.99 * 3e6 * 3e-4;
  double       work[4];
  for (int i = 0; i < 4; ++i)
    work[i] = work_of_separation(5u << i);
  INFO(work[0] << " " << work[1] << " " << work[2] << " " << work[3] << " J/m^2");
  for (const double w : work)
    {
      CHECK(w == Approx(work[3]).epsilon(0.02));
      // Plastic work of the whole bar before the peak, of order f_t^2/E L / 3 = 10 J/m^2, comes on top: 1 %.
      CHECK(w == Approx(fracture_energy).epsilon(0.02));
    }
}

TEST_CASE("concrete bar: the weakest element opens alone, also where an iteration finds another equilibrium first",
          "[fem][slow]")
{
  // Steps that grow in the elastic part leap over the peak: all elements soften on the way, and Newton ends at a state in which two
  // stronger ones, beside the weak one, have opened. Nothing in it but its stability distinguishes it from the right one.
  using Case = std::pair<unsigned int, double>; // elements, Poisson's ratio
  for (const auto &[n, nu] : {Case{40, 0.0}, Case{40, 0.3}, Case{30, 0.2}})
    {
      INFO(n << " elements, nu = " << nu);
      WeakBar              bar_data(n, nu);
      fem::StaticSolver<2> solver(bar_data.solid);
      bar_data.pull(solver, 2e-5);
      for (unsigned int element = 0; element < n; ++element)
        if (element == n / 2)
          CHECK(bar_data.strain(solver, element) > 2e-3);
        else
          CHECK(bar_data.strain(solver, element) < 1.5e-4);
    }
}

TEST_CASE("S5: path control follows the snap-back of a bar with one damaging element to 1 %", "[fem][stability]")
{
  CHECK(follow_snap_back() < 0.01);
}

TEST_CASE("an iteration reports its progress, down to the tolerance", "[fem]")
{
  std::vector<std::pair<unsigned int, double>> reported;
  fem::NewtonOptions                           newton;
  newton.on_iteration = [&](const unsigned int iteration, const double over) {
    reported.emplace_back(iteration, over);
  };
  WeakBar               bar(4, 0);
  fem::StaticSolver<2>  solver(bar.solid, newton);
  const fem::StepReport report = solver.advance_to(1e-6);
  REQUIRE(report.converged);
  REQUIRE(reported.size() == report.iterations);
  CHECK(reported.back() == std::make_pair(report.iterations, report.residual / newton.tolerance));
  CHECK(reported.back().second <= 1);
}

TEST_CASE("relaxation: a bar that would snap back lets go to the equilibrium beyond, and says what that dissipates",
          "[fem][stability]")
{
  const SnapBack bar_data = one_dimensional_bar();
  const auto    &p        = bar_data.p;
  fem::Loads<2>  loads;
  loads.displacements.push_back({"1", 0, [](const Point<2> &, double t) { return t; }});
  const auto           solid = solid_of(bar_data, loads);
  fem::StaticSolver<2> solver(*solid);
  fem::StepControl     steps;
  steps.first = steps.largest = 2e-5;
  steps.smallest              = 1e-10;
  CHECK_THROWS_AS(fem::run_to(solver, 1.2e-3, steps, [](const auto &, double) { return true; }), fem::NoEquilibrium);
  CHECK(solver.energy().damped == 0);

  int relaxed = 0;
  steps.relax = true;
  fem::run_to(solver, 1.2e-3, steps, [&](const fem::StepReport &report, double) {
    relaxed += report.relaxed > 0 ? 1 : 0;
    return true;
  });
  CHECK(relaxed == 1);
  const double stress = solver.reaction("1")[0] / bar_data.height;
  CHECK(stress < 0.05 * p.tensile_strength);
  // Against the closed form; the plastic strain at the peak, below f_t/E, is up to 1e-5 m of the 1.2e-3 m.
  CHECK(bar_data.closed_form(stress, 0) == Approx(1.2e-3).epsilon(0.01));
  const fem::StaticEnergy energy = solver.energy();
  CHECK(energy.external == Approx(energy.internal + energy.damped).epsilon(1e-6));
  // What the bar stored at its strength, less what the crack took on the way to the stress beyond.
  const double stored = 0.5 * p.tensile_strength * p.tensile_strength / p.young_modulus * bar_data.length,
               crack  = p.crack_opening * (p.tensile_strength - stress);
  CHECK(energy.damped == Approx((stored - crack) * bar_data.height).epsilon(0.05));
}

TEST_CASE("arc length: every step has the prescribed length, and the load that belongs to it", "[fem]")
{
  const auto    p = material_m1();
  fem::Loads<2> loads;
  loads.displacements.push_back({"0", 0, zero});
  loads.nodes.push_back({Point<2>(), 1, zero});
  loads.tractions.push_back({"1", [](const Point<2> &, double t) { return Tensor<1, 2>({1e6 * t, 0}); }});
  fem::SolidOptions options;
  options.plane = fem::Plane::stress;
  Model<2> model(box<2>({1, 0.5}, {4, 2}), ElementFamily::hypercube, options, fem::DamagePlasticConcrete(p), loads);
  fem::PathControl control;
  control.kind = fem::PathControl::Kind::cylindrical;
  UniaxialPoint point(p); // the same material point, driven in strain
  for (int step = 1; step <= 8; ++step)
    {
      const fem::Vector before = model.solver->displacement();
      REQUIRE(model.solver->advance_along(control, 4e-5).converged);
      fem::Vector moved = model.solver->displacement();
      moved -= before;
      CHECK(moved.l2_norm() == Approx(4e-5).epsilon(1e-9));
      CHECK(1e6 * model.solver->time() == Approx(point.go_to(model.at({1, 0.25}, 0), 1)).epsilon(1e-6));
    }
  CHECK(model.solver->time() > 1.0); // beyond the elastic part
}

TEST_CASE("concrete specimen: one element of each kind answers like the material point", "[fem]")
{
  // Uniaxial tension of doc/theory/damage-plastic-concrete.md, 6, through mesh, assembly and solver.
  auto          p = material_m1();
  fem::Loads<3> loads;
  for (unsigned int c = 0; c < 3; ++c)
    loads.displacements.push_back({std::to_string(2 * c), c, [](const Point<3> &, double) { return 0.0; }});
  loads.displacements.push_back({"1", 0, [](const Point<3> &, double t) { return 1e-4 * t; }});
  for (const auto family : {ElementFamily::hypercube, ElementFamily::simplex})
    {
      Model<3> model(box<3>({1, 1, 1}, {1, 1, 1}), family, {}, fem::DamagePlasticConcrete(p), loads, {1e-10, 25, true});
      const double expected[3] = {0, 2948603, 1960544};
      for (int step = 1; step <= 2; ++step)
        {
          const auto report = model.solver->advance_to(step);
          INFO(report.reason);
          REQUIRE(report.converged);
          CHECK(model.solver->reaction("1")[0] == Approx(expected[step]).epsilon(1e-4));
        }
    }
}

TEST_CASE("a step that finds no equilibrium changes nothing, and shorter ones follow", "[fem]")
{
  auto          p = material_m1();
  fem::Loads<3> loads;
  for (unsigned int c = 0; c < 3; ++c)
    loads.displacements.push_back({std::to_string(2 * c), c, [](const Point<3> &, double) { return 0.0; }});
  loads.tractions.push_back({"1", [](const Point<3> &, double t) {
                               return Tensor<1, 3>({4e6 * t, 0, 0});
                             }}); // beyond f_t
  Model<3> model(box<3>({1, 1, 1}, {1, 1, 1}), ElementFamily::hypercube, {}, fem::DamagePlasticConcrete(p), loads);
  REQUIRE(model.solver->advance_to(0.5).converged);
  const fem::Vector before = model.solver->displacement();
  CHECK_FALSE(model.solver->advance_to(1.0).converged);
  CHECK(model.solver->time() == 0.5);
  fem::Vector same = model.solver->displacement();
  same -= before;
  CHECK(same.linfty_norm() == 0);
  fem::StepControl steps;
  steps.first    = 0.1;
  steps.smallest = 1e-4;
  CHECK_THROWS_WITH(fem::run_to(*model.solver, 1.0, steps, [](const fem::StepReport &, double) { return true; }),
                    Catch::Contains("no equilibrium beyond time 0.7"));
  CHECK(model.solver->time() == Approx(0.75).epsilon(2e-3)); // f_t / 4 MPa
}

TEST_CASE("a static run restored in its middle goes on to the same last bit", "[fem]")
{
  const auto    p = material_m1();
  fem::Loads<2> loads;
  for (unsigned int c = 0; c < 2; ++c)
    {
      loads.displacements.push_back({"0", c, zero});
      loads.displacements.push_back(
        {"1", c, [c](const Point<2> &x, double t) { return (c == 0 ? 3e-5 : 1e-5 * x[1]) * t; }});
    }
  fem::SolidOptions options;
  options.plane   = fem::Plane::stress;
  const auto make = [&] {
    return std::make_unique<Model<2>>(box<2>({0.2, 0.1}, {4, 3}), ElementFamily::hypercube, options,
                                      fem::DamagePlasticConcrete(p), loads);
  };
  auto straight = make(), resumed = make();
  for (int step = 1; step <= 4; ++step)
    REQUIRE(straight->solver->advance_to(step).converged);
  std::vector<double> history;
  straight->solid.visit_histories([&](const fem::PointQuantity &of, const double *values) {
    history.insert(history.end(), values, values + of.values());
  });
  std::size_t next = 0;
  resumed->solid.visit_histories([&](const fem::PointQuantity &of, double *values) {
    for (int i = 0; i < of.values(); ++i)
      values[i] = history[next++];
  });
  CHECK(next == history.size());
  resumed->solver->restore(straight->solver->state());
  for (int step = 5; step <= 8; ++step)
    {
      REQUIRE(straight->solver->advance_to(step).converged);
      REQUIRE(resumed->solver->advance_to(step).converged);
    }
  CHECK(*std::max_element(history.begin(), history.end()) > 0);
  CHECK(resumed->solver->energy().internal == straight->solver->energy().internal);
  CHECK(straight->solver->energy().dissipated.total() > 0);
  CHECK(resumed->solver->energy().dissipated.total() == straight->solver->energy().dissipated.total());
  fem::Vector difference = resumed->solver->displacement();
  difference -= straight->solver->displacement();
  CHECK(difference.linfty_norm() == 0);
}
