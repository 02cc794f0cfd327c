// Cells whose particles move while an explicit solid takes its steps.
#include "base/flat_state.h"
#include "coupling/multiscale/moving_cells.h"
#include "dem/homogenisation/macroscopic_stiffness.h"
#include "tests/coupling/multiscale_fixture.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>

using namespace multiscale;

namespace
{
  std::unique_ptr<coupling::MovingCells> moving(const std::size_t n_points, const bool large = false)
  {
    coupling::MovingCellsParameters p{{homogenisation_fixture::random_spheres(48, 3)}, concrete(1), {}, 0, {}};
    p.specimen.density           = 2000;
    p.specimen.damping           = 0.6;
    p.specimen.interaction_ratio = 1.6;
    p.stiffness                  = prepared()->stiffness();
    auto of                      = std::make_unique<coupling::MovingCells>(p, fem::Plane::strain);
    of->allocate(n_points);
    of->place(std::vector<fem::GatheredPoints::Site>(n_points), {false, large, ""});
    return of;
  }

  /** One larger cell whose links damage. */
  std::unique_ptr<coupling::MovingCells> brittle(const bool stops)
  {
    dem::CpmParameters law = concrete();
    law.relative_ductility = 10;
    coupling::MovingCellsParameters p{{homogenisation_fixture::random_spheres(250, 3)}, law, {}, 0, {}};
    p.specimen.density           = 2000;
    p.specimen.damping           = 0.3;
    p.specimen.interaction_ratio = 1.6;
    p.stops_localised            = stops;
    p.stiffness                  = prepared()->stiffness();
    auto of                      = std::make_unique<coupling::MovingCells>(p, fem::Plane::strain);
    of->allocate(1);
    fem::GatheredPoints::Site site;
    site.place = {1, 2, 3};
    site.element.vertices.fill(Eigen::Vector3d::Zero());
    of->place({site}, {});
    return of;
  }

  /** Evenly to a strain in so many steps of the solid. */
  void drive(
    coupling::MovingCells &of, const base::Voigt &from, const base::Voigt &to, const int steps, const std::size_t n = 1)
  {
    for (int i = 1; i <= steps; ++i)
      {
        of.begin_motion(2e-4);
        of.gather(std::vector<base::Voigt>(n, from + i / static_cast<double>(steps) * (to - from)), false);
      }
  }

  base::Voigt stress_at(coupling::MovingCells &of, const base::Voigt &strain, const std::size_t point = 0)
  {
    fem::PointAnswer answer;
    of.evaluate(point, strain, {}, false, answer);
    return answer.stress;
  }
} // namespace

TEST_CASE("moving cells: driven slowly they come to the stress of the static solution, and their own motion dies out",
          "[coupling][multiscale]")
{
  auto              of     = moving(1);
  const base::Voigt strain = mixed(1e-6), rest = base::Voigt::Zero();
  drive(*of, rest, strain, 400);
  drive(*of, strain, strain, 400);
  const base::Voigt expected = prepared()->stiffness() * strain;
  CHECK((stress_at(*of, strain) - expected).norm() < 1e-3 * expected.norm());
  CHECK(of->inertia_part(0).norm() < 1e-6 * expected.norm());
  const double stored = of->stored_energy(0, strain, expected);
  CHECK(stored == Approx(0.5 * strain.dot(expected)).epsilon(2e-3));
}

TEST_CASE("moving cells: the stress is that of the strain that they are driven to, not of the one before",
          "[coupling][multiscale]")
{
  auto of = moving(1);
  of->begin_motion(1e-9); // the particles have no time to move about
  const base::Voigt strain = mixed(1e-6);
  of->gather({strain}, false);
  const base::Voigt expected =
    dem::affine_stiffness(dem::make_network(homogenisation_fixture::random_spheres(48, 3), parameters().links)) *
    strain;
  CHECK((stress_at(*of, strain) - expected).norm() < 1e-4 * expected.norm());
}

TEST_CASE("moving cells: strains of a solid that turns far lead them as the stretch alone", "[coupling][multiscale]")
{
  auto              small = moving(1), large = moving(1, true);
  const base::Voigt rest = base::Voigt::Zero(), stretch = 0.01 * base::Voigt::Unit(0);
  base::Voigt       green = rest;
  green[0]                = 0.5 * (1.01 * 1.01 - 1);
  drive(*small, rest, stretch, 300);
  drive(*large, rest, green, 300);
  // Second Piola-Kirchhoff's stress along the stretch: J/lambda^2 times Cauchy's.
  CHECK(stress_at(*large, green)[0] == Approx(stress_at(*small, stretch)[0] / 1.01).epsilon(2e-3));
}

TEST_CASE("moving cells: the same bits for any number of threads, and from a state that was written and read",
          "[coupling][multiscale]")
{
  auto              one = moving(3), two = moving(3), again = moving(3);
  const base::Voigt rest = base::Voigt::Zero(), half = mixed(1e-6), full = mixed(2e-6);
  drive(*one, rest, half, 50, 3);
  omp_set_num_threads(2);
  drive(*two, rest, half, 50, 3);
  omp_set_num_threads(1);
  base::Column          saved;
  base::FlatStateWriter writer(saved);
  one->visit_more(writer);
  base::FlatStateReader reader(saved);
  again->visit_more(reader);
  for (std::size_t i = 0; i < 3; ++i)
    {
      std::vector<double> values;
      one->visit(
        i, [&](const fem::PointQuantity &of, const double *v) { values.insert(values.end(), v, v + of.values()); });
      again->visit(i, [&, next = 0](const fem::PointQuantity &of, double *v) mutable {
        std::copy_n(values.data() + next, of.values(), v);
        next += static_cast<int>(of.values());
      });
    }
  for (auto *of : {one.get(), two.get(), again.get()})
    drive(*of, half, full, 50, 3);
  for (std::size_t i = 0; i < 3; ++i)
    {
      CHECK(stress_at(*one, full, i) == stress_at(*two, full, i));
      CHECK(stress_at(*one, full, i) == stress_at(*again, full, i));
    }
}

TEST_CASE("moving cells: there is no answer without a step in time", "[coupling][multiscale]")
{
  auto             of = moving(1);
  fem::PointAnswer answer;
  CHECK_THROWS_WITH(of->evaluate(0, mixed(1e-6), {}, false, answer), Catch::Contains("explicit analysis only"));
  CHECK_THROWS_AS(of->evaluate(0, base::Voigt::Zero(), {}, true, answer), fem::MaterialFailure);
}

TEST_CASE("moving cells: fewer steps than their particles are stable with are refused", "[coupling][multiscale]")
{
  coupling::MovingCellsParameters p{{homogenisation_fixture::random_spheres(48, 3)}, concrete(1), {}, 3, {}};
  p.specimen.density           = 2000;
  p.specimen.interaction_ratio = 1.6;
  p.stiffness                  = prepared()->stiffness();
  coupling::MovingCells of(p, fem::Plane::strain);
  of.allocate(1);
  of.place(std::vector<fem::GatheredPoints::Site>(1), {});
  CHECK_NOTHROW(of.begin_motion(1e-6));
  CHECK_THROWS_WITH(of.begin_motion(1), Catch::Contains("Particle steps = 3") && Catch::Contains("Take at least"));
}

TEST_CASE(
  "moving cells: one that is pulled apart is named with the normal of its band, and ends the run or not, by choice",
  "[coupling][multiscale]")
{
  for (const bool stops : {true, false})
    {
      auto              of     = brittle(stops);
      const base::Voigt pulled = 3e-3 * base::Voigt::Unit(0), squeezed = -2e-5 * base::Voigt::Unit(0);
      drive(*of, base::Voigt::Zero(), squeezed, 20); // elastic: there and back
      drive(*of, squeezed, base::Voigt::Zero(), 20);
      CHECK(of->localisations().empty());
      double        stress_then = 0, peak = 0;
      constexpr int steps = 600;
      for (int i = 0; i < steps && of->localisations().empty(); ++i)
        {
          drive(*of, i / double(steps) * pulled, (i + 1) / double(steps) * pulled, 1);
          stress_then = stress_at(*of, (i + 1) / double(steps) * pulled)[0];
          peak        = std::max(peak, stress_then);
        }
      REQUIRE(of->localisations().size() == 1);
      const coupling::Localisation &found = of->localisations().front();
      CHECK(std::fabs(found.normal[0]) > 0.7); // along the pull; bands fit the cell
      CHECK(found.place == Eigen::Vector3d(1, 2, 3));
      CHECK(stress_then < peak);
      CHECK(of->notes().size() == 1);
      CHECK(of->end_of_validity().empty() == !stops);
    }
}
