// Cells of particles as the answer of one integration point.
#include "base/flat_state.h"
#include "coupling/multiscale/ellipticity.h"
#include "coupling/multiscale/stretch.h"
#include "tests/coupling/multiscale_fixture.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <random>

using namespace multiscale;
using homogenisation_fixture::relative_difference;

namespace
{
  base::Voigt random_strain(std::mt19937 &draw)
  {
    std::normal_distribution<double> normal;
    base::Voigt                      e;
    for (int c = 0; c < 6; ++c)
      e[c] = normal(draw);
    return e;
  }

  /** Central differences of a point's answer, from its committed state. */
  base::Stiffness differences(coupling::CellPoints &of, const base::Voigt &strain, const double step)
  {
    base::Stiffness D;
    for (int c = 0; c < 6; ++c)
      D.col(c) = (requested(of, strain + step * base::Voigt::Unit(c), false).stress -
                  requested(of, strain - step * base::Voigt::Unit(c), false).stress) /
                 (2 * step);
    return D;
  }
} // namespace

TEST_CASE("cells: what all links feel follows from the macroscopic strain, and is that of the static solution",
          "[coupling][multiscale]")
{
  const auto   cell = prepared();
  std::mt19937 draw(1);
  for (int i = 0; i < 5; ++i)
    {
      const base::Voigt direction = random_strain(draw);
      const double      once      = cell->elastic_range()->nearest(1e-7 * direction).exertion;
      // The cell in equilibrium: its links begin to damage where the largest exertion is 1, and not before.
      const base::Voigt at   = 1e-7 / once * direction;
      auto              last = cell->promoted_at(0.5 * at, cell->system_of_thread(0));
      double            low = 0.5, high = 2;
      while (high - low > 1e-6)
        {
          const double middle = 0.5 * (low + high);
          last->respond(middle * at, cell->system_of_thread(0), false);
          dem::RespondingCell taken = *last;
          taken.commit();
          const dem::CellEnergy e                  = taken.energy();
          (e.damage + e.friction > 0 ? high : low) = middle;
        }
      INFO("exertion per strain " << once << ", elasticity ends at " << low);
      // Sliding is not linear in the strain (its strength hangs on the normal stress): nearest() at the end itself says 1.
      CHECK(cell->elastic_range()->nearest(low * at).exertion == Approx(1).epsilon(1e-5));
    }
}

TEST_CASE("cells: the bound by energy never calls a strain safe that is not, and is worth something",
          "[coupling][multiscale]")
{
  const auto   cell = prepared();
  std::mt19937 draw(2);
  int          safe = 0;
  for (int i = 0; i < 300; ++i)
    {
      base::Voigt e = random_strain(draw);
      e *= 2e-5 * std::fabs(random_strain(draw)[0]) / e.norm();
      const bool below = cell->elastic_range()->nearest(e).exertion < 0.9;
      if (cell->elastic_range()->surely_below(e))
        {
          ++safe;
          CHECK(below);
        }
      CHECK(cell->is_left_by(e) == !below);
    }
  CHECK(safe > 30);
}

TEST_CASE("cells: the stress is continuous where the particles take over, as their state is the static solution",
          "[coupling][multiscale]")
{
  for (const double sign : {1.0, -1.0})
    {
      auto        of        = points({prepared()});
      const auto  direction = mixed(sign);
      base::Voigt strain    = base::Voigt::Zero();
      double      size      = 0;
      const auto  cell      = prepared();
      while (!cell->is_left_by(size * direction))
        size += 1e-7;
      of->allocate(1);
      for (const double at : {0.5 * size, size - 1e-7})
        {
          CHECK(requested(*of, at * direction).stress == cell->stiffness() * (at * direction));
          of->commit();
        }
      CHECK(of->promoted() == 0);
      CHECK(of->cell(0) == nullptr);
      strain               = size * direction;
      const auto elastic   = base::Voigt(cell->stiffness() * strain);
      const auto particles = requested(*of, strain);
      CHECK(of->promoted() == 0); // only tried
      of->commit();
      CHECK(of->promoted() == 1);
      CHECK((particles.stress - elastic).norm() < 1e-10 * elastic.norm());
      CHECK(relative_difference(particles.tangent, cell->stiffness()) < 1e-10);
      // And the state that was taken is an equilibrium of its own: what the links bear is what the solution says.
      CHECK((requested(*of, strain).stress - elastic).norm() < 1e-10 * elastic.norm());
    }
}

TEST_CASE("cells: a cell that solves for everything has the elastic stiffness of the static periodic solution",
          "[coupling][multiscale]")
{
  auto p          = parameters(1e-13);
  p.from_start    = true;
  p.only_solved   = true;
  const auto cell = prepared(concrete(), p);
  auto       of   = points({cell});
  of->allocate(1);
  const auto network = dem::make_network(homogenisation_fixture::random_spheres(48, 3), p.links, concrete());
  const auto D       = dem::relaxed_stiffness(network).stiffness;
  for (int c = 0; c < 6; ++c)
    {
      const auto answer = requested(*of, 1e-6 * base::Voigt::Unit(c));
      CHECK(answer.stress[c] == Approx(1e-6 * D(c, c)).epsilon(1e-10));
      CHECK(answer.tangent(c, c) == Approx(D(c, c)).epsilon(1e-10));
    }
}

TEST_CASE("cells: the tangent of a point is the derivative of its stress, with damage and sliding under way",
          "[coupling][multiscale]")
{
  for (const double sign : {1.0, -1.0})
    for (const bool large : {false, true})
      {
        auto of = points({prepared(concrete(), parameters(1e-13))}, coupling::Localised::go_on, large);
        of->allocate(1);
        requested(*of, mixed(sign * 2e-4));
        of->commit();
        const auto             strain = mixed(sign * 2.2e-4);
        const auto             answer = requested(*of, strain);
        const fem::Dissipation lost   = of->dissipated(0, {});
        CHECK(lost.damage + lost.plasticity > 0);
        CHECK(relative_difference(answer.tangent, differences(*of, strain, 1e-9)) < 1e-6);
      }
}

TEST_CASE("cells: work of stresses is that of link forces, in elastic and in damaged states", "[coupling][multiscale]")
{
  const auto                  law     = concrete();
  const auto                  network = std::make_shared<dem::LoadedNetwork>(dem::strained_cell(dem::make_network(
                     homogenisation_fixture::random_spheres(48, 3), homogenisation_fixture::links(1.6, 0.2, 25e9), law)));
  dem::CellResponseParameters tight;
  tight.tolerance = 1e-12;
  dem::RespondingCell point(network, law, tight);
  std::mt19937        draw(5);
  for (const double size : {2e-5, 2e-4, 3e-4})
    {
      const auto answer = point.respond(mixed(size));
      point.commit();
      const auto forces = point.links().forces();
      for (int i = 0; i < 3; ++i)
        {
          const base::Voigt   change = 1e-6 * random_strain(draw);
          dem::RespondingCell moved  = point;
          moved.respond(mixed(size) + change);
          moved.commit();
          double links = 0;
          for (std::size_t l = 0; l < forces.size(); ++l)
            links -=
              forces[l].dot(dem::slip_of(*network, l, moved.motion()) - dem::slip_of(*network, l, point.motion()));
          const double stress = network->volume * answer.stress.dot(change);
          CHECK(std::fabs(std::fabs(links) - std::fabs(stress)) <
                1e-6 * network->volume * answer.stress.norm() * change.norm());
        }
    }
  CHECK(point.links().mean_damage() > 0.05);
}

TEST_CASE("cells: a law for small strains answers to large ones without feeling rotations", "[coupling][multiscale]")
{
  std::mt19937 draw(7);
  for (int i = 0; i < 5; ++i)
    {
      const base::Voigt       e = 0.2 * random_strain(draw);
      const Eigen::Matrix3d   U = Eigen::Matrix3d::Identity() + base::strain_tensor(e);
      const coupling::Stretch stretch(base::strain_voigt(0.5 * (U * U - Eigen::Matrix3d::Identity())));
      if (Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(U).eigenvalues()[0] <= 0)
        continue;
      CHECK((stretch.strain() - e).norm() < 1e-12);
      // T : dU = S : dE.
      const base::Voigt T = random_strain(draw), de = 1e-6 * random_strain(draw);
      const auto        green = [](const Eigen::Matrix3d &u) {
        return base::strain_voigt(0.5 * (u * u - Eigen::Matrix3d::Identity()));
      };
      const base::Voigt dE = 0.5 * (green(U + base::strain_tensor(de)) - green(U - base::strain_tensor(de)));
      CHECK(stretch.stress(T).dot(dE) == Approx(T.dot(de)).epsilon(1e-8));
    }
  CHECK_THROWS_WITH(coupling::Stretch(base::Voigt::Constant(-0.6)), Catch::Contains("inverted"));
}

TEST_CASE("cells: the plane in which ellipticity is lost is found", "[coupling][multiscale]")
{
  const base::Stiffness D = prepared()->stiffness();
  CHECK(coupling::weakest_plane(D, D, false).left == Approx(1));
  for (const bool in_plane : {false, true})
    for (const double angle : {0.0, 0.4, 1.3})
      {
        const Eigen::Vector3d n = in_plane ?
                                    Eigen::Vector3d(std::cos(angle), std::sin(angle), 0) :
                                    Eigen::Vector3d(std::cos(angle), 0.6 * std::sin(angle), 0.8 * std::sin(angle));
        // A jump along n across the plane meets no more stiffness.
        const base::Voigt opened = D * (coupling::jump_strain(n) * n);
        const double      work   = (coupling::jump_strain(n) * n).dot(opened);
        const auto        almost = coupling::weakest_plane(D - 0.999 / work * opened * opened.transpose(), D, in_plane);
        const auto        lost   = coupling::weakest_plane(D - 1.001 / work * opened * opened.transpose(), D, in_plane);
        CHECK_FALSE(almost.is_lost());
        CHECK(lost.is_lost());
        CHECK(std::fabs(lost.normal.dot(n)) > 1 - 1e-4);
      }
}

TEST_CASE("cells: the plane of a localised cell does not depend on how far past the loss the state is",
          "[coupling][multiscale]")
{
  const base::Stiffness D = prepared()->stiffness();
  std::mt19937          draw(11);
  double                astray = 1;
  for (int i = 0; i < 10; ++i)
    {
      base::Stiffness softening = base::Stiffness::Zero(); // across several planes
      for (int k = 0; k < 3; ++k)
        {
          const Eigen::Vector3d n      = random_strain(draw).head<3>().normalized();
          const base::Voigt     opened = D * (coupling::jump_strain(n) * n);
          softening += (1 + 0.1 * k) / (coupling::jump_strain(n) * n).dot(opened) * opened * opened.transpose();
        }
      double just = 0.01;
      while (!coupling::weakest_plane(D - just * softening, D, false).is_lost())
        just *= 1.001;
      const Eigen::Vector3d there = coupling::weakest_plane(D - just * softening, D, false).normal;
      for (const double far : {1.0, 1.3, 3.0})
        {
          const base::Stiffness past = D - far * just * softening;
          CHECK(std::fabs(coupling::first_lost_normal(D, past, D, false).dot(there)) > 1 - 1e-3);
          astray = std::min(astray, std::fabs(coupling::weakest_plane(past, D, false).normal.dot(there)));
        }
    }
  CHECK(astray < 0.9); // the smallest determinant is elsewhere
}

TEST_CASE("cells: an elastic path leaves no trace, then the cell localises and says so", "[coupling][multiscale][slow]")
{
  // S17
  auto of = points({prepared()}, coupling::Localised::stop);
  of->allocate(1);
  std::vector<base::Voigt> there(501);
  const auto               strain = [](const int step) {
    const double t = step / 500.0;
    return base::Voigt(1.5e-5 * mixed(1) * t + 5e-6 * std::sin(6 * t) * base::Voigt::Unit(3));
  };
  for (int step = 0; step <= 1000; ++step)
    {
      const int  at     = step <= 500 ? step : 1000 - step;
      const auto answer = requested(*of, strain(at));
      of->commit();
      if (step <= 500)
        there[at] = answer.stress;
      else
        CHECK((answer.stress - there[at]).norm() <= 1e-8 * there[500].norm());
    }
  CHECK(of->promoted() == 0);
  int steps = 0;
  while (of->end_of_validity().empty() && steps < 400)
    {
      requested(*of, ++steps * 2.5e-6 * base::Voigt::Unit(0));
      of->commit();
    }
  INFO(of->end_of_validity());
  REQUIRE(of->localisations().size() == 1);
  CHECK_THAT(of->end_of_validity(), Catch::Contains("has localised") && Catch::Contains("across the normal"));
  CHECK(std::fabs(of->localisations()[0].normal[0]) > 0.9); // pulled along x
  CHECK(of->record(0).localised == 1);
}

TEST_CASE("cells: the same bits for any number of threads, and after a state was written and read",
          "[coupling][multiscale]")
{
  const std::vector<std::shared_ptr<const coupling::PreparedCell>> cells = {prepared(),
                                                                            prepared(concrete(), parameters(), 4)};
  auto       one = points(cells), two = points(cells), again = points(cells);
  const auto strains = [](const double size) {
    std::vector<base::Voigt> all;
    for (int i = 0; i < 6; ++i)
      all.push_back(mixed(size * (i + 1) / 6));
    return all;
  };
  const auto step = [&](coupling::CellPoints &of, const double size, const int threads) {
    omp_set_num_threads(threads);
    of.gather(strains(size), true);
    omp_set_num_threads(1);
    of.commit();
  };
  for (auto *of : {one.get(), two.get(), again.get()})
    of->allocate(6);
  step(*one, 1.5e-4, 1);
  step(*two, 1.5e-4, 2);
  CHECK(one->promoted() > 2);
  CHECK(one->promoted() < 6);
  for (std::size_t i = 0; i < 6; ++i)
    again->visit(i, [&, next = std::size_t(0)](const fem::PointQuantity &of, double *value) mutable {
      std::size_t k = 0;
      one->visit(i, [&](const fem::PointQuantity &, const double *from) {
        if (k++ == next)
          std::copy_n(from, of.values(), value);
      });
      ++next;
    });
  base::Column          saved;
  base::FlatStateWriter writer(saved);
  one->visit_more(writer);
  base::FlatStateReader reader(saved);
  again->visit_more(reader);
  step(*one, 2e-4, 1);
  step(*two, 2e-4, 2);
  step(*again, 2e-4, 2);
  for (std::size_t i = 0; i < 6; ++i)
    for (auto *of : {two.get(), again.get()})
      {
        fem::PointAnswer a, b;
        one->evaluate(i, strains(2.1e-4)[i], {}, true, a);
        of->evaluate(i, strains(2.1e-4)[i], {}, true, b);
        CHECK(a.stress == b.stress);
        CHECK(a.tangent == b.tangent);
      }
}

TEST_CASE("cells: what they cannot be is refused", "[coupling][multiscale]")
{
  auto loose = homogenisation_fixture::random_spheres(48, 3);
  loose.periodic_cell.reset();
  CHECK_THROWS_WITH(coupling::PreparedCell(loose, concrete(), parameters()), Catch::Contains("no periodic cell"));
  auto p      = parameters();
  p.promotion = 0;
  CHECK_THROWS_WITH(prepared(concrete(), p), Catch::Contains("promotion at the exertion 0"));
  coupling::CellPointsParameters plane;
  plane.cells = {prepared()};
  CHECK_THROWS_WITH(coupling::CellPoints(plane, fem::Plane::stress), Catch::Contains("plane stress"));
}
