#include "dem/loading/uniaxial.h"

#include "base/errors.h"
#include "clusters.h"
#include "dem/specimen/specimen.h"
#include "two_materials.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <string>

using Catch::Matchers::Contains;
using Eigen::Vector3d;

namespace
{
  const double r = 1e-3, E = 25e9;

  dem::UniaxialParameters pull(const double rate)
  {
    dem::UniaxialParameters p;
    p.axis            = 2;
    p.strain_rate     = rate;
    p.grips.thickness = 0.5 * r; // one layer of the lattice
    p.stop_fraction   = 0.2;
    p.stop_strain     = 5e-3;
    return p;
  }
} // namespace

TEST_CASE("uniaxial test of a cubic lattice measures the stiffness of its columns", "[dem]")
{
  // n^2 columns of touching spheres, nothing couples them along the axis: F = n^2 E pi r^2 strain, that is D_11 = (pi/4) E on the
  // lattice's own section (2 r n)^2. The initial velocity field is that of the uniform strain, so it is exact from the first step.
  omp_set_num_threads(1);
  const int n = 4;
  for (const int axis : {0, 1, 2})
    for (const double rate : {1.0, -1.0})
      {
        auto p    = cluster::next_neighbours();
        p.damping = 0.3;
        dem::Specimen body(cluster::cubic_lattice(n, n, n, r), p, cluster::concrete());
        auto          loading = pull(rate);
        loading.axis          = axis;
        dem::UniaxialTest test(body, loading);
        CHECK(test.gauge_length() == Approx(2 * r * (n - 1)).epsilon(1e-14));
        while (std::abs(test.advance(5).strain) < 0.5e-4)
          {
            const auto &now = test.curve().back();
            if (now.strain != 0)
              CHECK(now.stress * test.section() == Approx(n * n * E * M_PI * r * r * now.strain).epsilon(1e-6));
          }
        CHECK(test.figures().young_modulus * test.section() == Approx(n * n * E * M_PI * r * r).epsilon(1e-6));
        CHECK(test.figures().young_modulus * test.section() / (4 * r * r * n * n) ==
              Approx(M_PI / 4 * E).epsilon(1e-6));
        CHECK_FALSE(test.finished());
      }
}

TEST_CASE("uniaxial test of a square lattice of discs measures the stiffness of its columns", "[dem]")
{
  omp_set_num_threads(1);
  auto p              = cluster::next_neighbours();
  p.physics.dimension = 2;
  p.thickness         = 5e-3;
  dem::Specimen body(cluster::cubic_lattice(4, 6, 1, r), p, cluster::concrete());
  auto          loading = pull(0.5);
  loading.axis          = 1;
  dem::UniaxialTest test(body, loading);
  while (test.advance(5).strain < 0.5e-4)
    ;
  CHECK(test.figures().young_modulus * test.section() == Approx(4 * E * 2 * r * p.thickness).epsilon(1e-6));
}

TEST_CASE("uniaxial test finds strength and strain at the peak of a lattice that softens as one link", "[dem]")
{
  // Three layers, both bays alike: uniform until the links' limit strain, F = n^2 E eps_0 pi r^2 at eps_0; then one bay opens.
  omp_set_num_threads(1);
  const int n = 3;
  auto      p = cluster::next_neighbours();
  p.damping   = 0.3;
  dem::Specimen     body(cluster::cubic_lattice(n, n, n, r), p, cluster::concrete());
  auto              loading = pull(1.0);
  dem::UniaxialTest test(body, loading);
  const auto        most = test.most_steps();
  while (!test.finished())
    {
      test.advance(1);
      REQUIRE(body.steps() <= most);
    }
  const auto found = test.figures();
  CHECK(found.strain_at_peak == Approx(1e-4).margin(body.time_step() * 1.5).epsilon(0)); // one sample
  CHECK(found.strength * test.section() == Approx(n * n * E * 1e-4 * M_PI * r * r).epsilon(5e-3));
  CHECK(found.strength <= E * 1e-4 * M_PI * r * r * n * n / test.section() * (1 + 1e-6));
  CHECK(std::abs(test.curve().back().stress) < 0.2 * found.strength);
}

TEST_CASE("uniaxial test does as much work as the specimen's account says", "[dem]")
{
  omp_set_num_threads(1);
  auto p    = cluster::bonded(1.5);
  p.damping = 0.3;
  dem::Specimen       body(cluster::cubic_lattice(4, 4, 6, r), p, cluster::concrete());
  dem::UniaxialTest   test(body, pull(2.0));
  double              work   = 0;
  dem::UniaxialSample before = test.advance(1);
  for (int i = 0; i < 1500; ++i)
    {
      const auto now = test.advance(1);
      work += 0.5 * (before.stress + now.stress) * (now.strain - before.strain);
      before = now;
    }
  work *= test.section() * test.gauge_length();
  const auto energy = body.energy();
  CHECK(work == Approx(energy.external_work).epsilon(1e-3));
  CHECK(energy.damage > 0.1 * work);
  CHECK(energy.balance_error() < 1e-3);
}

TEST_CASE("uniaxial test refuses what it cannot do and names the entry", "[dem]")
{
  dem::Specimen body(cluster::cubic_lattice(3, 3, 3, r), cluster::next_neighbours(), cluster::concrete());
  const auto    refused = [&](const auto &change) {
    auto p = pull(1);
    change(p);
    return [&body, p] { dem::UniaxialTest test(body, p); };
  };
  CHECK_THROWS_WITH(refused([](auto &p) { p.axis = 3; })(), Contains("Axis"));
  CHECK_THROWS_WITH(refused([](auto &p) { p.strain_rate = 0; })(), Contains("strain rate"));
  CHECK_THROWS_WITH(refused([](auto &p) { p.grips.thickness = 0; })(), Contains("Grip thickness"));
  CHECK_THROWS_WITH(refused([](auto &p) { p.grips.thickness = 2 * r; })(),
                    Contains("Grip thickness") && Contains("meet"));
  CHECK_THROWS_WITH(refused([](auto &p) { p.grips.area = -1; })(), Contains("Area"));
  CHECK_THROWS_WITH(refused([](auto &p) { p.grips.gauge = dem::Gauge::planes; })(), Contains("Gauge planes"));
  CHECK_THROWS_WITH(refused([](auto &p) {
                      p.grips.gauge      = dem::Gauge::planes;
                      p.grips.low_plane  = 1 * r;
                      p.grips.high_plane = 9 * r;
                    })(),
                    Contains("Gauge planes") && Contains("0.009 m"));
  CHECK_THROWS_WITH(refused([](auto &p) { p.stop_fraction = 1; })(), Contains("stop fraction"));
  CHECK_THROWS_WITH(refused([](auto &p) { p.stop_strain = 0; })(), Contains("stop strain"));
  CHECK_THROWS_AS(refused([](auto &p) { p.axis = -1; })(), base::InputError);
}

TEST_CASE("grips that turn back at half the speed lead stress and strain back along the elastic line", "[dem]")
{
  const int n = 4;
  auto      p = cluster::next_neighbours();
  p.damping   = 0.7; // the sudden change of the grips' speed sends a wave, which must die out
  dem::Specimen     body(cluster::cubic_lattice(n, n, n, r), p, cluster::concrete());
  dem::UniaxialTest test(body, pull(-1.0));
  while (test.advance(5).strain > -0.4e-4)
    ;
  const double turned_at = test.curve().back().strain, at = test.curve().back().time + body.time_step();
  test.set_strain_rate(0.5);
  while (test.advance(5).strain < -0.1e-4)
    ;
  const auto &now = test.curve().back();
  CHECK(now.strain == Approx(turned_at - body.time_step() + 0.5 * (now.time - at)).epsilon(1e-9));
  CHECK(now.stress * test.section() == Approx(n * n * E * M_PI * r * r * now.strain).epsilon(2e-2));
}

TEST_CASE("a grip holds the centres within its thickness of the outermost centre, a complete layer", "[dem]")
{
  // Ends as a crop leaves them: no centre lies on the face. Of the surface, 2.2 mm would hold the first two only.
  const std::vector<Vector3d> centre = {{0, 0, 1.3e-3}, {0, 0, 2.4e-3}, {0, 0, 3.4e-3}, {0, 0, 3.6e-3}, {0, 0, 9e-3}};
  const std::vector<double>   radius(5, r);
  dem::GripParameters         p;
  p.thickness                  = 2.2e-3;
  const dem::GripLayers layers = dem::find_grip_layers({centre, radius}, 2, p);
  CHECK(layers.low == std::vector<std::size_t>{0, 1, 2});
  CHECK(layers.high == std::vector<std::size_t>{4});
  CHECK(layers.low_face == Approx(3.4e-3));
  CHECK(layers.gauge_length == Approx(5.6e-3));
  p.gauge = dem::Gauge::outermost_centres;
  CHECK(dem::find_grip_layers({centre, radius}, 2, p).gauge_length == Approx(7.7e-3));
  p.area = 3e-6;
  CHECK(dem::find_grip_layers({centre, radius}, 2, p).section == 3e-6);
}

TEST_CASE("figures and the end of a uniaxial test come from every step, however seldom it is sampled", "[dem]")
{
  omp_set_num_threads(1);
  struct Seen
  {
    dem::UniaxialFigures figures;
    std::int64_t         steps;
    double               damage;
    std::size_t          rows;
  };
  const auto pulled = [](const std::int64_t steps_per_row) {
    auto p    = cluster::bonded(1.5);
    p.damping = 0.3;
    dem::Specimen     body(cluster::cubic_lattice(3, 3, 5, r), p, cluster::concrete());
    dem::UniaxialTest test(body, pull(4));
    while (!test.finished())
      test.advance(steps_per_row);
    return Seen{test.figures(), body.steps(), body.energy().damage, test.curve().size()};
  };
  const Seen often = pulled(1), seldom = pulled(1000000);
  CHECK(seldom.rows == 1);
  CHECK(often.steps == seldom.steps);
  CHECK(often.damage == seldom.damage);
  CHECK(often.figures.peak_passed);
  CHECK(often.figures.young_modulus == seldom.figures.young_modulus);
  CHECK(often.figures.strength == seldom.figures.strength);
  CHECK(often.figures.strain_at_peak == seldom.figures.strain_at_peak);
}

TEST_CASE("a test that ends before its peak has no strength, and says so", "[dem]")
{
  omp_set_num_threads(1);
  dem::Specimen body(cluster::cubic_lattice(3, 3, 4, r), cluster::next_neighbours(), cluster::concrete());
  auto          loading = pull(1);
  loading.stop_strain   = 5e-5;
  dem::UniaxialTest test(body, loading);
  test.advance(test.most_steps());
  CHECK(test.finished());
  CHECK_FALSE(test.figures().peak_passed);
  CHECK(test.figures().modulus_found());
  CHECK(body.steps() <= test.most_steps());
}

TEST_CASE("a test that ends in a local drop of the stress has no strength", "[dem]")
{
  // A stiff lattice in a weaker neighbour's place: the stress of one that softens falls slowly; ended at nine tenths of its peak.
  omp_set_num_threads(1);
  const auto pulled_to = [](const double stop_strain) {
    auto p    = cluster::bonded(1.5);
    p.damping = 0.3;
    dem::Specimen body(cluster::cubic_lattice(3, 3, 5, r), p, cluster::concrete());
    auto          loading = pull(4);
    loading.stop_strain   = stop_strain;
    dem::UniaxialTest test(body, loading);
    while (!test.finished())
      test.advance(1000);
    return test.figures();
  };
  const dem::UniaxialFigures whole = pulled_to(5e-3), part = pulled_to(1.2 * whole.strain_at_peak);
  REQUIRE(whole.peak_passed);
  CHECK(part.strength == whole.strength);
  CHECK_FALSE(part.peak_passed); // as little past it as a local drop
}

TEST_CASE("strain between two planes is that of the material between them", "[dem]")
{
  // A row of eight bays, of which the first is twice as stiff (links of two materials): strain between planes in the soft part.
  omp_set_num_threads(1);
  const int    n         = 3;
  dem::Packing packing   = cluster::cubic_lattice(n, n, 9, r);
  auto         materials = cluster::mortar_and_aggregate();
  packing.material.clear();
  for (const Vector3d &x : packing.centre)
    packing.material.push_back(x.z() < 3 * r ? 1 : 0);
  auto p    = cluster::next_neighbours();
  p.damping = 0.7;
  dem::Specimen body(packing, p, materials);
  auto          loading    = pull(0.05);
  loading.grips.gauge      = dem::Gauge::planes;
  loading.grips.low_plane  = 7 * r;
  loading.grips.high_plane = 13 * r;
  dem::UniaxialTest test(body, loading);
  CHECK(test.gauge_length() == Approx(6 * r).epsilon(1e-12));
  while (test.advance(20).strain < 0.5e-4)
    REQUIRE_FALSE(test.finished());
  const double soft = materials.list[0].parameters.normal_modulus;
  CHECK(test.figures().young_modulus * test.section() == Approx(n * n * soft * M_PI * r * r).epsilon(5e-3));
}
