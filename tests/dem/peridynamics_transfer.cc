#include "peridynamics_bodies.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

using namespace peridynamic_tests;

namespace
{
  Case body_of(const Space space, const Layout layout, const BondModel model)
  {
    Case c           = plate(20, layout);
    c.body.space     = space;
    c.material.model = model;
    c.body.size      = {1.0, space == Space::rod ? 0.0 : 0.6, space == Space::space ? 0.4 : 0.0};
    if (space != Space::rod)
      c.body.holes = {{"hole", {0.1, 0.05, 0}, 0.16}};
    return c;
  }

  /** Sum of forces and of moments about the deformed places, and what they are measured by. */
  struct Sums
  {
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
    double          magnitude = 0;

    void add(const Eigen::Vector3d &place, const Eigen::Vector3d &f)
    {
      force += f;
      moment += place.cross(f);
      magnitude += f.norm();
    }
  };
} // namespace

TEST_CASE("tractions keep force and moment about the deformed body, on straight and curved boundaries", "[dem]")
{
  for (const Space space : {Space::rod, Space::plane_stress, Space::space})
    for (const Layout layout : {Layout::cell_centred, Layout::boundary_nodes})
      for (const BondModel model : {BondModel::prototype, BondModel::general})
        for (const TractionWeight weight : {TractionWeight::paper, TractionWeight::consistent})
          {
            const Case c    = body_of(space, layout, model);
            const Grid grid = c.grid();
            Field      u    = grid.field();
            for (const std::size_t i : grid.nodes())
              {
                const Eigen::Vector3d x = grid.position(i);
                u.add(i, 0.05 * Eigen::Vector3d(std::sin(3 * x.x() + x.y()), std::cos(2 * x.y()) * x.x(),
                                                x.x() * x.y() + 0.3 * x.z()));
              }
            std::vector<std::string> boundaries = side_names(grid.dimension());
            if (space != Space::rod)
              boundaries.push_back("hole");
            for (const std::string &boundary : boundaries)
              {
                CAPTURE(dimension_of(space), boundary);
                const Transfer transfer(grid, c.horizon.ratio * grid.spacing(), model, boundary_points(grid, boundary),
                                        weight, TractionForm::transfer);
                CHECK(transfer.singular() == 0);
                Sums                         requested, given;
                std::vector<Eigen::Vector3d> tractions;
                for (const BoundaryPoint &p : transfer.points())
                  {
                    Eigen::Vector3d t(1.0 + p.place.y(), std::sin(5 * p.place.x()), 0.3 - p.place.z());
                    for (int a = grid.dimension(); a < 3; ++a)
                      t[a] = 0;
                    tractions.push_back(t);
                    requested.add(transfer.place_of(p, &u), p.area * t);
                  }
                Field forces = grid.field();
                transfer.add(tractions, &u, forces);
                for (const std::size_t i : grid.nodes())
                  given.add(grid.position(i) + u.at(i), forces.at(i));
                CHECK((given.force - requested.force).norm() < 1e-12 * requested.magnitude);
                CHECK((given.moment - requested.moment).norm() < 1e-12 * requested.magnitude);
              }
          }
}

TEST_CASE("tensors of the transfer are well conditioned everywhere, and guarded where nodes lie on a line", "[dem]")
{
  const Case wide = plate(50, Layout::cell_centred);
  for (const std::string &side : side_names(2))
    {
      const Grid     grid = wide.grid();
      const Transfer t(grid, 3.015 * grid.spacing(), BondModel::prototype, boundary_points(grid, side),
                       TractionWeight::paper, TractionForm::transfer);
      CHECK(t.singular() == 0);
      CHECK(t.condition() > 2);
      CHECK(t.condition() < 3.6);
    }
  Case strip          = plate(50, Layout::cell_centred);
  strip.body.size     = {1.0, 0.02, 0.0};
  const Grid     grid = strip.grid();
  const Transfer t(grid, 3.015 * grid.spacing(), BondModel::prototype, boundary_points(grid, "right"),
                   TractionWeight::paper, TractionForm::transfer);
  CHECK(t.singular() == 1);
  Field forces = grid.field();
  t.add({Eigen::Vector3d(2, 3, 0)}, nullptr, forces);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::size_t i : grid.nodes())
    sum += forces.at(i);
  CHECK((sum - t.points()[0].area * Eigen::Vector3d(2, 3, 0)).norm() < 1e-12 * sum.norm());
}

TEST_CASE("a pulled rod has the published errors of its displacement", "[dem]")
{
  struct Row
  {
    BondModel model;
    Layout    layout;
    Volumes   volumes;
    double    errors[4]; // of N, m = 50, 3 | 100, 3 | 100, 6 | 200, 12 [%]
    double    margin;    // half of the last digit
  };
  constexpr BondModel pm = BondModel::prototype, general = BondModel::general;
  constexpr Layout    A = Layout::boundary_nodes, B = Layout::cell_centred;
  // peridynamics.md of the source documents, table 7.1.
  const Row    rows[]   = {{pm, B, Volumes::partial, {0.0000, 0.0000, 0.0000, 0.0000}, 5.1e-5},
                           {pm, A, Volumes::partial, {1.53, 0.76, 0.53, 0.20}, 5.1e-3},
                           {pm, B, Volumes::full, {23.9, 24.4, 13.7, 7.4}, 5.1e-2},
                           {general, B, Volumes::partial, {5.07, 5.17, 1.33, 0.34}, 5.1e-3},
                           {general, B, Volumes::full, {34.4, 35.0, 20.2, 11.0}, 5.1e-2}};
  const int    cells[]  = {50, 100, 100, 200};
  const double ratios[] = {3, 3, 6, 12};
  for (const Row &row : rows)
    for (int n = 0; n < 4; ++n)
      {
        CAPTURE(n, row.errors[n], row.model == pm, row.layout == B, row.volumes == Volumes::partial);
        const Case  c     = rod(cells[n], ratios[n], row.model, row.layout, row.volumes);
        const Bonds bonds = c.bonds();
        const Field u     = displacement(c, bonds);
        double      error = 0;
        for (const std::size_t i : bonds.grid().nodes())
          error = std::max(error, std::abs(u.c[0][i] - q / E * bonds.grid().position(i).x()));
        CHECK(100 * error / (q / (2 * E)) == Approx(row.errors[n]).margin(row.margin).epsilon(0));
      }
}
