// The work of a specimen is shared among ranks, and nobody sees it: doc/theory/ranks.md, 7.
#include "base/errors.h"
#include "clusters.h"
#include "course_on_ranks.h"
#include "dem/specimen/rank_shares.h"
#include "dem/specimen/specimen.h"
#include "memory_state.h"
#include "periodic_cell_fixture.h"
#include "rank_threads.h"
#include "shared_bodies.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

using Eigen::Vector3d;
using namespace shared_bodies;
using namespace weak_bonds;

namespace
{
  struct Case
  {
    const char  *name;
    Make         make;
    std::int64_t steps;
    std::size_t  broken = 0; ///< at least
  };

  std::vector<Case> cases()
  {
    const auto three_laws = [] {
      return std::make_unique<Free>(
        thrown_apart(dem::LinkMaterials::by_pair({twice(parallel()), twice(point()), twice(flat())}, {0, 1, 2})));
    };
    return {
      {"concrete that is pulled apart", [] { return std::make_unique<Pulled>(); }, 800, 100},
      {"a cell under stresses", [] { return std::make_unique<CellUnderStress>(); }, 600, 10},
      {"grains that fall into a box", falling_grains, 600, 0},
      {"grains between a spread floor and a lid", grains_under_lid, 300, 0},
      {"clumps that tumble", tumbling_clumps, 500, 0},
      {"three laws in two materials", three_laws, 150, 100},
      {"flat joints", [] { return std::make_unique<Free>(thrown_apart(flat())); }, 150, 100},
      {"parallel bonds in the plane, with emission",
       [] { return std::make_unique<Free>(thrown_apart(parallel(), 2, 2)); }, 200, 100},
      {"a block under servo walls", [] { return std::make_unique<Confined>(Confined::Confinement::walls); }, 300, 0},
      {"concrete with options", [] { return std::make_unique<Free>(thrown_apart(with_options(), 3, 0, 5)); }, 150, 100},
      {"elastic grains that fall into a box", [] { return grains_in_box(elastic_grains(), false); }, 300, 0},
      {"bonds beside a partner", [] { return std::make_unique<Partnered>(); }, 150, 100},
      {"grains in a box that takes steps of its own", [] { return std::make_unique<InShakenBox>(); }, 150, 0}};
  }

  struct Way
  {
    std::size_t  ranks;
    std::int64_t moved; ///< ranges after so many steps; 0: never
    bool         resumed;
  };

  void check_on_ranks(const Case &each, const std::vector<Way> &ways)
  {
    omp_set_num_threads(1);
    const auto alone = each.make();
    alone->advance(each.steps / 2);
    const MemoryState         half = state_of(*alone);
    const std::vector<double> read = readings_of(alone->specimen());
    alone->advance(each.steps - each.steps / 2);
    const MemoryState whole  = state_of(*alone);
    const double      damage = alone->specimen().mean_damage();
    const dem::Counts counts = alone->specimen().counts();
    INFO(each.name << ", " << counts.broken << " broken");
    CHECK(counts.broken >= each.broken);
    for (const Way &way : ways)
      {
        std::vector<std::string>   different(way.ranks);
        std::vector<double>        damages(way.ranks);
        std::vector<dem::RankWork> work;
        rank_threads::run(way.ranks, [&](const std::shared_ptr<dem::Ranks> &ranks) {
          omp_set_num_threads(ranks->rank() == 0 ? 2 : 1);
          const auto body = each.make();
          body->specimen().share_among(ranks, way.moved);
          if (way.resumed)
            restore(half, *body);
          else
            {
              body->advance(each.steps / 2);
              different[ranks->rank()] = differences(half, state_of(*body)); // reading it changes nothing
              if (readings_of(body->specimen()) != read)
                different[ranks->rank()] += " read by all";
            }
          body->advance(each.steps - each.steps / 2);
          damages[ranks->rank()] = body->specimen().mean_damage();
          different[ranks->rank()] += differences(whole, state_of(*body));
          if (const auto shares = body->specimen().shares(); ranks->rank() == 0)
            work = shares;
        });
        INFO(way.ranks << " ranks" << (way.resumed ? ", resumed" : ""));
        CHECK(different == std::vector<std::string>(way.ranks));
        CHECK(damages == std::vector<double>(way.ranks, damage));
        std::int64_t particles = 0, wall_contacts = 0;
        for (const dem::RankWork &of : work)
          {
            particles += of.particles;
            wall_contacts += of.wall_contacts;
          }
        CHECK(particles == static_cast<std::int64_t>(counts.particles));
        CHECK(wall_contacts == static_cast<std::int64_t>(counts.wall_contacts));
      }
  }
} // namespace

TEST_CASE("the work of a specimen shared among ranks leaves it in the same state to the last bit", "[dem][ranks]")
{
  for (const Case &each : cases())
    check_on_ranks(each, {{3, 40, false}});
}

TEST_CASE("the same for other numbers of ranks, and after more steps", "[dem][ranks][slow]")
{
  for (Case each : cases())
    {
      each.steps *= 2;
      check_on_ranks(each, {{2, 0, true}, {4, 0, false}, {5, 30, true}, {8, 50, false}});
    }
}

namespace
{
  struct Memory
  {
    std::vector<dem::RankMemory> at_first, at_work, after_sums, after_all, later, as_read; ///< of each rank
    std::size_t                  written = 0;                                              ///< numbers of a state
  };

  /** A block of bonded spheres at several moments of its run. */
  Memory memory_on(const std::size_t count, const std::function<dem::Specimen()> &make)
  {
    Memory found;
    rank_threads::run(count, [&](const std::shared_ptr<dem::Ranks> &ranks) {
      omp_set_num_threads(1);
      dem::Specimen body = make();
      body.share_among(ranks);
      const auto note = [&](std::vector<dem::RankMemory> &to) {
        if (const auto shares = dem::memory_of_ranks(body); ranks->rank() == 0)
          to = shares;
      };
      body.advance(1);
      note(found.at_first);
      body.advance(19);
      note(found.at_work);
      body.energy();
      body.mean_damage();
      body.counts();
      const MemoryState state   = MemoryState::of(body);
      const std::size_t written = numbers_in(state);
      note(found.after_sums);
      if (ranks->rank() == 0)
        found.written = written;
      body.links();
      note(found.after_all);
      body.advance(20);
      note(found.later);
      dem::Specimen resumed = make();
      resumed.share_among(ranks);
      state.restore(resumed);
      if (const auto shares = dem::memory_of_ranks(resumed); ranks->rank() == 0)
        found.as_read = shares;
    });
    return found;
  }
} // namespace

TEST_CASE(
  "from the first step, or a state read, a rank has memory for its own links and particles, and what it needs to know",
  "[dem][ranks]")
{
  omp_set_num_threads(1);
  const auto make = [] {
    dem::Specimen block(cluster::cubic_lattice(32, 32, 32, 1e-3), cluster::bonded(1.5), cluster::concrete());
    block.set_velocity(0, Vector3d(1, 0, 0), Vector3d::Zero());
    return block;
  };
  dem::Specimen     alone   = make();
  const std::size_t whole   = alone.bytes();
  const std::size_t written = numbers_in(MemoryState::of(alone));
  for (const std::size_t count : {2, 4})
    {
      const std::vector<dem::RankShare> shares = dem::share_out(alone, count);
      const Memory                      memory = memory_on(count, make);
      CHECK(memory.written == written);
      for (std::size_t r = 0; r < count; ++r)
        {
          const auto least = static_cast<double>(dem::least_bytes(alone, shares[r]));
          INFO("rank " << r << " of " << count << ", " << least << " of " << whole << " bytes at least");
          CHECK(least < static_cast<double>(whole) * (count == 2 ? 0.56 : 0.33));
          for (const std::vector<dem::RankMemory> *at :
               {&memory.at_first, &memory.at_work, &memory.after_sums, &memory.later, &memory.as_read})
            {
              CHECK(static_cast<double>((*at)[r].now) >= 0.97 * least);
              CHECK(static_cast<double>((*at)[r].now) <= least + 0.2 * static_cast<double>(whole));
            }
          CHECK(memory.after_all[r].now >= 0.95 * static_cast<double>(whole));
          CHECK(memory.later[r].in_steps == memory.later[r].now);
        }
    }
}

TEST_CASE("a particle linked to its own image, and more ranks than bricks", "[dem][ranks]")
{
  const auto cell = [] {
    auto p             = cluster::bonded(1.5);
    p.physics.periodic = true;
    dem::Specimen specimen(periodic_fixture::eight_spheres(), p, cluster::concrete());
    specimen.set_velocity_gradient(Eigen::Vector3d(30, -5, -5).asDiagonal());
    return std::make_unique<Free>(std::move(specimen));
  };
  check_on_ranks({"eight spheres", cell, 300, 1}, {{2, 7, false}, {3, 0, true}});
}

TEST_CASE("ranks that search for links and contacts together make the specimen of one", "[dem][ranks]")
{
  // Bonded, of 700 particles in three bricks; loose and overlapping, so that contacts are there from the start; a cell of 27 in one brick,
  // particles of which are linked to their own images.
  const auto overlapping = [] {
    dem::Packing packing = bar(700);
    for (double &radius : packing.radius)
      radius *= 1.2;
    return packing;
  };
  struct Made
  {
    const char             *name;
    dem::Packing            packing;
    dem::SpecimenParameters parameters;
    dem::LinkMaterials      materials;
    std::size_t             links; ///< at least
    bool                    overlap;
  };
  for (const Made &made : {Made{"bonded", bar(700), cluster::bonded(1.5), cluster::concrete(), 1000, false},
                           Made{"loose", overlapping(), grains::falling(), grains::rough(), 0, true},
                           Made{"a cell", periodic_fixture::disordered(3, 7), periodic_fixture::concrete_specimen(),
                                periodic_fixture::brittle_concrete(), 100, false}})
    {
      dem::Specimen     alone(made.packing, made.parameters, made.materials);
      const dem::Counts counts = alone.counts();
      CHECK(counts.links >= made.links);
      CHECK((counts.deepest_overlap > 0) == made.overlap);
      const MemoryState whole = MemoryState::of(alone);
      for (const std::size_t count : {2, 3, 5})
        {
          std::vector<char> same(count, 0);
          rank_threads::run(count, [&](const std::shared_ptr<dem::Ranks> &ranks) {
            dem::Specimen body(made.packing, made.parameters, made.materials, ranks.get());
            same[ranks->rank()] = MemoryState::of(body) == whole && body.time_step() == alone.time_step();
          });
          INFO(made.name << " on " << count << " ranks");
          CHECK(same == std::vector<char>(count, 1));
        }
    }
}

TEST_CASE("an audit names a link of which a rank has another copy than the rank that it belongs to", "[dem][ranks]")
{
  const auto pulled_by_two = [](const double modulus_of_second) {
    rank_threads::run(2, [&](const std::shared_ptr<dem::Ranks> &ranks) {
      auto material = cluster::concrete();
      if (ranks->rank() == 1)
        material.normal_modulus = modulus_of_second;
      dem::Specimen specimen(bar(700), cluster::bonded(1.5), material);
      specimen.share_among(ranks, 1000); // as in tests that move ranges
      specimen.set_velocity(399, Vector3d(0.1, 0, 0), Vector3d::Zero());
      specimen.advance(20);
    });
  };
  const double modulus = cluster::concrete().normal_modulus;
  CHECK_NOTHROW(pulled_by_two(modulus));
  CHECK_THROWS_WITH(pulled_by_two((1 + 1e-9) * modulus),
                    Catch::Contains("audit of ranks: rank") && Catch::Contains("the one between particles"));
}

TEST_CASE("where one rank finds no number, all stop by the same words", "[dem][ranks]")
{
  for (const std::size_t owner : {0, 1, 2})
    {
      std::vector<std::string> words(3);
      std::vector<std::size_t> owners(3);
      rank_threads::run(3, [&](const std::shared_ptr<dem::Ranks> &ranks) {
        dem::Specimen     specimen(bar(700), cluster::bonded(1.5), cluster::concrete());
        const std::size_t particle = first_particle_of(specimen, owner, 3);
        owners[ranks->rank()]      = first_owner_of(specimen, particle, 3);
        specimen.share_among(ranks);
        specimen.set_velocity(particle, Vector3d(std::numeric_limits<double>::quiet_NaN(), 0, 0), Vector3d::Zero());
        try
          {
            specimen.advance(3);
          }
        catch (const base::NumericalError &error)
          {
            words[ranks->rank()] = error.what();
          }
      });
      INFO("particle of rank " << owner);
      CHECK(owners == std::vector<std::size_t>(3, owner));
      CHECK_THAT(words[0], Catch::Contains("no longer has a finite velocity"));
      CHECK(words == std::vector<std::string>(3, words[0]));
    }
}
