// Cells of discs behind the points of plane models.
#include "coupling/multiscale/moving_cells.h"
#include "tests/coupling/multiscale_fixture.h"

#include <catch2/catch.hpp>

using namespace multiscale;
using homogenisation_fixture::relative_difference;

namespace
{
  coupling::CellParameters plane_parameters(const double tolerance = 1e-10)
  {
    coupling::CellParameters p = parameters(tolerance);
    p.links                    = homogenisation_fixture::plane_links(1.6, 0.2, 0.01, 25e9);
    return p;
  }

  std::shared_ptr<const coupling::PreparedCell> discs(const coupling::CellParameters &p = plane_parameters())
  {
    return std::make_shared<coupling::PreparedCell>(homogenisation_fixture::six_discs(), concrete(), p);
  }

  /** One point of a plane model. */
  std::unique_ptr<coupling::CellPoints> plane_point(const fem::Plane          plane,
                                                    const bool                large_strains = false,
                                                    const coupling::Localised localised = coupling::Localised::go_on)
  {
    coupling::CellPointsParameters p;
    p.cells     = {discs()};
    p.localised = localised;
    auto of     = std::make_unique<coupling::CellPoints>(p, plane);
    of->allocate(1);
    of->place(std::vector<fem::GatheredPoints::Site>(1), {true, large_strains, ""});
    return of;
  }

  /** In the plane: xx, yy and the shear xy. */
  base::Voigt strain_in_plane(const double xx, const double yy, const double xy)
  {
    base::Voigt strain = base::Voigt::Zero();
    strain << xx, yy, 0, 0, 0, xy;
    return strain;
  }
} // namespace

TEST_CASE("cells of discs: in the plane they have the stiffness of the static solution, in strain and in stress alike",
          "[coupling][multiscale]")
{
  const auto D =
    dem::relaxed_stiffness(dem::make_network(homogenisation_fixture::six_discs(), plane_parameters().links, concrete()))
      .stiffness;
  const base::Voigt strain = strain_in_plane(1e-6, -4e-7, 7e-7);
  const base::Voigt exact  = D * strain;
  for (const fem::Plane plane : {fem::Plane::strain, fem::Plane::stress})
    {
      const auto answer = requested(*plane_point(plane), strain);
      CHECK((answer.stress - exact).norm() < 1e-10 * exact.norm());
      CHECK(answer.stress.segment<3>(2).isZero(0));
      for (const int r : {0, 1, 5})
        for (const int c : {0, 1, 5})
          CHECK(answer.tangent(r, c) == Approx(D(r, c)).margin(1e-10 * D(0, 0)));
    }
}

TEST_CASE("cells of discs: the tangent is the derivative while links damage, and nothing comes from out of the plane",
          "[coupling][multiscale]")
{
  for (const bool large : {false, true})
    {
      coupling::CellPointsParameters p;
      p.cells = {discs(plane_parameters(1e-13))};
      coupling::CellPoints of(p, fem::Plane::strain);
      of.allocate(1);
      of.place(std::vector<fem::GatheredPoints::Site>(1), {true, large, ""});
      requested(of, strain_in_plane(1.6e-4, -3e-5, 5e-5));
      of.commit();
      CHECK(of.promoted() == 1);
      const base::Voigt strain = strain_in_plane(1.8e-4, -3e-5, 6e-5);
      const auto        answer = requested(of, strain);
      CHECK(of.dissipated(0, {}).damage > 0);
      base::Stiffness D = answer.tangent;
      for (const int c : {0, 1, 5})
        D.col(c) = (requested(of, strain + 1e-9 * base::Voigt::Unit(c), false).stress -
                    requested(of, strain - 1e-9 * base::Voigt::Unit(c), false).stress) /
                   2e-9;
      CHECK(relative_difference(answer.tangent, D) < 1e-6);
      CHECK(answer.stress.segment<3>(2).norm() < 1e-12 * answer.stress.norm());
    }
}

TEST_CASE("cells of discs: one that is pulled apart localises across the pull, in the plane", "[coupling][multiscale]")
{
  const auto of = plane_point(fem::Plane::stress, false, coupling::Localised::stop);
  for (int i = 1; i <= 400 && of->localisations().empty(); ++i)
    {
      requested(*of, strain_in_plane(5e-6 * i, -1e-6 * i, 0));
      of->commit();
    }
  REQUIRE(of->localisations().size() == 1);
  const Eigen::Vector3d normal = of->localisations().front().normal;
  CHECK(normal[2] == 0);
  CHECK(std::fabs(normal[0]) > 0.7);
  CHECK_THAT(of->end_of_validity(), Catch::Contains("has localised in state"));
}

TEST_CASE("cells of discs: they are refused in space, as spheres are in plane stress", "[coupling][multiscale]")
{
  coupling::CellPointsParameters p;
  p.cells = {discs()};
  coupling::CellPoints of(p, fem::Plane::strain);
  of.allocate(1);
  CHECK_THROWS_WITH(of.place(std::vector<fem::GatheredPoints::Site>(1), {false, false, ""}),
                    Catch::Contains("cells of discs are plane") && Catch::Contains("Set Model/Dimension = 2"));
  p.cells = {prepared()};
  CHECK_THROWS_WITH(coupling::CellPoints(p, fem::Plane::stress),
                    Catch::Contains("cells of spheres are not built for plane stress"));
}

TEST_CASE(
  "cells of discs in motion: driven slowly they come to the stress of the static solution, in strain and in stress",
  "[coupling][multiscale]")
{
  const base::Voigt strain = strain_in_plane(1e-6, -4e-7, 7e-7), exact = discs()->stiffness() * strain;
  for (const fem::Plane plane : {fem::Plane::strain, fem::Plane::stress})
    for (const bool large : {false, true})
      {
        coupling::MovingCellsParameters p{{homogenisation_fixture::six_discs()}, concrete(1), {}, 0, {}};
        p.specimen.physics.dimension = 2;
        p.specimen.thickness         = 0.01;
        p.specimen.density           = 2000;
        p.specimen.damping           = 0.6;
        p.specimen.interaction_ratio = 1.6;
        p.stiffness                  = discs()->stiffness();
        coupling::MovingCells of(p, plane);
        of.allocate(1);
        CHECK_THROWS_WITH(of.place(std::vector<fem::GatheredPoints::Site>(1), {false, large, ""}),
                          Catch::Contains("cells of discs are plane"));
        of.place(std::vector<fem::GatheredPoints::Site>(1), {true, large, ""});
        base::Voigt elsewhere = base::Voigt::Zero();
        elsewhere[2]          = 3e-7; // out of the plane they feel nothing
        for (int i = 1; i <= 800; ++i)
          {
            of.begin_motion(4e-5);
            of.gather({std::min(1.0, i / 400.0) * strain + elsewhere}, false);
          }
        fem::PointAnswer answer;
        of.evaluate(0, strain + elsewhere, {}, false, answer);
        CHECK((answer.stress - exact).norm() < 1e-3 * exact.norm());
        CHECK(answer.stress.segment<3>(2).isZero(0));
      }
}
