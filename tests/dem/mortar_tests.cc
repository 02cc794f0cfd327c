// Grown mortar and its limit, the crystal of discs of one size: doc/theory/genesis.md, 8 (specimen generation, tests 7 and 10).
#include "clusters.h"
#include "dem/core/uniform_random.h"
#include "dem/genesis/genesis.h"
#include "dem/genesis/sizes.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/laboratory/lab_test.h"
#include "dem/laws/flat_joint.h"
#include "dem/packing/lattice.h"
#include "dem/statics/quasi_static_path.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

using Eigen::Vector3d;

namespace
{
  constexpr double thickness = 1;
  /** Crystal of touching discs, k_n over k_s = 2.5 (T8 of bonded contact laws): 2 sqrt(3) (1 + 1/2.5)/(3 + 1/2.5). */
  const double crystal_over_joints = 2 * std::sqrt(3) * 1.4 / 3.4;
  /** Ortiz-Cahun et al. (2023), mortar of one size: modulus of its joints, its own, contacts per particle, porosity. */
  constexpr double joint_modulus = 9.68e9, published_modulus = 7.994e9, published_contacts = 51906.0 / 18270,
                   porosity = 0.10, diameter = 1.68e-3;

  dem::FlatJointParameters joint_of_one_size()
  {
    dem::FlatJointParameters p;
    p.effective_modulus = joint_modulus;
    p.stiffness_ratio   = 2.5;
    p.tensile_strength = p.cohesion = 1e12;
    return p;
  }

  dem::FlatJointParameters joint_of_four_sizes()
  {
    dem::FlatJointParameters p;
    p.effective_modulus         = 10.38e9;
    p.stiffness_ratio           = 2.5;
    p.tensile_strength          = 0.29e6;
    p.cohesion                  = 1.98e6;
    p.friction_angle            = 20.7;
    p.friction_coefficient      = 0.21;
    p.contact_effective_modulus = 7.34e9;
    p.contact_stiffness_ratio   = 2.5;
    return p;
  }

  dem::NetworkParameters plane_links()
  {
    dem::NetworkParameters p;
    p.dimension         = 2;
    p.interaction_ratio = 1.01;
    p.thickness         = thickness;
    return p;
  }

  /** Young's modulus in the plane of a network between smooth ends, in equilibrium [Pa]. */
  double between_smooth_ends(const dem::Packing &packing, const int axis)
  {
    const dem::LinkMaterials law = joint_of_one_size();
    dem::GripParameters      ends;
    ends.thickness = 0.25 * diameter;
    dem::GripPair pair;
    pair.axis   = axis;
    pair.layers = dem::find_grip_layers({packing.centre, packing.radius, 2, thickness}, axis, ends);
    const dem::LoadedNetwork   loaded = dem::load_grips(dem::make_network(packing, plane_links(), law), pair);
    dem::QuasiStaticParameters p;
    p.sign        = -1;
    p.strain_step = p.end_strain = 1e-6;
    dem::QuasiStaticPath path(loaded, law, p);
    const auto          &point = path.advance();
    return point.stress[loaded.driven] / point.strain[loaded.driven];
  }

  /** Of the stiffness of a periodic network that is isotropic in the mean. */
  double young(const base::Matrix6 &D)
  {
    const double along = 0.5 * (D(0, 0) + D(1, 1)), across = 0.5 * (D(0, 1) + D(1, 0));
    return along - across * across / along;
  }

  /** A periodic crystal in which joints were taken out at random until so many are left per particle. */
  dem::ElasticNetwork thinned_crystal(const double contacts_per_particle, const std::uint64_t seed)
  {
    const dem::Packing  crystal = dem::make_lattice(dem::Lattice::hexagonal, 0.5 * diameter, {52, 30, 1});
    dem::ElasticNetwork network = dem::make_network(crystal, plane_links(), dem::LinkMaterials(joint_of_one_size()));
    const auto          left    = static_cast<std::size_t>(contacts_per_particle * static_cast<double>(crystal.size()));
    dem::UniformRandom  random(seed);
    while (network.links.size() > left)
      network.links.erase(network.links.begin() +
                          static_cast<std::ptrdiff_t>(random() * static_cast<double>(network.links.size())));
    return network;
  }

  /** Mortar of four sizes, as grown: 10 mm x 20 mm at the published porosity. */
  dem::Packing grown_mortar()
  {
    std::vector<dem::SizeClass> classes;
    for (const double d : {0.54e-3, 1.24e-3, 2.51e-3, 4.48e-3})
      classes.push_back({0.25, d, d});
    dem::GenesisParameters p;
    p.vessel.size                           = {0.01, 0.02, 0};
    p.material.contact.effective_modulus    = 8e9;
    p.material.contact.friction_coefficient = 0.1;
    p.radii  = dem::draw_radii(classes, dem::class_counts(classes, p.vessel.space(), porosity, 2), 1);
    p.seed   = 1;
    p.stress = 0;
    dem::Genesis genesis(p);
    genesis.advance(std::numeric_limits<std::int64_t>::max() / 2);
    return genesis.packing();
  }

  dem::SpecimenParameters mortar_specimen()
  {
    dem::SpecimenParameters p = cluster::next_neighbours();
    p.physics.dimension       = 2;
    p.thickness               = thickness;
    p.density                 = 1624;
    p.damping                 = 0.7;
    p.interaction_ratio       = 1;
    p.installation_gap        = 2e-4;
    return p;
  }

  dem::LabParameters crushing()
  {
    dem::LinearContactParameters platens;
    platens.effective_modulus = 8e9;
    dem::LabParameters p;
    p.test          = dem::LabParameters::Test::compression;
    p.press.axis    = 1;
    p.press.contact = platens;
    p.press.stand   = {0.0, 0.02};
    p.speed         = 0.02;
    p.stop_strain   = 4e-3;
    return p;
  }

  double strength_of(const dem::Packing &packing)
  {
    dem::Specimen body(packing, mortar_specimen(), joint_of_four_sizes());
    dem::LabTest  test(body, crushing());
    test.drive();
    body.advance(1000000, [&] {
      test.observe();
      body.partners().clear_forces();
      test.drive();
      return !test.finished();
    });
    REQUIRE(test.figures().strength.found);
    return test.figures().strength.value;
  }
} // namespace

TEST_CASE("crystal cut to a rectangle is as stiff as the closed form, along its rows and across them (genesis 10)",
          "[dem][genesis]")
{
  for (const int along : {0, 1})
    {
      // 60 diameters across the load, about twice as many along it.
      dem::Packing crystal =
        dem::make_lattice(dem::Lattice::hexagonal, 0.5 * diameter,
                          along == 0 ? std::array<int, 3>{120, 35, 1} : std::array<int, 3>{60, 70, 1});
      crystal.periodic_cell.reset();
      INFO("axis " << along);
      CHECK(between_smooth_ends(crystal, along) == Approx(crystal_over_joints * joint_modulus).epsilon(0.03));
    }
}

TEST_CASE("discs of one size with the published joints cannot be as soft as is published", "[dem][genesis]")
{
  // As many joints as published, taken out of the crystal at random: a modulus half as large again as the published one.
  for (const std::uint64_t seed : {1, 2, 3})
    {
      const dem::ElasticNetwork network = thinned_crystal(published_contacts, seed);
      const double E = young(dem::relaxed_stiffness(network).stiffness), most = young(dem::affine_stiffness(network));
      INFO("seed " << seed << ": E " << E << " Pa, with affine motion " << most << " Pa");
      CHECK(most == Approx(published_contacts / 3 * crystal_over_joints * joint_modulus).epsilon(0.005));
      CHECK(E < most);
      CHECK(E > 1.5 * published_modulus);
    }
  // Joints of half the area (as the printed areas are) cannot be as stiff as published, however particles move: the bound of affine motion,
  // by discs of one size at that porosity, S/2 (1 + 1/2.5)/(3 + 1/2.5) with S = 4 (1 - n)/pi CN/N.
  const double bound = 4 * (1 - porosity) / M_PI * published_contacts * 1.4 / 3.4 * joint_modulus;
  CHECK(bound > published_modulus);
  CHECK(0.5 * bound < published_modulus);
}

TEST_CASE("grown mortar loaded to a tenth of its strength and unloaded is what it was (genesis 7)",
          "[dem][genesis][slow]")
{
  const dem::Packing packing  = grown_mortar();
  const double       strength = strength_of(packing), width = 0.01;
  dem::Specimen      body(packing, mortar_specimen(), joint_of_four_sizes());
  dem::Press         press(body, crushing().press);
  const auto         until = [&](const double speed, const std::function<bool()> &there) {
    for (int i = 0; i < 400000 && !there(); ++i)
      {
        press.move(speed);
        body.advance(1);
      }
    press.move(0);
    body.advance(40000);
  };
  until(0.005, [&] { return press.force(dem::Press::high) / (width * thickness) >= 0.1 * strength; });
  const double loaded = press.approach(), stored = body.energy().elastic;
  CHECK(loaded > 0);
  CHECK(body.logged_breaks() == 0);
  until(-0.005, [&] { return press.approach() <= 0; });
  const auto now  = body.particles();
  double     most = 0;
  for (std::size_t i = 0; i < now.displacement.size(); ++i)
    most = std::max(most, now.displacement[i].norm());
  INFO("approach " << loaded << ", left " << press.approach() << ", farthest from its place " << most
                   << ", energy left " << body.energy().elastic / stored);
  CHECK(std::max(std::abs(press.force(dem::Press::low)), std::abs(press.force(dem::Press::high))) <
        1e-6 * 0.1 * strength * width);
  CHECK(body.energy().elastic < 1e-9 * stored);
  CHECK(body.energy().released == 0);
}
