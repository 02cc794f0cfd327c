// Grown packings that are kept from run to run.
#include "apps/specimens/genesis_cache.h"

#include "dem/genesis/sizes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <functional>
#include <limits>
#include <set>
#include <vector>

using namespace apps_tests;

namespace
{
  namespace fs = std::filesystem;

  dem::GenesisParameters mortar(const std::uint64_t seed = 1)
  {
    const std::vector<dem::SizeClass> classes = {{0.5, 1.2e-3, 1.2e-3}, {0.5, 3e-3, 3e-3}};
    dem::GenesisParameters            p;
    p.vessel.size                           = {0.012, 0.012, 0};
    p.material.contact.effective_modulus    = 8e9;
    p.material.contact.friction_coefficient = 0.1;
    p.radii         = dem::draw_radii(classes, dem::class_counts(classes, p.vessel.space(), 0.1, 2), seed);
    p.seed          = seed;
    p.stress        = 27500;
    p.increments    = 10;
    p.stress_rounds = 2;
    p.solve_steps   = 500;
    return p;
  }

  dem::Genesis finished(const dem::GenesisParameters &p)
  {
    dem::Genesis genesis(p);
    genesis.advance(std::numeric_limits<std::int64_t>::max() / 2);
    return genesis;
  }
} // namespace

TEST_CASE("A genesis comes out of the cache to the last bit, with all that its stages have reached",
          "[apps][genesis][packing_cache]")
{
  const ScratchFolder      folder;
  const apps::GenesisCache cache(apps::CacheFolder(folder / "not" / "there" / "yet"));
  dem::Genesis             made = finished(mortar()), taken(mortar());
  CHECK_FALSE(cache.has(mortar()));
  CHECK_FALSE(apps::finish_as_kept(cache, taken, mortar()));
  CHECK_FALSE(taken.finished());
  cache.keep(made, mortar());
  CHECK(cache.has(mortar()));
  REQUIRE(apps::finish_as_kept(cache, taken, mortar()));
  CHECK(taken.finished());
  CHECK(taken.steps() == made.steps());
  CHECK(taken.packing().centre == made.packing().centre);
  CHECK(taken.packing().radius == made.packing().radius);
  CHECK(taken.energies().growth == made.energies().growth);
  CHECK(taken.energies().error() == made.energies().error());
  REQUIRE(taken.reports().size() == made.reports().size());
  for (std::size_t i = 0; i < made.reports().size(); ++i)
    {
      CHECK(taken.reports()[i].stage == made.reports()[i].stage);
      CHECK(taken.reports()[i].stress == made.reports()[i].stress);
      CHECK(taken.reports()[i].scale == made.reports()[i].scale);
    }

  // What is damaged is as if it were not there.
  fs::resize_file(cache.file_of(mortar()), fs::file_size(cache.file_of(mortar())) / 2);
  CHECK_FALSE(cache.has(mortar()));
}

TEST_CASE("Every parameter of a genesis distinguishes it from others in the cache", "[apps][genesis][packing_cache]")
{
  using P                                               = dem::GenesisParameters;
  const std::vector<std::function<void(P &)>> different = {
    [](P &p) { p.vessel.dimension = 3; },
    [](P &p) { p.vessel.shape = dem::Vessel::Shape::cylinder; },
    [](P &p) { p.vessel.size.x() += 1e-12; },
    [](P &p) { p.vessel.size.y() += 1e-12; },
    [](P &p) { p.vessel.size.z() += 1e-12; },
    [](P &p) { p.material.contact.effective_modulus += 1; },
    [](P &p) { p.material.contact.stiffness_ratio += 1e-9; },
    [](P &p) { p.material.contact.friction_coefficient += 1e-9; },
    [](P &p) { p.material.contact.normal_force = dem::NormalForce::incremental; },
    [](P &p) { p.material.contact.restitution -= 1e-9; },
    [](P &p) { p.material.damping += 1e-9; },
    [](P &p) { p.material.thickness += 1e-9; },
    [](P &p) { p.radii.back() += 1e-15; },
    [](P &p) { p.radii.pop_back(); },
    [](P &p) { ++p.seed; },
    [](P &p) { p.growth_friction += 1e-9; },
    [](P &p) { ++p.increments; },
    [](P &p) { p.increment_ratio += 1e-9; },
    [](P &p) { ++p.increment_steps; },
    [](P &p) { p.ratio += 1e-9; },
    [](P &p) { ++p.solve_steps; },
    [](P &p) { p.stress += 1e-6; },
    [](P &p) { p.stress_tolerance += 1e-9; },
    [](P &p) { ++p.stress_rounds; },
    [](P &p) { p.fit_floaters = !p.fit_floaters; },
    [](P &p) { ++p.floater_contacts; },
    [](P &p) { p.floaters_allowed += 1e-9; },
    [](P &p) { ++p.floater_rounds; },
  };
  const apps::GenesisCache cache(apps::CacheFolder("/nowhere"));
  std::set<fs::path>       names = {cache.file_of(mortar())};
  for (const auto &change : different)
    {
      P p = mortar();
      change(p);
      names.insert(cache.file_of(p));
    }
  CHECK(names.size() == different.size() + 1);
}
