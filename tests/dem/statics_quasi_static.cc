// Quasi-static tension of periodic CPM cells, past the peak.
#include "dem/homogenisation/isotropy.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/packing/lattice.h"
#include "dem/specimen.h"
#include "dem/statics/quasi_static_cell.h"
#include "tests/dem/homogenisation_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace homogenisation_fixture;

namespace
{
  dem::CpmParameters concrete(const double ductility = 30)
  {
    dem::CpmParameters p;
    p.normal_modulus       = 25e9;
    p.shear_ratio          = 0.2;
    p.limit_elastic_strain = 1e-4;
    p.relative_ductility   = ductility;
    p.cohesion             = 3e6;
    p.friction_coefficient = 0.8;
    return p;
  }

  dem::QuasiStaticParameters steps(const double end_strain)
  {
    dem::QuasiStaticParameters p;
    p.strain_step = 1e-5;
    p.end_strain  = end_strain;
    return p;
  }

  /** Envelope of a link in tension, written out anew: (2.17) of Stransky (2018). */
  double envelope(const dem::CpmParameters &p, const double strain)
  {
    const double onset = p.limit_elastic_strain;
    return strain <= onset ? p.normal_modulus * strain :
                             p.normal_modulus * onset * std::exp(-(strain - onset) / (p.relative_ductility * onset));
  }

  double peak(const std::vector<dem::QuasiStaticPoint> &path)
  {
    double largest = 0;
    for (const auto &point : path)
      largest = std::max(largest, point.stress[0]);
    return largest;
  }

  dem::Packing millimetres(dem::Packing packing)
  {
    for (auto &c : packing.centre)
      c *= 1e-3;
    for (auto &r : packing.radius)
      r *= 1e-3;
    *packing.periodic_cell *= 1e-3;
    return packing;
  }
} // namespace

TEST_CASE("quasi-static cell: a cubic lattice follows the envelope of its links", "[dem][statics]")
{
  const auto law     = concrete();
  const auto network = dem::make_network(dem::make_lattice(dem::Lattice::simple_cubic, 1e-3, {1, 1, 1}),
                                         links(1.05, law.shear_ratio, law.normal_modulus));
  auto       p       = steps(30e-4);
  p.lateral_free     = false;
  const auto path    = dem::load_quasi_statically(network, law, p);
  REQUIRE(path.size() > 20);
  for (const auto &point : path)
    {
      const double exact = M_PI / 4 * envelope(law, point.strain[0]);     // homogenisation specification 2.3
      CHECK(point.stress[0] == Approx(exact).epsilon(1e-9).margin(1e-3)); // rounding; margin: the first point is zero
      CHECK(std::fabs(point.stress[1]) <= 1e-9 * exact + 1e-3);
    }
  CHECK(path.back().strain[0] >= 20e-4);
}

TEST_CASE("quasi-static cell: a chain with a weak link snaps back along the closed form", "[dem][statics]")
{
  // Eight spheres in a row, one link of 0.8 times the section, softening strain 3 eps_0: after the peak the seven others
  // contract by more than the weak one opens, 5.6/3 > 1, and the strain of the whole falls.
  const auto law     = concrete(3);
  auto       network = dem::make_network(dem::make_lattice(dem::Lattice::simple_cubic, 1e-3, {8, 1, 1}),
                                         links(1.05, law.shear_ratio, law.normal_modulus));
  const auto weak    = std::find_if(network.links.begin(), network.links.end(),
                                    [](const auto &l) { return l.direction.x() > 0.9 && l.first == 3; });
  REQUIRE(weak != network.links.end());
  weak->area *= 0.8;
  weak->stiffness *= 0.8;

  auto p            = steps(10e-4);
  p.lateral_free    = false;
  p.tolerance       = 1e-9;
  p.end_stress      = 0.1;
  const auto   path = dem::load_quasi_statically(network, law, p);
  const double area = M_PI * 1e-6, section = 4e-6;
  double       strain_at_onset = 0, least_strain = 1;
  for (const auto &point : path)
    {
      // Given the stress, the strain: weak link on the envelope past the peak, the others elastic.
      const double force = point.stress[0] * section, in_weak = force / (0.8 * area);
      const bool   softening = point.mean_damage > 0;
      const double onset     = law.limit_elastic_strain;
      const double kappa     = softening ?
                                 onset - law.relative_ductility * onset * std::log(in_weak / (law.normal_modulus * onset)) :
                                 in_weak / law.normal_modulus;
      const double exact     = (kappa + 7 * force / (area * law.normal_modulus)) / 8;
      CHECK(point.strain[0] == Approx(exact).epsilon(1e-6).margin(1e-12)); // tolerance 1e-9 of the forces
      if (softening)
        least_strain = std::min(least_strain, point.strain[0]);
      else
        strain_at_onset = point.strain[0];
    }
  // Peak at (0.8 * 7 + 1)/8 eps_0. From there the strain falls until (5.6/3) exp(-(kappa - eps_0)/eps_f) = 1, where
  // kappa = 2.872 eps_0 and the strain is (2.872 + 3)/8 eps_0; steps of 0.2 eps_0 come near both.
  CHECK(strain_at_onset == Approx(0.825e-4).epsilon(0.05));
  CHECK(least_strain == Approx(0.734e-4).epsilon(0.005));
  CHECK(path.back().stress[0] < 0.15 * peak(path));
}

TEST_CASE("quasi-static cell: the first slope is the relaxed modulus, the free stresses vanish", "[dem][statics]")
{
  const auto law = concrete();
  const auto network =
    dem::make_network(millimetres(random_spheres(64, 3)), links(1.6, law.shear_ratio, law.normal_modulus));
  const Matrix6 D = dem::relaxed_stiffness(network).stiffness;
  const Matrix6 C = D.fullPivLu().inverse();
  auto          p = steps(2e-5);
  p.tolerance     = 1e-9;
  const auto path = dem::load_quasi_statically(network, law, p);
  CHECK(path[1].stress[0] / path[1].strain[0] == Approx(1 / C(0, 0)).epsilon(1e-7));
  CHECK(path[1].strain[1] / path[1].strain[0] == Approx(C(1, 0) / C(0, 0)).epsilon(1e-6));
  CHECK(path[1].stress.tail<5>().norm() < 1e-6 * path[1].stress[0]);
}

TEST_CASE("quasi-static cell: work is stored or dissipated, and the peak does not hang on the steps",
          "[dem][statics][slow]")
{
  const auto law = concrete();
  const auto network =
    dem::make_network(millimetres(random_spheres(64, 3)), links(1.6, law.shear_ratio, law.normal_modulus));
  const auto balance_error = [&](const std::vector<dem::QuasiStaticPoint> &path) {
    double work = 0;
    for (std::size_t i = 1; i < path.size(); ++i)
      work += 0.5 * network.volume * (path[i].stress + path[i - 1].stress).dot(path[i].strain - path[i - 1].strain);
    return std::fabs(path.back().stored + path.back().dissipated - work) / work;
  };
  auto p            = steps(5e-4);
  p.opening_step    = 0.4;
  const auto coarse = dem::load_quasi_statically(network, law, p);
  p.opening_step    = 0.1;
  const auto fine   = dem::load_quasi_statically(network, law, p);
  CAPTURE(coarse.size(), fine.size(), peak(coarse), peak(fine), balance_error(coarse), balance_error(fine));
  CHECK(fine.back().dissipated > 0);
  CHECK(balance_error(fine) <
        0.02); // trapezoidal work over a path with kinks, and sliding by implicit steps: first order
  CHECK(balance_error(fine) < balance_error(coarse));
  CHECK(peak(fine) == Approx(peak(coarse)).epsilon(0.01));
}

TEST_CASE("quasi-static cell: dynamic strengths fall towards the static one as the rate falls", "[dem][statics][slow]")
{
  const auto law     = concrete();
  const auto packing = millimetres(random_spheres(64, 3));
  auto       p       = steps(6e-4);
  p.lateral_free     = false;
  const double still = peak(
    dem::load_quasi_statically(dem::make_network(packing, links(1.6, law.shear_ratio, law.normal_modulus)), law, p));

  const auto dynamic = [&](const double rate) {
    dem::SpecimenParameters s;
    s.physics.periodic  = true;
    s.physics.contacts  = false;
    s.density           = 4800;
    s.interaction_ratio = 1.6;
    s.damping           = 0.3;
    dem::Specimen body(packing, s, law);
    body.set_velocity_gradient(rate * Eigen::Vector3d(1, 0, 0) * Eigen::RowVector3d(1, 0, 0));
    double largest = 0;
    while (body.time() * rate < 6e-4)
      {
        body.advance(1);
        largest = std::max(largest, body.cell().stress(0, 0));
      }
    return largest;
  };
  const double fast = dynamic(30), slow = dynamic(3), slowest = dynamic(0.3);
  CAPTURE(still, fast, slow, slowest);
  CHECK(std::fabs(slow - still) < std::fabs(fast - still));
  CHECK(slowest == Approx(still).epsilon(0.01)); // finite against small strain: parts in 1e-4; the rate: what is left
}
