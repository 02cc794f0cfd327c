// Acoustic emission (doc/theory/acoustic-emission.md): moment tensors against closed forms, events as a partition of what broke, the law of
// their frequency.
#include "dem/emission/frequency_law.h"
#include "dem/emission/moment_tensor.h"
#include "dem/joints/joint_cuts.h"
#include "dem/laws/contact_bond.h"
#include "dem/laws/flat_joint.h"
#include "dem/laws/linear_contact.h"
#include "dem/laws/parallel_bond.h"
#include "dem/laws/smooth_joint.h"
#include "dem/specimen/core.h"
#include "tests/dem/closed_system.h"
#include "tests/dem/clusters.h"
#include "tests/dem/periodic_cell_fixture.h"
#include "tests/dem/same_bits.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
  constexpr double R = 1e-3, strength = 1e6, modulus = 10e9;

  dem::ContactBondParameters glue(const double times_strong)
  {
    dem::ContactBondParameters p;
    p.effective_modulus = modulus;
    p.tensile_strength  = times_strong * strength;
    p.cohesion          = 10 * strength;
    return p;
  }

  dem::ParallelBondParameters cement(const double times_strong)
  {
    dem::ParallelBondParameters p;
    p.effective_modulus      = 0.7 * modulus;
    p.bond_effective_modulus = modulus;
    p.tensile_strength       = times_strong * strength;
    p.cohesion               = 10 * strength;
    return p;
  }

  dem::FlatJointParameters face(const double times_strong)
  {
    dem::FlatJointParameters p;
    p.effective_modulus = modulus;
    p.tensile_strength  = times_strong * strength;
    p.cohesion          = 10 * strength;
    return p;
  }

  /** Softens to half of its strength, and breaks. */
  dem::CpmParameters mortar(const double times_strong)
  {
    dem::CpmParameters p      = cluster::concrete();
    p.normal_modulus          = modulus;
    p.limit_elastic_strain    = times_strong * strength / modulus;
    p.relative_ductility      = 4;
    p.residual_strength_limit = 0.5;
    return p;
  }

  dem::CpmParameters mortar_with_options(const double times_strong)
  {
    dem::CpmParameters p               = mortar(times_strong);
    p.options.compression_yield_strain = -1; // far below what is met
    p.options.strength_surface         = dem::StrengthSurface::logarithmic;
    p.options.damage_time              = 1e-6;
    p.options.damage_exponent          = 0.5;
    return p;
  }

  dem::SmoothJointParameters plane_of_weakness(const Vector3d &normal)
  {
    dem::SmoothJointParameters p;
    p.normal_stiffness = modulus / (2 * R);
    p.shear_stiffness  = 0.4 * p.normal_stiffness;
    p.tensile_strength = strength;
    p.cohesion         = 10 * strength;
    p.plane            = normal;
    return p;
  }

  /** Links that break, of each law. */
  struct Bonds
  {
    std::string                                         name;
    std::function<dem::LinkMaterials(const Vector3d &)> of_row; ///< strong and weak ones along a direction
    double pressed;                                             ///< stiffness under compression over that under tension
    bool   brittle = true, jointed = false; ///< jointed: weak links are those of a joint across the row

    template <typename Parameters>
    static Bonds of(const std::string &name, Parameters (*made)(double), const double pressed, const bool brittle)
    {
      return {name,
              [made](const Vector3d &) {
                return dem::LinkMaterials(dem::Materials<Parameters>({{"strong", made(8), 0}, {"weak", made(1), 0}}));
              },
              pressed, brittle};
    }
  };

  std::vector<Bonds> all_bonds()
  {
    return {Bonds::of("contact bond", glue, 1, true),
            Bonds::of("parallel bond", cement, 1.7, true), // the contact beside the bond
            Bonds::of("flat joint", face, 1, true),
            Bonds::of("CPM", mortar, 1, false),
            Bonds::of("CPM with options", mortar_with_options, 1, false),
            {"smooth joint",
             [](const Vector3d &along) {
               return dem::LinkMaterials(glue(8)).with_joints(std::vector{plane_of_weakness(along)});
             },
             1, true, true}};
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

  /** A row of spheres with the first and the last held, where spheres of the second material are bonded weakly to each other. */
  struct Row
  {
    Row(const Bonds                     &bonds,
        const int                        dimension,
        const std::vector<std::int32_t> &materials,
        const double                     angle,
        const double                     reach,
        const double                     step_factor = 0.8)
      : along(std::cos(angle), std::sin(angle), 0)
      , specimen(packing(bonds, dimension, materials, along), heard(dimension, reach, step_factor), bonds.of_row(along))
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

    static dem::Packing
    packing(const Bonds &bonds, const int dimension, const std::vector<std::int32_t> &materials, const Vector3d &along)
    {
      dem::Packing made;
      for (std::size_t i = 0; i < materials.size(); ++i)
        made.centre.push_back(2 * R * static_cast<double>(i) * along);
      made.radius.assign(materials.size(), R);
      if (!bonds.jointed)
        made.material = materials;
      else
        for (std::int32_t i = 1; i < static_cast<std::int32_t>(materials.size()); ++i)
          if (materials[static_cast<std::size_t>(i)] == 1 && materials[static_cast<std::size_t>(i) - 1] == 1)
            made.cuts.push_back({i - 1, i, 0, dimension == 3 ? M_PI * R * R : 2 * R});
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
          "[dem][emission][slow]")
{
  omp_set_num_threads(1);
  // Both spheres beside the bond are left on a spring each, stretched by F: its force swings from F to -F, or by the energy as much more
  // as it is stiffer under compression, so that the tensor reaches 2 F times the distance 4 R of the contacts around them.
  for (const Bonds &bonds : all_bonds())
    for (const auto &[dimension, angle] : {std::pair{2, 0.0}, {2, 2.1}, {3, 0.7}, {3, 2.1}})
      {
        INFO(bonds.name << " in " << dimension << " dimensions at " << angle);
        Row row(bonds, dimension, {0, 1, 1, 0}, angle, 1, 0.1); // short steps: one of them is near the top of the swing
        const double force = row.pull_apart(bonds.brittle ? 3e-3 : 1.5e-3);
        row.specimen.advance(2000);
        REQUIRE(row.specimen.emission().size() == 1);
        const dem::EmissionEvent &event = row.specimen.emission()[0];
        const auto breaks = static_cast<std::int64_t>(row.specimen.logged_breaks()); // of a flat joint its elements
        CHECK(event.breaks() == breaks);
        CHECK((bonds.brittle ? event.in_tension : event.gradual) == breaks);
        CHECK(event.area == Approx(dimension == 3 ? M_PI * R * R : 2 * R).epsilon(1e-12));
        CHECK((event.place - 3 * R * row.along).norm() < 1e-3 * R);
        const double largest = 4 * R * force * (1 + std::sqrt(bonds.pressed));
        CHECK((event.moment - largest * uniaxial(row.along)).norm() < 0.01 * largest);
        CHECK(dem::isotropic_share(event.moment) == Approx(3.0 / 7).epsilon(1e-3));
      }
}

TEST_CASE("window of emission has the shear wave of the cell's affine stiffness, averaged over all directions",
          "[dem][emission]")
{
  const auto check = [](const dem::Packing &packing, const int dimension, const double volume) {
    dem::SpecimenParameters  parameters = periodic_fixture::elastic(1.5, dimension);
    const dem::CpmParameters law        = periodic_fixture::unit_links(0.3);
    dem::SpecimenCore        core(packing, parameters, law, nullptr);
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
  omp_set_num_threads(1);
  const std::vector<std::int32_t> two_places = {0, 1, 1, 0, 0, 0, 1, 1, 0};
  const auto                      events     = [&](const Bonds &bonds, const double reach) {
    Row row(bonds, 3, two_places, 0.3, reach);
    row.pull_apart(1e-3);
    const std::size_t of_one     = row.specimen.logged_breaks(); // of a flat joint its elements
    const bool        last_broke = row.specimen.breaks()[0].place.dot(row.along) > 8 * R;
    const double      speed      = (last_broke ? -1 : 1) * (bonds.brittle ? 0.2 : 2);
    row.specimen.grips().set_velocity(last_broke ? 0 : 1, speed * row.along, Vector3d::Zero());
    while (row.specimen.logged_breaks() < 2 * of_one) // when the first has swung back
      row.specimen.advance(1);
    return std::pair{row.specimen.emission(), static_cast<std::int64_t>(2 * of_one)};
  };
  for (const Bonds &bonds : all_bonds())
    {
      INFO(bonds.name);
      const auto [apart, breaks]  = events(bonds, 1);
      const auto [together, same] = events(bonds, 100);
      REQUIRE(same == breaks);
      REQUIRE(apart.size() == 2);
      CHECK(apart[0].breaks() + apart[1].breaks() == breaks);
      CHECK(apart[0].time <= apart[1].time);
      REQUIRE(together.size() == 1);
      CHECK(together[0].breaks() == breaks);
      CHECK(together[0].area == Approx(apart[0].area + apart[1].area));
      CHECK(together[0].lasts == Approx(apart[1].time - apart[0].time).margin(1e-15));
      CHECK((together[0].place - 0.5 * (apart[0].place + apart[1].place)).norm() < 1e-9);
    }
}

namespace
{
  /** Two clusters that fly at each other, bonded by each law; smooth joints lie across the first. */
  struct Clusters
  {
    std::string        name;
    dem::LinkMaterials materials;
    bool               jointed = false;

    dem::Specimen specimen(const std::size_t particles_each, const double reach, const double speed) const
    {
      dem::Packing packing = cluster::colliding_clusters(particles_each);
      if (jointed)
        {
          dem::JointPlane plane;
          plane.normal = across();
          packing.cuts = dem::find_cuts(packing, {3, 0, 1.1, 0, packing.size()}, {plane}).cuts;
          REQUIRE(packing.cuts.size() > 5);
        }
      dem::Specimen made(packing, heard(3, reach), materials);
      cluster::set_colliding_velocities(made, speed);
      return made;
    }

    static Vector3d across() { return Vector3d(0.8, 0.6, 0); }
  };

  std::vector<Clusters> all_clusters()
  {
    dem::CpmParameters plain = mortar(1), with_options = mortar_with_options(1);
    for (dem::CpmParameters *p : {&plain, &with_options})
      p->residual_strength_limit = 1e-2;
    with_options.options.compression_yield_strain = -1e-3;
    return {{"contact bond", glue(1)},
            {"parallel bond", cement(1)},
            {"flat joint", face(1)},
            {"CPM", plain},
            {"CPM with options", with_options},
            {"smooth joint",
             dem::LinkMaterials(glue(1)).with_joints(std::vector{plane_of_weakness(Clusters::across())}), true}};
  }
} // namespace

TEST_CASE("every break of a body is in one event, and listening changes no bit of its motion", "[dem][emission]")
{
  omp_set_num_threads(1);
  for (const Clusters &clusters : all_clusters())
    {
      INFO(clusters.name);
      const auto made = [&](const double reach) {
        dem::Specimen specimen = clusters.specimen(60, reach, 10);
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
}

TEST_CASE("events of emission have the same bits for any threads and after a restart amidst them",
          "[dem][emission][slow]")
{
  for (const Clusters &clusters : all_clusters())
    {
      INFO(clusters.name);
      check_same_bits([&] { return clusters.specimen(30, 2, 50); }, 60, 60, 5);
    }
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
