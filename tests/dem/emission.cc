// Acoustic emission (doc/theory/acoustic-emission.md): moment tensors against closed forms, events as a partition of what broke, the law of
// their frequency.
#include "dem/emission/frequency_law.h"
#include "dem/emission/moment_tensor.h"
#include "dem/laws/contact_bond.h"
#include "dem/specimen/core.h"
#include "tests/dem/closed_system.h"
#include "tests/dem/clusters.h"
#include "tests/dem/periodic_cell_fixture.h"
#include "tests/dem/same_bits.h"

#include <Eigen/Geometry>

#include <omp.h>
#include <catch2/catch.hpp>

#include <cmath>

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
  constexpr double R = 1e-3, strength = 1e6;

  dem::ContactBondParameters glue(const double times_strong)
  {
    dem::ContactBondParameters p;
    p.effective_modulus = 10e9;
    p.tensile_strength  = times_strong * strength;
    p.cohesion          = 10 * strength;
    return p;
  }

  dem::SpecimenParameters heard(const int dimension, const double reach, const double step_factor = 0.8)
  {
    dem::SpecimenParameters p = cluster::next_neighbours();
    p.physics.dimension       = dimension;
    p.thickness               = dimension == 2 ? 1 : 0;
    p.density                 = 2500;
    p.emission_reach          = reach;
    p.step_factor             = step_factor;
    return p;
  }

  /** A row of spheres with the first and the last held, where spheres of the second material are glued weakly to each other. */
  struct Row
  {
    Row(const int                        dimension,
        const std::vector<std::int32_t> &materials,
        const double                     angle,
        const double                     reach,
        const double                     step_factor = 0.8)
      : along(std::cos(angle), std::sin(angle), 0)
      , specimen(packing(materials, along),
                 heard(dimension, reach, step_factor),
                 dem::Materials<dem::ContactBondParameters>({{"strong", glue(8), 0}, {"weak", glue(1), 0}}))
      , last(materials.size() - 1)
    {
      for (const std::size_t i : {std::size_t(0), last})
        {
          dem::Grip grip;
          grip.particles  = {i};
          grip.prescribed = {true, true, true, true, true, true};
          specimen.grips().add(grip);
        }
    }

    static dem::Packing packing(const std::vector<std::int32_t> &materials, const Vector3d &along)
    {
      dem::Packing made;
      for (std::size_t i = 0; i < materials.size(); ++i)
        made.centre.push_back(2 * R * static_cast<double>(i) * along);
      made.radius.assign(materials.size(), R);
      made.material = materials;
      return made;
    }

    /** Pull until something breaks, slowly. @return the force that the row bore last [N] */
    double pull_apart(const double speed)
    {
      specimen.grips().set_velocity(1, speed * along, Vector3d::Zero());
      double force = 0;
      while (specimen.logged_breaks() == 0)
        {
          force = specimen.grips().reaction(1).dot(along);
          specimen.advance(1);
        }
      specimen.grips().set_velocity(1, Vector3d::Zero(), Vector3d::Zero());
      return force;
    }

    Vector3d      along;
    dem::Specimen specimen;
    std::size_t   last;
  };

  Matrix3d uniaxial(const Vector3d &n) { return n * n.transpose(); }
} // namespace

TEST_CASE("moment tensors have the scalar, magnitude and isotropic share of their closed cases", "[dem][emission]")
{
  const Matrix3d turn   = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto     turned = [&](const Vector3d &eigenvalues) {
    return Matrix3d(turn * eigenvalues.asDiagonal() * turn.transpose());
  };
  // A double couple of moment M_0 has the eigenvalues M_0, 0, -M_0.
  CHECK(dem::scalar_moment(turned({5, 0, -5})) == Approx(5).epsilon(1e-14));
  CHECK(dem::isotropic_share(turned({5, 0, -5})) == Approx(0).margin(1e-14));
  CHECK(dem::isotropic_share(turned({2, 2, 2})) == Approx(1).epsilon(1e-14));
  CHECK(dem::isotropic_share(turned({-2, -2, -2})) == Approx(-1).epsilon(1e-14));
  // A crack that opens in a body of equal Lame constants: 3, 1, 1 (Aki and Richards); a pull along one axis: 1, 0, 0.
  CHECK(dem::isotropic_share(turned({3, 1, 1})) == Approx(5 / (5 + 8.0 / 3)).epsilon(1e-14));
  CHECK(dem::isotropic_share(turned({1, 0, 0})) == Approx(3.0 / 7).epsilon(1e-14));
  CHECK(dem::isotropic_share(Matrix3d::Zero()) == 0);
  CHECK(dem::moment_magnitude(std::pow(10, 9.1)) == Approx(0).margin(1e-14));
  CHECK(dem::moment_magnitude(std::pow(10, 18.1)) == Approx(6).epsilon(1e-14)); // 1.26e18 N m
}

TEST_CASE("frequency law has the b-value that magnitudes were drawn with, and its error", "[dem][emission]")
{
  const double        b = 1.3, completeness = -7.5;
  dem::UniformRandom  random(5);
  std::vector<double> magnitudes;
  for (int i = 0; i < 20000; ++i)
    magnitudes.push_back(completeness - std::log10(1 - random()) / b);
  const auto complete = dem::frequency_law(magnitudes);
  REQUIRE(complete);
  CHECK(complete->completeness == Approx(completeness));
  CHECK(complete->events == magnitudes.size());
  CHECK(complete->error == Approx(b / std::sqrt(20000.0)).epsilon(0.02)); // Aki's error, of a true exponential
  CHECK(std::abs(complete->b - b) < 3 * complete->error);

  // What is too weak to be heard in full is left out.
  for (int i = 0; i < 1000; ++i)
    magnitudes.push_back(completeness - 0.5 * random());
  const auto incomplete = dem::frequency_law(magnitudes);
  REQUIRE(incomplete);
  CHECK(incomplete->completeness == Approx(completeness));
  CHECK(incomplete->b == complete->b);

  CHECK_FALSE(dem::frequency_law({}));
  CHECK_FALSE(dem::frequency_law(std::vector<double>(100, -6.55)));
  CHECK_FALSE(dem::frequency_law({-6.55, -6.51, -6.3}));
}

TEST_CASE("bond that snaps in a row of spheres has the moment tensor of its closed form, in any direction",
          "[dem][emission]")
{
  omp_set_num_threads(1);
  // Both spheres beside the bond are left on a spring each, stretched by F: its force swings from F to -F, so that the tensor reaches
  // 2 F times the distance 4 R of the contacts around them.
  for (const int dimension : {2, 3})
    for (const double angle : {0.0, 0.7, 2.1})
      {
        Row row(dimension, {0, 1, 1, 0}, angle, 1, 0.1); // short steps: one of them is near the top of the swing
        const double force = row.pull_apart(3e-3);
        row.specimen.advance(2000);
        REQUIRE(row.specimen.emission().size() == 1);
        const dem::EmissionEvent &event = row.specimen.emission()[0];
        CHECK(event.breaks() == 1);
        CHECK(event.in_tension == 1);
        CHECK(event.area == row.specimen.breaks()[0].area);
        CHECK((event.place - 3 * R * row.along).norm() < 1e-3 * R);
        CHECK((event.moment - 8 * R * force * uniaxial(row.along)).norm() < 0.01 * 8 * R * force);
        CHECK(dem::isotropic_share(event.moment) == Approx(3.0 / 7).epsilon(1e-3));
      }
}

TEST_CASE("window of emission has the shear wave of the cell's affine stiffness, averaged over all directions",
          "[dem][emission]")
{
  const auto check = [](const dem::Packing &packing, const int dimension, const double volume) {
    dem::SpecimenParameters  parameters = periodic_fixture::elastic(1.5, dimension);
    const dem::CpmParameters law        = periodic_fixture::unit_links(0.3);
    dem::SpecimenCore        core(packing, parameters, law);
    const base::Matrix6      C = dem::Specimen(packing, parameters, law).affine_stiffness();
    // Voigt's average of the shear modulus; in the plane that of its own shears.
    const double G =
      dimension == 3 ?
        (C(0, 0) + C(1, 1) + C(2, 2) - C(0, 1) - C(0, 2) - C(1, 2) + 3 * (C(3, 3) + C(4, 4) + C(5, 5))) / 15 :
        (C(0, 0) + C(1, 1) - 2 * C(0, 1) + 4 * C(5, 5)) / 8;
    double mass = 0;
    for (const double each : core.particles.mass)
      mass += each;
    const dem::EmissionWindow window = dem::emission_window(2, dimension, core.particles, core.bonds, *core.bond_law);
    CHECK(window.reach == Approx(4 * packing.radius[0]));
    CHECK(window.lasts == Approx(4 * window.reach / std::sqrt(G * volume / mass)).epsilon(1e-10));
  };
  const dem::Packing spheres = periodic_fixture::disordered(4, 3);
  check(spheres, 3, spheres.periodic_cell->prod());
  const dem::Packing discs = periodic_fixture::six_discs();
  check(discs, 2, discs.periodic_cell->x() * discs.periodic_cell->y());
}

TEST_CASE("breaks are one event where they are near in place and time, otherwise each its own", "[dem][emission]")
{
  const std::vector<std::int32_t> two_places = {0, 1, 1, 0, 0, 0, 1, 1, 0};
  const auto                      events     = [&](const double reach) {
    Row row(3, two_places, 0.3, reach);
    row.pull_apart(1e-3);
    row.specimen.grips().set_velocity(1, 0.2 * row.along, Vector3d::Zero());
    while (row.specimen.logged_breaks() < 2) // when the first has swung back
      row.specimen.advance(1);
    return row.specimen.emission();
  };
  const auto apart = events(1), together = events(100);
  REQUIRE(apart.size() == 2);
  CHECK(apart[0].breaks() + apart[1].breaks() == 2);
  CHECK(apart[0].time <= apart[1].time);
  REQUIRE(together.size() == 1);
  CHECK(together[0].breaks() == 2);
  CHECK(together[0].area == Approx(apart[0].area + apart[1].area));
  CHECK(together[0].lasts == Approx(apart[1].time - apart[0].time).margin(1e-15));
  CHECK((together[0].place - 0.5 * (apart[0].place + apart[1].place)).norm() < 1e-9);
}

TEST_CASE("every break of a body is in one event, and listening changes no bit of its motion", "[dem][emission]")
{
  omp_set_num_threads(1);
  const auto made = [](const double reach) {
    dem::Specimen specimen(cluster::colliding_clusters(60), heard(3, reach), glue(1));
    cluster::set_colliding_velocities(specimen, 10);
    specimen.advance(1500);
    return specimen;
  };
  const dem::Specimen deaf = made(0), listening = made(2);
  REQUIRE(deaf.logged_breaks() > 10);
  CHECK(deaf.emission().empty());
  CHECK(listening.energy().balance_error() == deaf.energy().balance_error());
  CHECK(listening.particles().position == deaf.particles().position);
  std::int64_t breaks = 0;
  double       area = 0, before = 0;
  for (const dem::EmissionEvent &event : listening.emission())
    {
      breaks += event.breaks();
      area += event.area;
      CHECK(event.time >= before);
      before = event.time;
      CHECK(event.moment == event.moment.transpose());
    }
  double broken = 0;
  for (const dem::Break &b : listening.breaks())
    broken += b.area;
  CHECK(breaks == static_cast<std::int64_t>(listening.logged_breaks()));
  CHECK(area == Approx(broken).epsilon(1e-12));
  CHECK(listening.emission().size() < listening.logged_breaks());
}

TEST_CASE("events of emission have the same bits for any threads and after a restart amidst them", "[dem][emission]")
{
  check_same_bits(
    [] {
      dem::Specimen specimen(cluster::colliding_clusters(30), heard(3, 2), glue(1));
      cluster::set_colliding_velocities(specimen, 50);
      return specimen;
    },
    60, 60, 5);
}

TEST_CASE("emission is refused where nothing can break, and in periodic cells", "[dem][emission]")
{
  dem::LinearContactParameters loose;
  loose.effective_modulus = 1e9;
  CHECK_THROWS_WITH(dem::Specimen(cluster::pair_of_spheres(R, R, 2 * R), heard(3, 1), loose),
                    Catch::Contains("Emission/Reach") && Catch::Contains("no bonds"));
  dem::SpecimenParameters cell = heard(3, 1);
  cell.physics.periodic        = true;
  CHECK_THROWS_WITH(cell.check(), Catch::Contains("Emission/Reach") && Catch::Contains("periodic"));
  CHECK_THROWS_WITH(heard(3, -1).check(), Catch::Contains("Emission/Reach"));
}
