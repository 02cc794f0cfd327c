// Solids whose points are cells of particles.
#include "fem/materials/anisotropic_elastic.h"
#include "fem/points/points_of.h"
#include "tests/coupling/multiscale_fixture.h"
#include "tests/fem/solid_fixture.h"

#include <Eigen/Geometry>

#include <omp.h>

#include <cmath>

using namespace multiscale;
using dealii::Point;
using dealii::Tensor;
using fem::ElementFamily;

namespace
{
  constexpr double side = 100; ///< of the solids [m]: wide for cells of 8 m

  /** A box with two materials: the elements whose number along x is `weak` are the second. */
  struct Bar
  {
    Bar(std::unique_ptr<fem::MaterialPoints> strong,
        std::unique_ptr<fem::MaterialPoints> weak,
        const unsigned int                   elements,
        const double                         tolerance = 1e-9)
      : solid(fem::make_mesh<3>(mesh(elements), ElementFamily::hypercube, MPI_COMM_SELF), {})
    {
      solid.assign("0", std::move(strong));
      solid.assign("1", std::move(weak));
      fem::Loads<3> loads;
      const auto    zero = [](const Point<3> &, double) { return 0.0; };
      loads.displacements.push_back({"0", 0, zero});
      loads.displacements.push_back({"2", 1, zero});
      loads.displacements.push_back({"4", 2, zero});
      loads.displacements.push_back({"1", 0, [](const Point<3> &, double t) { return t * side; }});
      solid.set_loads(loads);
      fem::NewtonOptions newton;
      newton.tolerance = tolerance;
      solver           = std::make_unique<fem::StaticSolver<3>>(solid, newton);
    }

    static fem::BuildMesh<3> mesh(const unsigned int n)
    {
      return [n](dealii::Triangulation<3> &built) {
        dealii::GridGenerator::subdivided_hyper_rectangle(built, {n, 1u, 1u}, Point<3>(), Point<3>(side, 20, 20), true);
        for (const auto &cell : built.active_cell_iterators())
          cell->set_material_id(static_cast<unsigned int>(cell->center()[0] / side * n) == n / 2 ? 1 : 0);
      };
    }

    double                      force() const { return solver->reaction("1")[0]; }
    const coupling::CellPoints &cells(const std::string &group) const
    {
      return dynamic_cast<const coupling::CellPoints &>(*solid.groups().at(group));
    }

    fem::Solid<3>                         solid;
    std::unique_ptr<fem::StaticSolver<3>> solver;
  };

  Tensor<1, 3> bent(const Point<3> &x, const double t)
  {
    Tensor<1, 3> u;
    u[0] = 1e-5 * t * (x[0] + 0.3 * x[1] * x[1] / side);
    u[1] = 1e-5 * t * (-0.2 * x[1] + 0.5 * x[2]);
    u[2] = 1e-5 * t * x[0] * x[2] / side;
    return u;
  }
} // namespace

TEST_CASE("multiscale: with elastic cells a solid is that of the relaxed stiffness", "[coupling][multiscale]")
{
  const auto                    cell = prepared();
  const fem::AnisotropicElastic plain(cell->stiffness());
  fem::Vector                   u[2];
  for (const bool particles : {true, false})
    {
      fem::Solid<3> solid(
        fem::make_mesh<3>(box<3>({side, side, side}, {2, 2, 2}, 0.15), ElementFamily::hypercube, MPI_COMM_SELF), {});
      if (particles)
        solid.assign("0", points({cell}));
      else
        solid.assign("0", fem::make_points(plain, fem::Plane::strain));
      fem::Loads<3> loads = hold_all<3>(bent);
      loads.displacements.erase(loads.displacements.begin() + 3, loads.displacements.begin() + 6); // one face is free
      solid.set_loads(loads);
      fem::StaticSolver<3> solver(solid);
      REQUIRE(solver.advance_to(1).converged);
      u[particles ? 0 : 1] = solver.displacement();
      if (particles)
        CHECK(dynamic_cast<const coupling::CellPoints &>(*solid.groups().at("0")).promoted() == 0);
    }
  const double size = u[1].l2_norm();
  u[0] -= u[1];
  CHECK(u[0].l2_norm() < 1e-8 * size);
}

TEST_CASE("multiscale: a bar with one weak cell promotes only there, and is that of cells everywhere",
          "[coupling][multiscale]")
{
  auto everywhere       = parameters(1e-10);
  everywhere.from_start = true;
  Bar few(points({prepared(concrete(1e-3), parameters(1e-10))}), points({prepared(concrete(), parameters(1e-10))}), 5);
  Bar all(points({prepared(concrete(1e-3), everywhere)}), points({prepared(concrete(), everywhere)}), 5);
  for (int step = 1; step <= 8; ++step)
    {
      for (Bar *bar : {&few, &all})
        {
          const auto report = bar->solver->advance_to(1.2e-5 * step);
          INFO(report.reason);
          REQUIRE(report.converged);
        }
      CHECK(few.force() == Approx(all.force()).epsilon(1e-6));
    }
  CHECK(few.cells("0").promoted() == 0);
  CHECK(few.cells("1").promoted() == 8);
  CHECK(few.cells("1").record(0).damage > 1e-4);
  CHECK(all.cells("0").promoted() == 32);
}

TEST_CASE("multiscale: Newton's method of the structure converges with the square of the error while links damage",
          "[coupling][multiscale]")
{
  Bar bar(points({prepared(concrete(), parameters(1e-12))}), points({prepared(concrete(0.9e-4), parameters(1e-12), 4)}),
          3);
  for (const double to : {6e-5, 9e-5, 1.1e-4, 1.2e-4})
    {
      const auto report = bar.solver->advance_to(to);
      INFO(report.reason);
      REQUIRE(report.converged);
    }
  CHECK(bar.cells("1").record(0).damage > 1e-4);
  // A step that does not converge changes nothing: one with ever more iterations shows the residuals.
  std::vector<double> residual;
  const double        next = 1.32e-4;
  for (unsigned int iterations = 1; iterations <= 8; ++iterations)
    {
      fem::NewtonOptions newton;
      newton.iterations  = iterations;
      newton.tolerance   = 1e-13;
      newton.line_search = false;
      fem::StaticSolver<3> solver(bar.solid, newton);
      fem::StaticState     from = bar.solver->state();
      from.last_length          = 0; // no extrapolation
      solver.restore(from);
      const base::Column points = bar.solid.saved_points();
      const auto         report = solver.advance_to(next);
      bar.solid.restore_points(points);
      residual.push_back(report.residual);
      if (report.converged || report.residual < 1e-12)
        break;
    }
  std::string all;
  for (const double r : residual)
    all += std::to_string(std::log10(r)) + " ";
  REQUIRE(residual.size() > 2);
  std::size_t last = residual.size() - 1;
  while (last > 2 && residual[last] < 1e-12)
    --last;
  const double order =
    std::log(residual[last] / residual[last - 1]) / std::log(residual[last - 1] / residual[last - 2]);
  INFO("residuals 10^ " << all << ", order " << order);
  CHECK(order > 1.7);
  CHECK(order < 2.3);
}

TEST_CASE("multiscale: turning the structure turns its answer", "[coupling][multiscale]")
{
  fem::SolidOptions far;
  far.large_displacement = true;
  fem::Solid<3> solid(fem::make_mesh<3>(box<3>({side, side, side}, {1, 1, 1}), ElementFamily::hypercube, MPI_COMM_SELF),
                      far);
  solid.assign("0", points({prepared()}, coupling::Localised::go_on, true));
  fem::Loads<3> loads;
  loads.may_move_freely = true;
  solid.set_loads(loads);
  Eigen::Matrix3d F;
  F << 1 + 1.2e-4, 1e-4, 0, -1e-4, 1 - 5e-5, 5e-5, 0, 1e-4, 1 + 4e-5;
  const Eigen::Matrix3d        R = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  std::vector<Eigen::Vector3d> force[2];
  for (const bool turned : {false, true})
    {
      fem::Vector                                  u = solid.make_vector(), f = solid.make_vector();
      std::vector<dealii::types::global_dof_index> dofs(solid.dofs().get_fe().n_dofs_per_cell());
      const Eigen::Matrix3d                        gradient = (turned ? R * F : F) - Eigen::Matrix3d::Identity();
      for (const auto &cell : solid.dofs().active_cell_iterators())
        {
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            {
              const auto [c, v]       = solid.dofs().get_fe().system_to_component_index(i);
              const Eigen::Vector3d X = {cell->vertex(v)[0], cell->vertex(v)[1], cell->vertex(v)[2]};
              u[dofs[i]]              = gradient.row(c) * X;
            }
        }
      fem::Sweep wanted;
      wanted.internal_force = &f;
      solid.sweep(u, wanted);
      for (const auto &cell : solid.dofs().active_cell_iterators())
        {
          cell->get_dof_indices(dofs);
          for (unsigned int v = 0; v < 8; ++v)
            {
              Eigen::Vector3d node;
              for (unsigned int c = 0; c < 3; ++c)
                node[c] = f[dofs[solid.dofs().get_fe().component_to_system_index(c, v)]];
              force[turned ? 1 : 0].push_back(node);
            }
        }
    }
  double largest = 0, wrong = 0;
  for (std::size_t i = 0; i < force[0].size(); ++i)
    {
      largest = std::max(largest, force[0][i].norm());
      wrong   = std::max(wrong, (force[1][i] - R * force[0][i]).norm());
    }
  CHECK(largest > 0);
  CHECK(wrong < 1e-10 * largest);
}

TEST_CASE("multiscale: goes on from a saved state to the same bits, with any number of threads",
          "[coupling][multiscale]")
{
  const auto weak = prepared(concrete(0.8e-4));
  Bar        through(points({prepared()}), points({weak}), 3), resumed(points({prepared()}), points({weak}), 3);
  const auto go = [](Bar &bar, const double to) {
    const auto report = bar.solver->advance_to(to);
    INFO(report.reason);
    REQUIRE(report.converged);
  };
  for (const double to : {4e-5, 6e-5, 7e-5})
    go(through, to);
  resumed.solver->restore(through.solver->state());
  resumed.solid.restore_points(through.solid.saved_points());
  CHECK(resumed.cells("1").promoted() == through.cells("1").promoted());
  CHECK(through.cells("1").promoted() > 0);
  go(through, 8e-5);
  omp_set_num_threads(2);
  go(resumed, 8e-5);
  omp_set_num_threads(1);
  fem::Vector difference = through.solver->displacement();
  difference -= resumed.solver->displacement();
  CHECK(difference.linfty_norm() == 0);
  CHECK(through.force() == resumed.force());
  CHECK(through.solver->energy().dissipated.damage == resumed.solver->energy().dissipated.damage);
  CHECK(through.solver->energy().dissipated.damage > 0);
}

TEST_CASE(
  "multiscale: with a crack band the dissipation of a localised cell does not depend on the width of its element",
  "[coupling][multiscale][slow]")
{
  std::vector<double> dissipated;
  constexpr double    widest = 1.5e-3; // opening of the band [m]: its cell is 8 m long
  auto                law    = concrete();
  law.relative_ductility     = 100;
  for (const double width : {10.0, 20.0})
    {
      auto of = points({prepared(law)}, coupling::Localised::crack_band);
      of->allocate(1);
      fem::GatheredPoints::Site site;
      site.element = fem::ElementExtent::uniform(width);
      of->place({site}, {});
      double strain = 0, lost = 0, opening = 0;
      for (double step = 1e-6; opening < widest;)
        try
          {
            INFO("strain " << strain << ", opening " << opening);
            REQUIRE(step > 1e-10);
            requested(*of, (strain + step) * base::Voigt::Unit(0));
            strain += step;
            const fem::Dissipation d = of->dissipated(0, site.element);
            of->commit();
            if (const coupling::CrackBand *band = of->band(0))
              {
                lost += (d.damage + d.plasticity) * width;
                opening = band->last_jump().norm() * band->share_of_cell() * width;
              }
            REQUIRE(of->end_of_validity().empty());
            step = std::min(1e-6, 2 * step);
          }
        catch (const fem::MaterialFailure &)
          {
            step /= 2;
          }
      dissipated.push_back(lost);
    }
  CHECK(dissipated[0] > 0);
  CHECK(dissipated[1] == Approx(dissipated[0]).epsilon(0.03));
}
