// Scenes whose integration points are cells of particles.
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/laws/cpm.h"
#include "dem/loading/periodic_cell.h"
#include "dem/packing/compaction.h"
#include "tests/apps/scene_runs.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  const std::string cells = "Materials/solid/cells/";

  /** A coarse plate with small cells, in a few steps. */
  std::vector<std::string> small_plate(const std::vector<std::string> &more = {})
  {
    std::vector<std::string> all = {"Mesh/Plate with hole/Radial divisions=3",
                                    "Mesh/Plate with hole/Angular divisions=4",
                                    cells + "Specimen/Generator/Cell particles=32",
                                    "Control/First step=0.2",
                                    "Control/Largest step=0.2",
                                    "Control/End=1"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /** A packing of three_cubes.prm. */
  dem::Packing packing_of_cubes(const std::uint64_t number)
  {
    dem::CompactionParameters packing;
    packing.radius       = 0.01;
    packing.count        = 75;
    packing.friction     = 0.1;
    packing.damping      = 0.8;
    packing.low_pressure = 6.667e-3;
    packing.seed         = 10 + number;
    return dem::compact(packing).packing;
  }

  /** D33 of eight of them, from the first one on, links of this modulus [Pa]. */
  double mean_of_static_moduli(const std::uint64_t first, const double modulus)
  {
    dem::NetworkParameters links;
    links.interaction_ratio = 1.5;
    links.normal_modulus    = modulus;
    links.shear_ratio       = 0.2;
    double sum              = 0;
    for (std::uint64_t i = 0; i < 8; ++i)
      sum += dem::relaxed_stiffness(dem::make_network(packing_of_cubes(first + i), links)).stiffness(2, 2);
    return sum / 8;
  }

  /** Mean pressure of eight of them [Pa] at shortenings of i/100 to a half, each driven there alone, slowly, and held sideways. */
  std::vector<double> pressures_of_cells(const std::uint64_t first, const double modulus)
  {
    dem::CpmParameters law;
    law.normal_modulus       = modulus;
    law.shear_ratio          = 0.2;
    law.limit_elastic_strain = 1e30;
    law.relative_ductility   = 30;
    law.cohesion             = 1e18;
    law.friction_coefficient = 0;
    dem::SpecimenParameters how;
    how.physics.periodic  = true;
    how.density           = 4800;
    how.damping           = 0.2;
    how.interaction_ratio = 1.5;
    std::vector<double> sum(51, 0.0);
    for (std::uint64_t i = 0; i < 8; ++i)
      {
        dem::Specimen           specimen(packing_of_cubes(first + i), how, law);
        dem::CellTestParameters p;
        dem::CellLeg            leg;
        leg.duration = 5000 * specimen.time_step();
        leg.target   = -0.5 * base::Vector6::Unit(2);
        p.path       = {leg};
        dem::CellTest test(specimen, p);
        for (std::size_t k = 1; k < sum.size(); ++k)
          sum[k] -= test.advance(100).stress[2] / 8;
      }
    return sum;
  }

  /** Where a curve of pressures_of_cells() reaches a pressure. */
  double shortening_at(const std::vector<double> &curve, const double pressure)
  {
    const auto        above = std::lower_bound(curve.begin(), curve.end(), pressure);
    const std::size_t i = std::min<std::size_t>(curve.size() - 1, std::max<std::ptrdiff_t>(1, above - curve.begin()));
    return 0.01 * (static_cast<double>(i) - 1 + (pressure - curve[i - 1]) / (curve[i] - curve[i - 1]));
  }
} // namespace

TEST_CASE(
  "Cells behind two of three cubes share strain as springs in series, as published, in motion and in equilibrium",
  "[apps][cells][slow]")
{
  // J. Stransky, PhD thesis, CTU Prague 2018, example multi1: shares 0.341, 0.220, 0.439 of top, middle and bottom in the limit of slow
  // loading, each to 5 %.
  const auto                     answer = GENERATE(as<std::string>(), "motion", "equilibrium");
  const ScratchFolder            folder;
  const std::vector<std::string> slowly = {"Boundary conditions/head/Displacement z=-0.05*t", "Motion/End time=0.8",
                                           "Motion/Damping=5", "Materials/middle/cells/Answer=" + answer,
                                           "Materials/bottom/cells/Answer=" + answer};
  const Results                  run    = results_of(folder, places::scene("three_cubes.prm"), slowly);
  const auto                     last   = [&](const char *column) { return run.series.column(column).back(); };
  const double                   pushed = 0.05 * last("time"), lower = -last("displacement_lower_joint_z"),
               upper = -last("displacement_upper_joint_z");
  CHECK((pushed - upper) / pushed == Approx(0.341).epsilon(0.05));
  CHECK((upper - lower) / pushed == Approx(0.220).epsilon(0.05));
  CHECK(lower / pushed == Approx(0.439).epsilon(0.05));
  CHECK(-last("reaction_head_z") / (pushed - upper) == Approx(4.4444e6).epsilon(1e-3));
  const double stress = 0.5 * (last("reaction_base_z") - last("reaction_head_z"));
  CHECK(stress / lower == Approx(3.45e6).epsilon(0.05));
  CHECK(stress / (upper - lower) == Approx(6.9e6).epsilon(0.05));
  // The force over the way, at its stages of the last half.
  const double in_series = 1 / (1 / 4.4444e6 + 1 / 6.9e6 + 1 / 3.45e6);
  for (std::size_t row = run.series.rows() / 2; row < run.series.rows(); ++row)
    {
      const double force =
        0.5 * (run.series.column("reaction_base_z")[row] - run.series.column("reaction_head_z")[row]);
      CHECK(force == Approx(in_series * 0.05 * run.series.column("time")[row]).epsilon(0.05));
    }
  // The eight points of a cube are strained alike: they are as stiff as the static solutions of their packings on average.
  CHECK(stress / lower == Approx(mean_of_static_moduli(0, 2e6)).epsilon(0.02));
  CHECK(stress / (upper - lower) == Approx(mean_of_static_moduli(8, 4e6)).epsilon(0.02));
}

TEST_CASE("Three cubes pushed by a third share the way as cells driven alone do, at every stage", "[apps][cells][slow]")
{
  // Far beyond small strains: the links of cells that are shortened turn away from the push, and the elastic cube stays linear.
  const ScratchFolder folder;
  const Results       run =
    results_of(folder, places::scene("three_cubes.prm"),
               {"Boundary conditions/head/Displacement z=-0.4*t", "Motion/End time=2.5", "Motion/Damping=10"});
  const auto       lower = pressures_of_cells(0, 2e6), middle = pressures_of_cells(8, 4e6);
  constexpr double elastic = 4e6 * 0.8 / (1.2 * 0.6);
  for (const double stage : {0.25, 0.5, 0.75, 1.0})
    {
      INFO("pushed by " << stage << " m");
      double low = 0, high = elastic * stage;
      while (high - low > 1)
        {
          const double p             = 0.5 * (low + high);
          const double way           = p / elastic + shortening_at(middle, p) + shortening_at(lower, p);
          (way > stage ? high : low) = p;
        }
      const auto       &time = run.series.column("time");
      const std::size_t row =
        static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), (stage - 1e-9) / 0.4) - time.begin());
      const double pushed   = 0.4 * time[row];
      const double of_lower = -run.series.column("displacement_lower_joint_z")[row],
                   of_both  = -run.series.column("displacement_upper_joint_z")[row];
      CHECK(of_lower / pushed == Approx(shortening_at(lower, low) / stage).epsilon(0.02));
      CHECK((of_both - of_lower) / pushed == Approx(shortening_at(middle, low) / stage).epsilon(0.02));
      CHECK((pushed - of_both) / pushed == Approx(low / elastic / stage).epsilon(0.02));
      const double force =
        0.5 * (run.series.column("reaction_base_z")[row] - run.series.column("reaction_head_z")[row]);
      CHECK(force / pushed == Approx(low / stage).epsilon(0.02));
    }
}

TEST_CASE("A scene with cells says what they are, how many are particles and where", "[apps][cells]")
{
  const ScratchFolder folder;
  const Outcome       check = outcome_of(folder, "check", places::scene("cells_at_hole.prm"), small_plate());
  CHECK(check.status == 0);
  CHECK_THAT(check.out, Contains("cells of 32 particles") && Contains("promoted at 0.9"));
  const Results run      = results_of(folder, places::scene("cells_at_hole.prm"), small_plate());
  const auto   &promoted = run.series.column("points_promoted");
  CHECK(promoted.front() == 0);
  CHECK(promoted.back() > 0);
  CHECK(promoted.back() < 48);
  CHECK(run.balance_error() < 0.01);
  CHECK(std::filesystem::file_size(folder.path() / "results" / "promoted.png") > 1000);
  bool shown = false;
  for (const auto &entry : std::filesystem::recursive_directory_iterator(folder.path()))
    if (entry.path().extension() == ".vtu")
      {
        std::ifstream     file(entry.path(), std::ios::binary);
        const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        shown = shown || (text.find("Name=\"promoted\"") != std::string::npos &&
                          text.find("Name=\"promoted_in_state\"") != std::string::npos);
      }
  CHECK(shown);
}

TEST_CASE("A run with cells ends where the first one localises, and names it", "[apps][cells][slow]")
{
  const ScratchFolder folder;
  const Results       run = results_of(
          folder, places::scene("cells_at_hole.prm"),
          small_plate({"Control/End=20", "Control/First step=0.05", "Control/Largest step=0.05", "Output/Snapshots=1"}));
  CHECK_THAT(run.summary["ended_by"].get<std::string>(),
             Contains("end of validity: the cell at") && Contains("has localised") && Contains("normal"));
  CHECK(run.summary["notes"].size() >= 1);
  CHECK(run.series.column("points_localised").back() >= 1);
}

TEST_CASE("A coupled run with cells ends where the first one localises, and names it", "[apps][cells][coupled][slow]")
{
  const ScratchFolder folder;
  const std::string   patch = "Continuum/Materials/patch/cells/";
  const Results       run =
    results_of(folder, places::scene("cells_under_ball.prm"),
               {patch + "When localised=stop", patch + "Material/CPM/Relative ductility=2",
                patch + "Specimen/Generator/Cell particles=16", "Particles/Initial velocity/ball/Velocity z=-10"});
  CHECK_THAT(run.summary["ended_by"].get<std::string>(),
             Contains("end of validity: the cell at") && Contains("has localised in state") && Contains("normal"));
  CHECK(run.series.column("time").back() < 7e-5); // of 8e-5
  CHECK(run.summary["notes"].size() >= 1);
}

TEST_CASE("A strip of elastic cells that is lifted far is an elastica", "[apps][cells][slow]")
{
  // K. E. Bisshopp, D. C. Drucker, Quarterly of Applied Mathematics 3 (1945) 272: P L^2/EI = 1, 2, 3 lift its end by 0.3017, 0.4935 and
  // 0.6033 L. It is thin, but neither without shear nor without extension.
  const ScratchFolder folder;
  const Results       run =
    results_of(folder, places::scene("cells_in_strip.prm"),
               {cells + "Material/CPM/Limit elastic strain=1e30", cells + "Material/CPM/Cohesion=1e18",
                "Control/First step=0.0205", "Control/Largest step=0.0205"});
  const auto &lifted = run.series.column("displacement_end_y"), &force = run.series.column("reaction_end_y");
  const auto  force_at = [&](const double part) {
    const double      wanted = part * 0.2;
    const auto        upper  = std::upper_bound(lifted.begin(), lifted.end(), wanted) - lifted.begin();
    const std::size_t i      = static_cast<std::size_t>(upper);
    const double      share  = (wanted - lifted[i - 1]) / (lifted[i] - lifted[i - 1]);
    return force[i - 1] + share * (force[i] - force[i - 1]);
  };
  CHECK(force_at(0.4935) / force_at(0.3017) == Approx(2).epsilon(5e-3));
  CHECK(force_at(0.6033) / force_at(0.3017) == Approx(3).epsilon(5e-3));
  CHECK(run.series.column("points_promoted").back() == 0);
}

TEST_CASE("A strip of cells that damage is softer than an elastic one, and its account is closed",
          "[apps][cells][slow]")
{
  const ScratchFolder folder;
  const Results       run = results_of(folder, places::scene("cells_in_strip.prm"));
  CHECK(run.series.column("points_promoted").back() > 20);
  CHECK(run.series.column("largest_damage").back() > 0.02);
  CHECK(run.balance_error() < 1e-3);
  const auto &iterations = run.series.column("iterations");
  CHECK(*std::max_element(iterations.begin(), iterations.end()) <= 5);
}

TEST_CASE("A plate of disc cells is the same in plane stress and in plane strain, and the hole promotes",
          "[apps][cells][slow]")
{
  const ScratchFolder            strain, stress;
  const std::vector<std::string> coarse = {
    "Mesh/Plate with hole/Radial divisions=4", "Mesh/Plate with hole/Angular divisions=4",
    "Materials/solid/cells/Tolerance=1e-11"}; // of cells, below that of the forces
  std::vector<std::string> other = coarse;
  other.push_back("Model/Plane=strain");
  const Results one = results_of(stress, places::scene("cells_of_discs.prm"), coarse),
                two = results_of(strain, places::scene("cells_of_discs.prm"), other);
  const auto &force = one.series.column("reaction_right_x");
  REQUIRE(two.series.rows() == one.series.rows());
  for (std::size_t row = 0; row < force.size(); ++row)
    CHECK(two.series.column("reaction_right_x")[row] == Approx(force[row]).epsilon(1e-9));
  CHECK(one.series.column("points_promoted").back() > 0);
  CHECK(one.balance_error() < 0.01);
}

TEST_CASE("Scenes with cells that cannot be are refused", "[apps][cells]")
{
  const ScratchFolder folder;
  is_refused(folder, places::scene("cells_at_hole.prm"), {"Model/Plane=stress"}, "not built for plane stress");
  is_refused(folder, places::scene("cells_at_hole.prm"), {cells + "Promotion=0"}, "Promotion");
  // Bonds with a contact in parallel are stiffer one way than the other.
  is_refused(folder, places::scene("cells_at_hole.prm"),
             {cells + "Material/Law=parallel-bond", cells + "Material/parallel-bond/Effective modulus=1e9",
              cells + "Material/parallel-bond/Bond effective modulus=1e9",
              cells + "Material/parallel-bond/Tensile strength=1e6", cells + "Material/parallel-bond/Cohesion=1e6"},
             "From the start = true");
  is_refused(folder, places::scene("cells_of_discs.prm"), {"Model/Dimension=3", "Mesh/Plate with hole/Depth=0.01"},
             "cells of discs are plane");
  is_refused(folder, places::scene("cells_of_discs.prm"),
             {cells + "Specimen/Source=generator", cells + "Specimen/Generator/Particle radius=3e-4"},
             "Read the discs from a file");
  // Particles in motion behind a solid without time.
  is_refused(folder, places::scene("cells_at_hole.prm"), {cells + "Answer=motion", cells + "Particle density=2400"},
             "Set Model/Analysis = explicit, or Answer = equilibrium");
}
