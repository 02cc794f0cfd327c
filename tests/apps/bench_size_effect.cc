// Laws of size effect, and the bench that fits them to beams of one shape.
#include "apps/bench/scene_variant.h"
#include "apps/bench/size_effect_answer.h"
#include "apps/bench/size_effect_beams.h"
#include "apps/process/mpi_session.h"
#include "base/errors.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/apps/universal_law.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <sstream>
#include <vector>

using namespace apps_tests;
using Catch::Contains;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace
{
  /** Beams of 20 to 160 mm that follow a law, three of each with a scatter of 3 %. */
  template <typename Law>
  std::vector<apps::SizeStrength> beams_of(const Law &law, const double scatter)
  {
    std::vector<apps::SizeStrength> beams;
    for (const double depth : {0.02, 0.04, 0.08, 0.16})
      for (const double part : {-1.0, 0.0, 1.0})
        beams.push_back({depth, law.at(depth) * std::exp(scatter * part)});
    return beams;
  }

  apps::SmoothBeamLaw smooth_law_of(const double strength, const double layer, const double exponent)
  {
    apps::SmoothBeamLaw law;
    law.strength.value = strength;
    law.layer.value    = layer;
    law.exponent.value = exponent;
    return law;
  }

  std::vector<apps::SizeStrength> beams_of_both_kinds(const apps::UniversalLaw &law)
  {
    std::vector<apps::SizeStrength> beams;
    for (const double depth : {0.02, 0.04, 0.08, 0.16})
      for (const double notch : {0.3, 0.0})
        beams.push_back({depth, law.at({depth, 0, notch}), notch});
    return beams;
  }

  apps::BrokenBeam beam_of(const apps::BeamCase &of, const double strength, const double work)
  {
    apps::BrokenBeam beam;
    beam.of       = of;
    beam.depth    = 0.02 * of.size;
    beam.strength = strength;
    beam.work     = work;
    return beam;
  }

  apps::SizeEffectLaw law_of(const double strength, const double depth, const double exponent)
  {
    apps::SizeEffectLaw law;
    law.strength.value = strength;
    law.depth.value    = depth;
    law.exponent.value = exponent;
    return law;
  }
} // namespace

TEST_CASE("laws of size effect are found again from beams that follow them, within their own uncertainty",
          "[apps][mesoscale]")
{
  const apps::SizeEffectLaw exact = apps::fitted_bazant(beams_of(law_of(5e6, 0.05, 1), 0));
  CHECK_THAT(exact.strength.value, WithinRel(5e6, 1e-6));
  CHECK_THAT(exact.depth.value, WithinRel(0.05, 1e-5));
  CHECK(exact.scatter < 1e-6);

  const apps::SizeEffectLaw free = apps::fitted_with_exponent(beams_of(law_of(5e6, 0.05, 0.6), 0));
  CHECK_THAT(free.exponent.value, WithinRel(0.6, 1e-3));
  CHECK_THAT(free.strength.value, WithinRel(5e6, 1e-3));

  const apps::SizeEffectLaw rough = apps::fitted_bazant(beams_of(law_of(5e6, 0.05, 1), 0.03));
  CHECK(std::fabs(rough.strength.value - 5e6) < rough.strength.half_width);
  CHECK(std::fabs(rough.depth.value - 0.05) < rough.depth.half_width);
  CHECK_THAT(rough.scatter,
             WithinRel(0.03 * std::sqrt(8.0 / 10), 1e-3)); // eight of twelve are off by 3 %, two constants

  // Small beams fail by strength, large ones as a crack does: with the root of the size.
  CHECK_THAT(law_of(5e6, 0.05, 1).at(1e-9), WithinRel(5e6, 1e-6));
  CHECK_THAT(law_of(5e6, 0.05, 1).at(50) * std::sqrt(50.0), WithinRel(5e6 * std::sqrt(0.05), 1e-3));
}

TEST_CASE("strengths that do not fall with the size have no law of size effect", "[apps][mesoscale]")
{
  CHECK_THROWS_WITH(apps::fitted_bazant({{0.02, 3e6}, {0.04, 3.1e6}, {0.08, 3.2e6}}), Contains("does not fall"));
  CHECK_THROWS_WITH(apps::fitted_bazant({{0.02, 3e6}, {0.02, 3.1e6}, {0.02, 2.9e6}}), Contains("two sizes"));
  CHECK_THROWS_AS(apps::fitted_bazant({{0.02, 3e6}, {0.04, 2e6}}), base::InputError);
}

TEST_CASE("the crack of a beam has the published shape, and its law gives back the energy that it was made of",
          "[apps][mesoscale]")
{
  // RILEM TC 89-FMT (1990), span of 2.5 depths: F(0.3) of the polynomial, by hand.
  const double F = (1 - 0.75 + 0.4041 - 0.10746 + 0.010773) / std::pow(0.7, 1.5);
  CHECK_THAT(apps::shape_of_crack(0.3), WithinRel(M_PI * 0.3 * F * F, 1e-12));
  // Bazant, Pfeiffer (1987), ACI Mater. J. 84, 463: g = 6.07 for a notch of a sixth, of the nominal stress P/(bD) = sigma_N/3.75.
  CHECK_THAT(3.75 * 3.75 * apps::shape_of_crack(1.0 / 6), WithinAbs(6.07, 0.01));

  const double              young = 30e9, alpha = 0.3;
  const apps::SizeEffectLaw law   = law_of(4e6, 0.06, 1);
  const apps::CrackOfLaw    crack = apps::crack_of(law, alpha, young);
  // A very large beam fails at K = sqrt(E G).
  CHECK_THAT(std::pow(law.at(1e6), 2) * 1e6 * apps::shape_of_crack(alpha) / young, WithinRel(crack.energy, 1e-6));
  // One beam of that law and its energy give back the law.
  const apps::SizeEffectLaw from_one = apps::law_of_one_size({0.04, law.at(0.04)}, crack.energy, alpha, young);
  CHECK_THAT(from_one.strength.value, WithinRel(4e6, 1e-6));
  CHECK_THAT(from_one.depth.value, WithinRel(0.06, 1e-6));
  CHECK_THROWS_WITH(apps::law_of_one_size({0.04, 2 * law.at(1e-6)}, crack.energy, alpha, young), Contains("no law"));
}

TEST_CASE("the law of smooth beams is found again from beams that follow it", "[apps][mesoscale]")
{
  const apps::SmoothBeamLaw exact = apps::fitted_smooth(beams_of(smooth_law_of(4e6, 0.01, 1), 0));
  CHECK_THAT(exact.strength.value, WithinRel(4e6, 1e-6));
  CHECK_THAT(exact.layer.value, WithinRel(0.01, 1e-5));
  const apps::SmoothBeamLaw free = apps::fitted_smooth_with_exponent(beams_of(smooth_law_of(4e6, 0.01, 1.5), 0));
  CHECK_THAT(free.exponent.value, WithinRel(1.5, 1e-3));
  CHECK_THAT(free.strength.value, WithinRel(4e6, 1e-4));
  CHECK_THAT(free.layer.value, WithinRel(0.01, 1e-3));

  // A large beam breaks at f_inf; r = 1 is f_inf (1 + D_b/D).
  CHECK_THAT(smooth_law_of(4e6, 0.01, 2).at(1e4), WithinRel(4e6, 1e-5));
  CHECK_THAT(smooth_law_of(4e6, 0.01, 1).at(0.04), WithinRel(5e6, 1e-12));
  CHECK_THAT(smooth_law_of(4e6, 0.01, 2).at(0.02), WithinRel(4e6 * std::sqrt(2.0), 1e-12));
  CHECK_THROWS_WITH(apps::fitted_smooth({{0.02, 3e6}, {0.04, 3.1e6}, {0.08, 3.2e6}}), Contains("does not fall"));
}

TEST_CASE("standard errors of a law of size effect are the scatter of its constants over repeated tests",
          "[apps][mesoscale]")
{
  const apps::SmoothBeamLaw law     = smooth_law_of(4e6, 0.01, 1);
  constexpr double          scatter = 0.03;
  constexpr int             tests   = 600;
  std::mt19937_64           random(7);
  std::normal_distribution  normal(0.0, scatter);
  double                    sum = 0, squares = 0, sum_layer = 0, squares_layer = 0, claimed = 0, claimed_layer = 0;
  for (int test = 0; test < tests; ++test)
    {
      std::vector<apps::SizeStrength> beams = beams_of(law, 0);
      for (apps::SizeStrength &beam : beams)
        beam.strength *= std::exp(normal(random));
      const apps::SmoothBeamLaw fit = apps::fitted_smooth(beams);
      const double              f = std::log(fit.strength.value), layer = std::log(fit.layer.value);
      sum += f;
      squares += f * f;
      sum_layer += layer;
      squares_layer += layer * layer;
      claimed += std::pow(fit.strength.standard_error / fit.strength.value, 2);
      claimed_layer += std::pow(fit.layer.standard_error / fit.layer.value, 2);
    }
  const auto variance = [](const double total, const double of_squares) {
    return (of_squares - total * total / tests) / (tests - 1);
  };
  // The deviation of 600 draws is itself known to 3 %.
  CHECK_THAT(std::sqrt(claimed / tests), WithinRel(std::sqrt(variance(sum, squares)), 0.1));
  CHECK_THAT(std::sqrt(claimed_layer / tests), WithinRel(std::sqrt(variance(sum_layer, squares_layer)), 0.1));
}

TEST_CASE("the universal law is that of a notch and that of none at its ends, and is found again from both kinds",
          "[apps][mesoscale]")
{
  const apps::UniversalLaw law = universal_law();
  const double             E = law.young, G = law.energy.value, c = law.zone.value, D = 0.08;
  const double             g = apps::shape_of_crack(0.3), slope = apps::slope_of_shape(0.3);
  CHECK_THAT(law.at({D, 0, 0.3}), WithinRel(std::sqrt(E * G / (g * D + slope * c)), 1e-12));
  CHECK_THAT(law.at({D, 0, 0}), WithinRel(smooth_law_of(3.5e6, 0.008, 1.3).at(D), 1e-12));
  // Between the ends, by hand: lambda = 0.5.
  const double resisted = g * D + 0.5 * slope * c + 0.5 * E * G / std::pow(3.5e6, 2);
  CHECK_THAT(law.at({D, 0, 0.3}, 0.5),
             WithinRel(std::sqrt(E * G / resisted) * std::pow(1 + 1.3 * 0.5 * 0.008 / D, 1 / 1.3), 1e-12));

  const apps::UniversalLaw found = apps::fitted_universal(beams_of_both_kinds(law), E);
  CHECK_THAT(found.energy.value, WithinRel(40, 1e-4));
  CHECK_THAT(found.zone.value, WithinRel(0.012, 1e-4));
  CHECK_THAT(found.strength.value, WithinRel(3.5e6, 1e-4));
  CHECK_THAT(found.layer.value, WithinRel(0.008, 1e-3));
  CHECK_THAT(found.exponent.value, WithinRel(1.3, 1e-3));
}

TEST_CASE("a crack that begins at the face has the layer of its zone", "[apps][mesoscale]")
{
  // Bazant, Li (1995): sigma_N^2 (g'(0) c + g''(0) c^2/(2 D)) = E G, whose expansion for large D is f (1 + D_b/D), D_b = -g'' c/(4 g').
  constexpr double c = 0.01, D = 100, step = 1e-4;
  const double     slope  = apps::shape_of_crack(step) / step; // at step/2 to the second order
  const double     second = (apps::shape_of_crack(2 * step) - 2 * apps::shape_of_crack(step)) / (step * step);
  CHECK_THAT(slope, WithinRel(M_PI, 1e-3));
  CHECK_THAT(-second / (4 * M_PI), WithinRel(1.0, 2e-3));
  const apps::SmoothBeamLaw law    = apps::smooth_law_of_one_size({0.04, 5e6}, c);
  const double              energy = M_PI * c * std::pow(law.strength.value, 2); // E G
  const double              exact  = std::sqrt(energy / (M_PI * c - 4 * M_PI * c * c / (2 * D)));
  CHECK_THAT(law.at(D), WithinRel(exact, 1e-7));
  CHECK_THAT(law.at(0.04), WithinRel(5e6, 1e-12));
}

TEST_CASE("one size alone predicts the beams of a law that it obeys, with a notch and without", "[apps][mesoscale]")
{
  const double                  young = 30e9;
  const apps::SizeEffectLaw     deep  = law_of(4e6, 0.06, 1);
  const apps::CrackOfLaw        crack = apps::crack_of(deep, 0.3, young);
  const apps::SmoothBeamLaw     face  = smooth_law_of(4.5e6, crack.zone, 1);
  std::vector<apps::BrokenBeam> all;
  for (const int size : {1, 2, 4, 8})
    for (const bool notched : {true, false})
      all.push_back(beam_of({size, 1, notched, false, size == 2}, notched ? deep.at(0.02 * size) : face.at(0.02 * size),
                            crack.energy));
  const apps::SizeEffectAnswer answer = apps::size_effect_answer(all, 2, young);
  REQUIRE(answer.laws.size() == 4);
  for (const apps::NamedLaw &law : answer.laws)
    for (const double depth : {0.02, 0.16})
      {
        INFO(law.name);
        REQUIRE(law.notched);
        REQUIRE(law.smooth);
        CHECK_THAT(law.notched(depth), WithinRel(deep.at(depth), 1e-3));
        CHECK_THAT(law.smooth(depth), WithinRel(face.at(depth), 1e-3));
      }
}

TEST_CASE("beams that a folder holds are read as they were written", "[apps][mesoscale]")
{
  apps::BrokenBeam beam        = beam_of({2, 3, false, true, false}, 4e6, 30);
  beam.particles               = 1375;
  beam.cost                    = 12.5;
  beam.shared                  = 0.01;
  const apps::BrokenBeam again = apps::BrokenBeam::read(beam.of, beam.record());
  CHECK(again.strength == 4e6);
  CHECK(again.work == 30);
  CHECK(again.particles == 1375);
  CHECK(again.shared == 0.01);
  CHECK(again.cost == 12.5);
  CHECK(again.of.name() == "size 2, geometry 3, without notch, all particles");
}

TEST_CASE("beams of all sizes have the elements of the smallest, and their cores are whole numbers of these",
          "[apps][mesoscale]")
{
  apps::start_mpi();
  for (const char *const name : {"size_effect.prm", "size_effect_plane.prm"})
    {
      const std::string           path  = places::sources() + "/apps/scenes/" + name;
      const apps::CheckedScene    scene = apps::read_scene(path, {});
      const apps::StructureModel &one   = apps::model_of_kind<apps::StructureModel>(scene, "structure");
      const auto                  edge  = [](const apps::StructureModel &model, const int axis) {
        return model.continuum.mesh.box_size[axis] / static_cast<double>(model.continuum.mesh.box_divisions[axis]);
      };
      const int up = one.dimension - 1;
      for (const int size : {1, 2, 4, 8})
        for (const bool notched : {true, false})
          {
            INFO(name << ", size " << size << ", notch " << notched);
            const apps::CheckedScene    checked = apps::scene_of_beam(path, {}, one, {size, 1, notched, false, false});
            const apps::StructureModel &beam    = apps::model_of_kind<apps::StructureModel>(checked, "structure");
            CHECK_THAT(edge(beam, 0), WithinRel(edge(one, 0), 1e-12));
            CHECK_THAT(edge(beam, up), WithinRel(edge(one, up), 1e-12));
            CHECK_THAT(beam.continuum.mesh.box_size[up], WithinRel(0.02 * size, 1e-12));
            const auto  &core  = beam.handshakes.handshakes.front();
            const double whole = (core.high[0] - core.low[0]) / edge(beam, 0), low = core.low[0] / edge(beam, 0);
            CHECK(whole > 2);
            CHECK_THAT(whole, WithinRel(std::round(whole), 1e-9));
            CHECK_THAT(low, WithinRel(std::round(low), 1e-9));
          }
    }
}

TEST_CASE("a beam of elements around grown discs bears what the beam all of discs does until it cracks",
          "[apps][mesoscale]")
{
  apps::start_mpi();
  const std::string              path = places::sources() + "/apps/scenes/size_effect_plane.prm";
  const std::vector<std::string> until{"Path/End=4e-6"}; // a seventh of the deflection at the peak
  const apps::CheckedScene       scene = apps::read_scene(path, until);
  const apps::StructureModel    &one   = apps::model_of_kind<apps::StructureModel>(scene, "structure");
  double                         strength[2];
  for (const bool alone : {false, true})
    {
      const apps::BeamCase   beam{1, 1, true, alone, false};
      const apps::BrokenBeam found = apps::broken(apps::scene_of_beam(path, until, one, beam), beam);
      strength[alone]              = found.strength;
      CHECK(found.left > 0.999); // still rising
      CHECK(found.balance < 1e-3);
    }
  CHECK_THAT(strength[0], WithinRel(strength[1], 0.05));
}

TEST_CASE("parts of bench size-effect share its folder, and the last of them writes the table", "[apps][mesoscale]")
{
  const ScratchFolder            folder;
  const std::vector<std::string> words{"bench",
                                       "size-effect",
                                       places::sources() + "/apps/scenes/size_effect_plane.prm",
                                       "--sizes",
                                       "1",
                                       "--calibrated",
                                       "1",
                                       "--geometries",
                                       "1",
                                       "--particles",
                                       "1",
                                       "-o",
                                       "bench"};
  const auto                     part = [&](const std::string &which) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--part", which});
    return run(folder.path(), all);
  };
  const Outcome first = part("1/2");
  INFO(first.err);
  REQUIRE(first.status == 0);
  CHECK_THAT(first.out, Contains("2 of 4 beams are there"));
  CHECK_FALSE(std::filesystem::exists(folder / "bench/size_effect.csv"));
  REQUIRE(part("2/2").status == 0);
  const std::string table = content_of(folder / "bench/size_effect.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 5);
  std::istringstream page(content_of(folder / "bench/size_effect.md"));
  std::ptrdiff_t     cells = 0; // of the table that a line belongs to
  for (std::string line; std::getline(page, line);)
    {
      const std::ptrdiff_t bars = std::count(line.begin(), line.end(), '|');
      INFO(line);
      CHECK((cells == 0 || bars == 0 || bars == cells));
      cells = bars;
    }
  CHECK(part("3/2").status == 2);
}

TEST_CASE("bench size-effect refuses a scene without a bending test, and a size that it does not run",
          "[apps][mesoscale]")
{
  const ScratchFolder folder;
  const std::string   scenes = places::sources() + "/apps/scenes/";
  const Outcome other = run(folder.path(), {"bench", "size-effect", scenes + "wedge_splitting.prm", "-o", "bench"});
  CHECK(other.status == 2);
  CHECK_THAT(other.err, Contains("Bending test"));
  const Outcome size =
    run(folder.path(), {"bench", "size-effect", scenes + "size_effect.prm", "--sizes", "1,4", "-o", "bench"});
  CHECK(size.status == 2);
  CHECK_THAT(size.err, Contains("--calibrated"));
}
