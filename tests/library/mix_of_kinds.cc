// One mix in every kind of scene that makes particles, from code: the same aggregates, and the same materials of links.
#include "apps/models/mix.h"
#include "apps/runs/coupled/model.h"
#include "apps/runs/particles/model.h"
#include "apps/runs/sequential/particle_case.h"
#include "apps/runs/structure/model.h"
#include "base/errors.h"
#include "dem/laws/cpm.h"
#include "tests/apps/scratch_folder.h"
#include "tests/apps/uneven_lattice.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

using Catch::Contains;
using Catch::WithinAbs;

namespace
{
  apps::SpecimenSection box_of(const std::filesystem::path &file)
  {
    apps::SpecimenSection specimen;
    specimen.source            = apps::SpecimenSection::Source::file;
    specimen.file              = file.string();
    specimen.box               = {0.016, 0.016, 0.016};
    specimen.density           = 4000;
    specimen.interaction_ratio = 1.5;
    return specimen;
  }

  apps::MixSection aggregates()
  {
    apps::MixSection mix;
    mix.content  = 0.3;
    mix.grading  = apps::MixSection::Grading::passing;
    mix.curve    = {{4e-3, 0}, {7e-3, 100}};
    mix.smallest = 4e-3;
    mix.sizes    = apps::MixSection::Sizes::drawn;
    return mix;
  }

  dem::CpmParameters mortar()
  {
    dem::CpmParameters p;
    p.normal_modulus       = 25e9;
    p.shear_ratio          = 0.2;
    p.limit_elastic_strain = 1e-4;
    p.relative_ductility   = 30;
    p.cohesion             = 3e6;
    p.friction_coefficient = 0.8;
    return p;
  }

  template <typename Model>
  void fill(Model &model, const std::filesystem::path &file)
  {
    model.source = box_of(file);
    model.mix    = aggregates();
    model.material.only.choose(mortar());
  }

  /** Pulled between grips to a strain, and handed over. */
  apps::ParticleEventSection strained(const std::filesystem::path &file, const double strain)
  {
    apps::ParticleEventSection event;
    event.specimen = box_of(file);
    event.mix      = aggregates();
    event.material.only.choose(mortar());
    event.strain_rate     = 1;
    event.grips.thickness = 2.2e-3;
    event.instants        = {{strain, {}}};
    return event;
  }

  apps::ParticleOutcome handed_over(const apps::ParticleEventSection &event)
  {
    const auto straining = apps::make_particle_case(event, apps::event_packing(event), 0);
    while (!straining->finished())
      straining->advance();
    return straining->outcome();
  }

  /** Number of the sphere that a place lies in by a depth at least, from 0; -1: in none. */
  int sphere_around(const dem::Mesostructure &structure, const Eigen::Vector3d &place, const double depth)
  {
    for (std::size_t k = 0; k < structure.inclusions.size(); ++k)
      if ((place - structure.inclusions[k].centre).norm() <= structure.inclusions[k].radius - depth)
        return static_cast<int>(k);
    return -1;
  }
} // namespace

TEST_CASE("Mix: particles, structures, coupled and sequential scenes have the aggregates that a uniaxial one has",
          "[library][mesoscale]")
{
  const apps_tests::ScratchFolder folder;
  const auto                      file = folder.file("packing.txt", apps_tests::uneven_lattice(8));
  apps::ParticlesModel            particles;
  fill(particles, file);
  const dem::Packing expected = particles.mixed().packing(); // as uniaxial scenes make it
  REQUIRE(expected.material_names.size() > 2);
  REQUIRE(std::count(expected.material.begin(), expected.material.end(), 0) <
          static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(expected.size())));

  const auto is_expected = [&](const dem::Packing &made) {
    CHECK(made.centre == expected.centre);
    CHECK(made.material == expected.material);
    CHECK(made.material_names == expected.material_names);
  };
  particles.check_as_part({});
  is_expected(particles.packing());
  CHECK(particles.materials(expected).size() == expected.material_names.size());

  apps::StructureModel structure;
  fill(structure, file);
  is_expected(structure.packing());
  // Links between mortar and aggregate are half as stiff as those of the mortar, those within an aggregate two and a half times.
  const dem::ElasticNetwork network = structure.network(expected);
  const auto                modulus = [&](const dem::ElasticLink &link) {
    return link.direction.dot(link.stiffness * link.direction) * link.reference / link.area;
  };
  std::size_t seen[3] = {0, 0, 0};
  for (const dem::ElasticLink &link : network.links)
    {
      const std::int32_t one   = expected.material[static_cast<std::size_t>(link.first)],
                         other = expected.material[static_cast<std::size_t>(link.second)];
      const int kind           = one != other ? 2 : one == 0 ? 0 : 1;
      CHECK(modulus(link) == Approx(25e9 * (kind == 0 ? 1.0 : kind == 1 ? 2.5 : 0.5)));
      ++seen[kind];
    }
  CHECK(std::all_of(std::begin(seen), std::end(seen), [](const std::size_t count) { return count > 10; }));

  apps::CoupledModel coupled;
  fill(coupled.particles, file);
  is_expected(coupled.packing());

  const apps::ParticleEventSection event       = strained(file, 1e-5);
  const dem::Packing               handed_over = apps::event_packing(event);
  is_expected(handed_over);
  const auto straining = apps::make_particle_case(event, handed_over, 0);
  while (!straining->finished())
    straining->advance();
  CHECK(straining->outcome().state.position.size() == expected.size());
}

TEST_CASE(
  "Mix: links that are handed over are damaged in mortar and interface alone, by the spheres that their ends lie in",
  "[library][mesoscale]")
{
  const apps_tests::ScratchFolder  folder;
  const auto                       file    = folder.file("packing.txt", apps_tests::uneven_lattice(8));
  const apps::ParticleEventSection event   = strained(file, 3e-4);
  const dem::DiscreteState         state   = handed_over(event).state;
  const dem::Mesostructure         spheres = event.mix.placed_in(event.specimen.box_edges(), false).structure;
  const auto                       is_in   = [&](const std::size_t i) {
    return sphere_around(spheres, state.reference[i], 0.5 * state.radius[i]);
  };
  std::size_t inside = 0, across = 0, between = 0;
  double      of_interface = 0, of_mortar = 0;
  for (std::size_t l = 0; l < state.damage.ends.size(); ++l)
    {
      const auto &[one, other] = state.damage.ends[l];
      const int    first = is_in(one), second = is_in(other);
      const double lost = state.damage.links[l].damage;
      if (first == second && first >= 0)
        {
          CHECK(lost == 0); // five times as strong
          ++inside;
        }
      else if (first != second)
        {
          of_interface += lost;
          ++across;
        }
      else
        {
          of_mortar += lost;
          ++between;
        }
    }
  REQUIRE(inside > 50);
  REQUIRE(across > 50);
  REQUIRE(between > 50);
  CHECK(of_mortar > 0);
  CHECK(of_interface / static_cast<double>(across) > of_mortar / static_cast<double>(between));
}

TEST_CASE("Mix: a specimen that is handed over is stiffer than with its interfaces everywhere, and softer than without",
          "[library][mesoscale]")
{
  const apps_tests::ScratchFolder folder;
  const auto                      file    = folder.file("packing.txt", apps_tests::uneven_lattice(8));
  const auto                      modulus = [&](const double aggregate, const double interface) {
    apps::ParticleEventSection event = strained(file, 2e-5);
    event.mix.aggregates.stiffness   = aggregate;
    event.mix.interface.stiffness    = interface;
    return handed_over(event).stress / 2e-5;
  };
  // The stiffness of a network grows with that of each of its links.
  const double mortar_alone = modulus(1, 1), made = modulus(2.5, 0.5);
  CHECK(made > 1.01 * modulus(1, 0.5));
  CHECK(1.01 * made < modulus(2.5, 1));
  CHECK(modulus(1, 0.5) < mortar_alone);
  CHECK(modulus(2.5, 1) > mortar_alone);
  CHECK(modulus(0.5, 0.5) > 0.5 * mortar_alone); // links of the mortar are whole
  CHECK(made < 2.5 * mortar_alone);
}

TEST_CASE("Mix: particles beside the specimen are of its mortar", "[library][mesoscale]")
{
  const apps_tests::ScratchFolder folder;
  apps::ParticlesModel            model;
  fill(model, folder.file("packing.txt", apps_tests::uneven_lattice(8)));
  apps::AddedParticles &ball = model.more.added.emplace_back();
  ball.name                  = "ball";
  ball.radius                = 2e-3;
  ball.centre                = {8e-3, 8e-3, 20e-3};
  const dem::Packing packing = model.packing();
  REQUIRE(packing.material.size() == packing.size());
  CHECK(packing.material.back() == 0);
  CHECK(*std::max_element(packing.material.begin(), packing.material.end()) > 0);
}

TEST_CASE("Mix: where there is no box for it, it is refused by its entry", "[library][mesoscale]")
{
  const apps_tests::ScratchFolder folder;
  apps::ParticlesModel            model;
  fill(model, folder.file("packing.txt", apps_tests::uneven_lattice(8)));
  model.source.box = {0, 0, 0};
  CHECK_THROWS_WITH(model.check_as_part({}), Contains("Box size") && Contains("aggregates of Mix"));
  model.source.source = apps::SpecimenSection::Source::none;
  CHECK_THROWS_WITH(model.mixed().check({}), Contains("Source") && Contains("no particles"));
}

TEST_CASE("Mix: a plane specimen is a section of concrete, of which as much is aggregate as of the whole",
          "[library][mesoscale]")
{
  dem::Packing discs;
  const int    n = 100;
  for (int i = 0; i < n * n; ++i)
    {
      discs.centre.emplace_back(1e-3 * (i % n + 0.5), 1e-3 * (i / n + 0.5), 0);
      discs.radius.push_back(1e-9); // as points: a shell of half a radius would belong to the mortar
    }
  apps::SpecimenSection plane;
  plane.source = apps::SpecimenSection::Source::file;
  plane.box    = {0.1, 0.1, 0};
  apps::MaterialSection material;
  material.only.choose(mortar());
  double sum = 0;
  for (const std::int64_t seed : {1, 2, 3, 4, 5, 6})
    {
      apps::MixSection mix = aggregates();
      mix.seed             = seed;
      const apps::MixedSpecimen mixed{plane, mix, material, 2};
      mixed.check({});
      mixed.number_part(discs, "discs");
      sum += 1 - static_cast<double>(std::count(discs.material.begin(), discs.material.end(), 0)) / (n * n);
      CHECK_THAT(mixed.figures().reached, WithinAbs(0.3, 0.005));
    }
  CHECK_THAT(sum / 6, WithinAbs(0.3, 0.015)); // Delesse (1847): area for volume
}
