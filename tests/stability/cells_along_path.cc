// S17 for a structure: what representative_volume_path.cc shows for one cell, with cells behind all points of a solid.
#include "tests/coupling/multiscale_fixture.h"
#include "tests/fem/solid_fixture.h"

#include <cmath>

using namespace multiscale;
using dealii::Point;

namespace
{
  constexpr double      length = 30, width = 20; ///< of the block [m]: its elements are 10 m wide, the cells 8 m
  const Eigen::Vector3d rest = {0, 0, 0};

  /** A way of the head of the block, corner by corner, each leg in so many steps: its displacement over the length of the block. */
  using Path = std::vector<std::pair<Eigen::Vector3d, int>>;

  /** A block of three elements, held at its foot, whose head is driven along a path. The middle one may be weaker. */
  struct LedBlock
  {
    LedBlock(std::unique_ptr<coupling::CellPoints> ends, std::unique_ptr<coupling::CellPoints> middle)
      : solid(fem::make_mesh<3>(mesh(), fem::ElementFamily::hypercube, MPI_COMM_SELF), {})
    {
      solid.assign("0", std::move(ends));
      solid.assign("1", std::move(middle));
      fem::Loads<3> loads;
      for (unsigned int c = 0; c < 3; ++c)
        {
          loads.displacements.push_back({"0", c, [](const Point<3> &, double) { return 0.0; }});
          loads.displacements.push_back(
            {"1", c, [this, c](const Point<3> &, const double) { return length * head[c]; }});
        }
      solid.set_loads(loads);
      fem::NewtonOptions newton;
      newton.tolerance = 1e-11;
      solver           = std::make_unique<fem::StaticSolver<3>>(solid, newton);
    }

    static fem::BuildMesh<3> mesh()
    {
      return [](dealii::Triangulation<3> &built) {
        dealii::GridGenerator::subdivided_hyper_rectangle(built, {3u, 1u, 1u}, Point<3>(),
                                                          Point<3>(length, width, width), true);
        for (const auto &cell : built.active_cell_iterators())
          cell->set_material_id(std::fabs(cell->center()[0] - length / 2) < 1 ? 1 : 0);
      };
    }

    void drive(const Path &path)
    {
      for (const auto &[target, steps] : path)
        {
          const Eigen::Vector3d from = head;
          for (int k = 1; k <= steps; ++k)
            {
              head              = from + k / static_cast<double>(steps) * (target - from);
              const auto report = solver->advance_to(solver->time() + 1);
              INFO(report.reason);
              REQUIRE(report.converged);
            }
        }
    }

    const coupling::CellPoints &cells(const std::string &group) const
    {
      return dynamic_cast<const coupling::CellPoints &>(*solid.groups().at(group));
    }

    Eigen::Vector3d                       head = rest;
    fem::Solid<3>                         solid;
    std::unique_ptr<fem::StaticSolver<3>> solver;
  };

  std::shared_ptr<const coupling::PreparedCell>
  cell(const bool from_start, const bool only_solved, const double limit_strain = 1e-4)
  {
    coupling::CellParameters p = parameters(1e-11);
    p.from_start               = from_start;
    p.only_solved              = only_solved;
    return prepared(concrete(limit_strain), p);
  }

  double distance(const fem::Vector &a, const fem::Vector &b)
  {
    fem::Vector difference = a;
    difference -= b;
    return difference.l2_norm() / b.l2_norm();
  }

  const Eigen::Vector3d way = {2e-5, -6e-6, 8e-6}, aside = {-8e-6, 1.6e-5, 4e-6};
} // namespace

TEST_CASE("S17: an elastic path of 1000 steps with reversal leaves no trace in a structure of cells",
          "[stability][coupling][multiscale][slow]")
{
  // Elastic by what is known of the cell; by particles that are visited each time; by particles that are solved for.
  for (const auto &[from_start, only_solved] :
       std::vector<std::pair<bool, bool>>{{false, false}, {true, false}, {true, true}})
    {
      const auto what = cell(from_start, only_solved);
      LedBlock   direct(points({what}), points({what})), around(points({what}), points({what}));
      direct.drive({{0.5 * way, 1}});
      // There, aside so that the path encloses an area, past the start and back: 1000 steps.
      around.drive({{way, 300}, {way + aside, 200}, {-0.3 * way, 300}, {0.5 * way, 200}});
      CHECK(around.cells("0").promoted() == (from_start ? 16 : 0));
      CHECK(around.cells("1").promoted() == (from_start ? 8 : 0));
      const fem::Dissipation &lost = around.solver->energy().dissipated;
      CHECK(lost.damage + lost.plasticity == Approx(0).margin(1e-10 * around.solver->energy().internal));
      CHECK(distance(around.solver->displacement(), direct.solver->displacement()) < 1e-8);
      CHECK(distance(around.solver->internal_force(), direct.solver->internal_force()) < 1e-8);
    }
}

TEST_CASE("S17: after the path a structure of cells is pulled until one localises, and names it",
          "[stability][coupling][multiscale][slow]")
{
  LedBlock block(points({cell(false, false)}, coupling::Localised::stop),
                 points({cell(false, false, 0.8e-4)}, coupling::Localised::stop));
  block.drive({{way, 20}, {-0.3 * way, 20}, {rest, 10}});
  double peak = 0, last = 0;
  for (int step = 0; step < 300 && block.solid.end_of_validity().empty(); ++step)
    {
      block.drive({{block.head + Eigen::Vector3d(1e-6, 0, 0), 1}});
      last = block.solver->reaction("1")[0];
      peak = std::max(peak, last);
    }
  INFO(block.solid.end_of_validity());
  CHECK_THAT(block.solid.end_of_validity(), Catch::Contains("the cell at") &&
                                              Catch::Contains("has localised in state") &&
                                              Catch::Contains("across the normal"));
  CHECK(block.cells("0").localisations().empty());
  REQUIRE_FALSE(block.cells("1").localisations().empty());
  for (const auto &found : block.cells("1").localisations())
    {
      CHECK(std::fabs(found.place[0] - length / 2) < 5); // in the weak element
      CHECK(std::fabs(found.normal[0]) > 0.9);           // across the pull
    }
  CHECK(last > 0.95 * peak); // at once, not when all is over
  CHECK(block.cells("1").notes().size() == block.cells("1").localisations().size());
}
