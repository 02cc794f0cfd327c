// The uniaxial scene (doc/theory/laboratory-test.md) against an independent program on the same packing and against published
// values; its rules of similarity.
#include "dem/laws/cpm.h"
#include "dem/loading/uniaxial.h"
#include "dem/neighbours/cell_list.h"
#include "dem/observation/crack.h"
#include "dem/packing/compaction.h"
#include "dem/packing/tiling.h"
#include "dem/statics/quasi_static_path.h"
#include "postprocess/packings/packing_io.h"
#include "tests/dem/clusters.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace
{
  constexpr double radius = 1e-3;

  dem::Packing cube(const double edge, const std::uint64_t seed)
  {
    dem::CompactionParameters parameters; // its defaults make the packing fraction 0.55 of the published specimens
    parameters.radius         = radius;
    parameters.seed           = seed;
    const Eigen::Vector3d box = Eigen::Vector3d::Constant(edge);
    parameters.count          = std::max(parameters.count, dem::count_to_fill(box, radius, parameters.friction));
    return dem::tile_and_crop(dem::compact(parameters).packing, box).packing;
  }

  struct Outcome
  {
    dem::UniaxialFigures             figures;
    double                           section, gauge_length;
    dem::Crack                       crack;
    double                           balance_error;
    std::vector<dem::UniaxialSample> curve; ///< every so many steps
  };

  /** The concrete on the reference cube as the independent program had it: shear kinematics, time step, grips, gauge length. */
  constexpr double reference_modulus = 28.43e9, reference_tension = 4.109e6, reference_compression = 33.43e6;

  dem::CpmParameters concrete_with_first_order_shear()
  {
    dem::CpmParameters p = cluster::concrete();
    p.shear_kinematics   = dem::ShearKinematics::first_order;
    return p;
  }

  dem::Packing reference_cube()
  {
    dem::Packing packing = postprocess::read_packing(places::sources() + "/meshes/reference_cube.txt");
    REQUIRE(packing.size() == 14561);
    return packing;
  }

  Outcome load(const dem::Packing       &packing,
               const dem::CpmParameters &material,
               const double              strain_rate,
               const dem::Gauge          gauge         = dem::Gauge::outermost_centres,
               const double              stop_fraction = 0,
               const double              time_step     = 0,
               const std::int64_t        sampling      = 100)
  {
    dem::SpecimenParameters specimen_parameters;
    specimen_parameters.density           = 4800;
    specimen_parameters.interaction_ratio = 1.5;
    specimen_parameters.damping           = 0.3;
    if (time_step > 0)
      specimen_parameters.step_factor = time_step / dem::Specimen(packing, specimen_parameters, material).stable_step();
    dem::Specimen specimen(packing, specimen_parameters, material);

    dem::UniaxialParameters loading;
    loading.strain_rate     = strain_rate;
    loading.grips.thickness = 2.2 * radius;
    loading.grips.gauge     = gauge;
    loading.stop_fraction   = stop_fraction > 0 ? stop_fraction : strain_rate > 0 ? 0.2 : 0.7;
    loading.stop_strain     = 5e-3;
    dem::UniaxialTest test(specimen, loading);
    double            worst = 0;
    while (!test.finished())
      {
        test.advance(sampling);
        if (specimen.steps() % 100 == 0)
          worst = std::max(worst, specimen.energy().balance_error());
      }
    return {test.figures(),
            test.section(),
            test.gauge_length(),
            dem::measure_crack(specimen.particles(), specimen.links(), {3, 4800, 0}),
            worst,
            test.curve()};
  }

  double strain_of(const dem::UniaxialSample &sample) { return std::abs(sample.strain); }
  double stress_of(const dem::UniaxialSample &sample) { return std::abs(sample.stress); }

  /** Where one quantity of a curve first reaches a value, the other one there, between samples. */
  template <typename Given, typename Wanted>
  double at_first(const std::vector<dem::UniaxialSample> &curve, const double value, Given given, Wanted wanted)
  {
    for (std::size_t i = 1; i < curve.size(); ++i)
      if (given(curve[i]) >= value)
        {
          const double part = (value - given(curve[i - 1])) / (given(curve[i]) - given(curve[i - 1]));
          return wanted(curve[i - 1]) + part * (wanted(curve[i]) - wanted(curve[i - 1]));
        }
    throw std::logic_error("the curve ends before");
  }

  /** Of ASTM C469: slope of the chord from a strain of 5e-5 to 40 % of the strength, in compression. */
  double chord_modulus(const Outcome &test)
  {
    constexpr double low_strain = 5e-5;
    const double     high       = 0.4 * test.figures.strength;
    return (high - at_first(test.curve, low_strain, strain_of, stress_of)) /
           (at_first(test.curve, high, stress_of, strain_of) - low_strain);
  }

  /** Mean over the links of the sum of radii over their length. */
  double mean_arm_ratio(const dem::Packing &packing, const double interaction_ratio)
  {
    const auto links = dem::find_pairs(packing.centre, packing.radius, interaction_ratio, 0.0, std::nullopt);
    double     sum   = 0;
    for (const dem::NeighbourPair &link : links)
      sum += 2 * radius / (packing.centre[link.second] - packing.centre[link.first]).norm();
    return sum / static_cast<double>(links.size());
  }
} // namespace

TEST_CASE("with its shear kinematics the reference cube has modulus and strengths of an independent program",
          "[verification][slow]")
{
  // The same law, grips, rates, damping and step there. Its figure of the modulus does not say how it was read; of a curve that bends,
  // doc/theory/laboratory-test.md, 6 lists the readings. This is the one that a laboratory takes, from every step of the test.
  const dem::Packing packing     = reference_cube();
  const double       step        = 0.8 * radius * std::sqrt(4800 / (2 * cluster::concrete().normal_modulus));
  const auto         gauge       = dem::Gauge::outermost_centres;
  const Outcome      tension     = load(packing, concrete_with_first_order_shear(), 0.4, gauge, 0.9, step);
  const Outcome      compression = load(packing, concrete_with_first_order_shear(), -3.0, gauge, 0.97, step, 1);
  const double       modulus     = chord_modulus(compression);
  CAPTURE(modulus, tension.figures.strength, compression.figures.strength, tension.figures.young_modulus,
          tension.balance_error, compression.balance_error);
  CHECK(tension.crack.links == 90881);
  CHECK(tension.section == Approx(2.5e-3).epsilon(1e-3));
  CHECK(modulus == Approx(reference_modulus).epsilon(0.01));
  CHECK(compression.figures.strength == Approx(reference_compression).epsilon(0.02));
  CHECK(tension.figures.strength == Approx(reference_tension).epsilon(0.04));
  CHECK_FALSE(tension.crack.touches_grip());
  CHECK(tension.balance_error < 1e-3);
  CHECK(compression.balance_error < 1e-3);
}

TEST_CASE("exact shear makes the reference cube stiffer and stronger by what the scaled slip leaves out",
          "[verification][slow]")
{
  // The other kinematics scale the slip of a link by the sum of radii over its length (doc/theory/shear-kinematics.md, 3): for equal
  // spheres exactly a shear modulus that is lower by as much, by 0.88 in the mean.
  const dem::Packing packing = reference_cube();
  const auto         both    = [&packing](const dem::CpmParameters &material) {
    return std::pair<Outcome, Outcome>(load(packing, material, 0.4, dem::Gauge::outermost_centres, 0.9),
                                       load(packing, material, -3.0, dem::Gauge::outermost_centres, 0.97, 0, 1));
  };
  dem::CpmParameters lowered = cluster::concrete();
  lowered.shear_ratio *= mean_arm_ratio(packing, 1.5);
  const auto [tension, compression]               = both(cluster::concrete());
  const auto [scaled_tension, scaled_compression] = both(lowered);
  CAPTURE(lowered.shear_ratio, tension.figures.young_modulus, tension.figures.strength, compression.figures.strength,
          chord_modulus(compression), chord_modulus(scaled_compression));
  CHECK(tension.figures.strength == Approx(4.179e6).epsilon(0.01));
  CHECK(compression.figures.strength == Approx(34.73e6).epsilon(0.01));
  CHECK(chord_modulus(compression) == Approx(29.39e9).epsilon(0.01));
  CHECK_FALSE(tension.crack.touches_grip());

  CHECK(scaled_tension.figures.strength == Approx(reference_tension).epsilon(0.01));
  CHECK(scaled_compression.figures.strength == Approx(reference_compression).epsilon(0.02));
  CHECK(chord_modulus(scaled_compression) == Approx(reference_modulus).epsilon(0.01));
}

TEST_CASE("with the default gauge length the modulus depends on the grips' thickness by less than 2 %",
          "[verification][slow]")
{
  dem::CompactionParameters make;
  const Eigen::Vector3d     box(0.016, 0.016, 0.04);
  make.radius               = radius;
  make.count                = dem::count_to_fill(box, radius, make.friction);
  make.proportions          = box;
  dem::Packing packing      = dem::tile_and_crop(dem::compact(make).packing, box).packing;
  const auto   modulus_with = [&packing](const double thickness, const dem::Gauge gauge) {
    const dem::CpmParameters law = cluster::concrete();
    dem::NetworkParameters   links;
    links.interaction_ratio = 1.5;
    links.normal_modulus    = law.normal_modulus;
    links.shear_ratio       = law.shear_ratio;
    dem::GripParameters requested;
    requested.thickness = thickness;
    requested.gauge     = gauge;
    dem::GripPair grips;
    grips.layers                      = dem::find_grip_layers({packing.centre, packing.radius}, 2, requested);
    const dem::LoadedNetwork   loaded = dem::load_grips(dem::make_network(packing, links), grips);
    dem::QuasiStaticParameters steps;
    steps.strain_step = 1e-6;
    steps.end_strain  = 1e-6;
    dem::QuasiStaticPath         path(loaded, law, steps);
    const dem::QuasiStaticPoint &point = path.advance();
    return point.stress[0] / point.strain[0];
  };
  const double thin = modulus_with(2.2e-3, dem::Gauge::inner_faces);
  CAPTURE(thin);
  for (const double thickness : {3e-3, 4.5e-3, 6e-3})
    CHECK(modulus_with(thickness, dem::Gauge::inner_faces) == Approx(thin).epsilon(0.02));
  // The published gauge length contains what is gripped: the same specimen seems a fifth stiffer.
  CHECK(modulus_with(6e-3, dem::Gauge::outermost_centres) > 1.15 * modulus_with(2.2e-3, dem::Gauge::outermost_centres));
}

TEST_CASE("50 mm cubes of three seeds have the reference modulus and strengths, and crack inside",
          "[verification][slow]")
{
  for (const std::uint64_t seed : {1, 2, 3})
    {
      CAPTURE(seed);
      const dem::Packing packing     = cube(0.05, seed);
      const Outcome      tension     = load(packing, cluster::concrete(), 0.4);
      const Outcome      compression = load(packing, cluster::concrete(), -3.0);
      const double       ratio       = compression.figures.strength / tension.figures.strength;
      CAPTURE(packing.size(), tension.figures.young_modulus, tension.figures.strength, compression.figures.strength,
              ratio);
      // Reference cube (above); the bands allow for another random packing and the exactly objective shear
      // update. Its published strength of 3.47 MPa was met as long as grips held half a layer and the section was a convex hull.
      CHECK(tension.figures.young_modulus == Approx(28.43e9).epsilon(0.1));
      CHECK(tension.figures.strength == Approx(4.109e6).epsilon(0.15));
      CHECK(compression.figures.strength == Approx(33.43e6).epsilon(0.15));
      CHECK(ratio > 7);
      CHECK(ratio < 11);
      CHECK_FALSE(tension.crack.touches_grip());
      CHECK(tension.balance_error < 1e-3);
      CHECK(compression.balance_error < 1e-3);
    }
}

TEST_CASE("doubling modulus and cohesion at constant limit strain doubles modulus and strengths",
          "[verification][slow]")
{
  const dem::Packing packing = cube(0.025, 1);
  dem::CpmParameters doubled = cluster::concrete();
  doubled.normal_modulus *= 2;
  doubled.cohesion *= 2;
  for (const double rate : {0.4, -3.0})
    {
      CAPTURE(rate);
      const dem::UniaxialFigures once  = load(packing, cluster::concrete(), rate).figures,
                                 twice = load(packing, doubled, rate).figures;
      // 3 %: inertia does not scale with the modulus at a given rate.
      CHECK(twice.young_modulus == Approx(2 * once.young_modulus).epsilon(0.03));
      CHECK(twice.strength == Approx(2 * once.strength).epsilon(0.03));
      CHECK(twice.strain_at_peak == Approx(once.strain_at_peak).epsilon(0.1)); // a flat peak: its place is less sharp
    }
}
