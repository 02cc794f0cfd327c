// What others report of particles on ranks: links to own images lost where a cell is thin, breaks lost at a checkpoint, histories that reading
// changes: doc/theory/ranks.md, 3.
#include "course_on_ranks.h"
#include "dem/observation/crack.h"
#include "dem/observation/state_columns.h"
#include "dem/specimen/rank_output.h"
#include "dem/specimen/told_to_first.h"
#include "periodic_cell_fixture.h"
#include "shown_bodies.h"

#include <catch2/catch.hpp>

#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace shown_bodies;

namespace
{
  constexpr int edge = 20; // particles

  /** A layer of spheres, one thick, in a cell along whose short edge each of them is linked to its own image. */
  dem::Packing layer()
  {
    constexpr double   spacing = 1.9e-3;
    dem::UniformRandom random(9);
    dem::Packing       packing;
    for (int i = 0; i < edge * edge; ++i)
      {
        packing.centre.emplace_back(spacing *
                                    (Vector3d(i % edge, i / edge, 0) + 0.15 * cluster::random_vector(random)));
        packing.radius.push_back(1e-3);
      }
    packing.periodic_cell = spacing * Vector3d(edge, edge, 1);
    return packing;
  }

  /** It grows thicker, so that these links break. */
  struct ThinCell : Body
  {
    ThinCell()
      : own(layer(), periodic_fixture::concrete_specimen(), periodic_fixture::brittle_concrete())
    {
      own.set_velocity_gradient(Vector3d(10, -5, 120).asDiagonal());
    }
    dem::Specimen &specimen() override { return own; }
    void           advance(const std::int64_t steps) override { own.advance(steps); }
    dem::Specimen  own;
  };

  /** Links of particles to images of themselves, whole and broken. */
  struct OwnImages
  {
    std::vector<std::size_t> whole, broken; ///< the particles
  };

  OwnImages own_images(Body &body)
  {
    const dem::LinkOutput links = body.specimen().links();
    OwnImages             found;
    for (std::size_t l = 0; l < links.ends.size(); ++l)
      if (links.ends[l][0] == links.ends[l][1])
        (links.kind[l] == dem::LinkOutput::broken ? found.broken : found.whole).push_back(links.ends[l][0]);
    return found;
  }
} // namespace

TEST_CASE("particles of a cell of two bricks that are linked to their own images break from these on any ranks",
          "[dem][ranks]")
{
  constexpr std::int64_t steps = 400;
  omp_set_num_threads(1);
  ThinCell alone;
  CHECK(own_images(alone).whole.size() == edge * edge);
  for (const std::size_t ranks : {2, 3})
    {
      std::set<std::size_t> owners;
      for (std::size_t i = 0; i < edge * edge; ++i)
        owners.insert(first_owner_of(alone.own, i, ranks));
      CHECK(owners.size() == 2); // as there are bricks
    }
  const Table       rows = go_on(alone, steps, 20);
  const MemoryState end  = state_of(alone);
  CHECK(own_images(alone).broken.size() == edge * edge);
  CHECK(alone.specimen().counts().broken > edge * edge + 10);
  for (const auto &[ranks, moved] : {std::pair(2, 0), std::pair(2, 50), std::pair(3, 0), std::pair(3, 50)})
    {
      std::vector<std::string> different(static_cast<std::size_t>(ranks));
      rank_threads::run(different.size(), [&, every = moved](const std::shared_ptr<dem::Ranks> &of) {
        omp_set_num_threads(1);
        ThinCell body;
        body.own.share_among(of, every);
        different[of->rank()] = difference_of_rows(go_on(body, steps, 20), rows);
        different[of->rank()] += differences(state_of(body), end);
      });
      INFO(ranks << " ranks, ranges moved after " << moved << " steps (0: never)");
      CHECK(different == std::vector<std::string>(different.size()));
    }
}

namespace
{
  /** A step in which links break, of which some belong to another rank than the first. */
  struct BreakingStep
  {
    std::int64_t step = 0; ///< after it the links are broken
    MemoryState  after;
  };

  /** Alone, step by step. @param after_step to begin with @param further steps until the end @param end its state */
  BreakingStep breaking_step(Body &body, const std::int64_t after_step, const std::int64_t further, MemoryState &end)
  {
    dem::Specimen &own    = body.specimen();
    std::size_t    broken = 0, logged = 0;
    for (bool elsewhere = false; !elsewhere;)
      {
        REQUIRE(own.steps() < 2000);
        broken = own.counts().broken;
        logged = own.logged_breaks();
        body.advance(1);
        if (own.steps() < after_step || own.counts().broken == broken)
          continue;
        for (const dem::Break &each : own.breaks(logged))
          elsewhere = elsewhere || first_owner_of(own, static_cast<std::size_t>(each.ends[0]), 3) > 0;
      }
    CHECK(own.counts().broken > broken);
    BreakingStep found{own.steps(), state_of(body)};
    for (std::int64_t s = 0; s < further; ++s)
      body.advance(1);
    end = state_of(body);
    return found;
  }
} // namespace

TEST_CASE("links that break in the step before a checkpoint are broken in it, on any ranks", "[dem][ranks]")
{
  constexpr std::int64_t further        = 30;
  const auto             parallel_bonds = [] { return std::make_unique<Free>(thrown_apart(parallel())); };
  for (const auto &[name, make, from] :
       {std::tuple("concrete", Make([] { return std::make_unique<Pulled>(16, 200); }), 100),
        std::tuple("parallel bonds", Make(parallel_bonds), 20),
        std::tuple("a cell", Make([] { return std::make_unique<ThinCell>(); }), 20)})
    {
      INFO(name);
      omp_set_num_threads(1);
      MemoryState        end;
      const auto         body = make();
      const BreakingStep at   = breaking_step(*body, from, further, end);
      INFO("after step " << at.step);
      for (const std::int64_t moved : {0, 40})
        {
          MemoryState              kept;
          std::vector<std::string> different(3);
          rank_threads::run(3, [&, &make = make](const std::shared_ptr<dem::Ranks> &ranks) {
            omp_set_num_threads(1);
            const auto shared = make();
            shared->specimen().share_among(ranks, moved);
            for (std::int64_t s = 0; s < at.step; ++s)
              shared->advance(1);
            MemoryState now          = state_of(*shared); // nothing is read before
            different[ranks->rank()] = differences(now, at.after);
            if (ranks->rank() == 0)
              kept = std::move(now);
            for (std::int64_t s = 0; s < further; ++s)
              shared->advance(1);
            different[ranks->rank()] += differences(state_of(*shared), end);
          });
          INFO("written on three ranks, ranges moved after " << moved << " steps (0: never)");
          CHECK(different == std::vector<std::string>(3));
          for (const std::size_t count : {1, 2, 5})
            {
              std::vector<std::string> resumed(count);
              rank_threads::run(count, [&, &make = make](const std::shared_ptr<dem::Ranks> &ranks) {
                omp_set_num_threads(1);
                const auto shared = make();
                shared->specimen().share_among(ranks, moved);
                restore(kept, *shared);
                for (std::int64_t s = 0; s < further; ++s)
                  shared->advance(1);
                resumed[ranks->rank()] = differences(state_of(*shared), end);
              });
              INFO("resumed on " << count);
              CHECK(resumed == std::vector<std::string>(count));
            }
        }
    }
}

namespace
{
  /** All that a run may write or show: tables, a state, pictures in one file and in pieces, what ranks have. */
  void read_all(Body &body, const dem::Ranks &ranks)
  {
    const dem::Specimen &specimen = body.specimen();
    row_of(body);
    state_of(body);
    readings_of(specimen);
    dem::RankOutput(specimen, ranks.rank(), ranks.size());
    dem::each_column(specimen, [](dem::StateColumn, const std::vector<double> &) {});
    dem::all_particles_for_first(specimen);
    dem::shown_links_for_first(specimen);
    dem::damaged_links_for_first(specimen);
    dem::measure_crack(specimen);
    specimen.shares();
    dem::memory_of_ranks(specimen);
    specimen.kinematics();
    specimen.particle(0);
    specimen.breaks();
    specimen.broken_links_of({0, 1, 2});
    specimen.force_ratio();
  }
} // namespace

TEST_CASE("what ranks write and show changes nothing of what comes", "[dem][ranks][slow]")
{
  const auto of_three_laws = [] {
    return std::make_unique<Free>(
      thrown_apart(dem::LinkMaterials::by_pair({twice(parallel()), twice(point()), twice(flat())}, {0, 1, 2})));
  };
  const auto pulled   = [] { return std::make_unique<Pulled>(16, 200); };
  const auto pressed  = [] { return grains_in_box(elastic_grains(), true); };
  const auto in_cell  = [] { return std::make_unique<CellUnderStress>(); };
  const auto confined = [] { return std::make_unique<Confined>(Confined::Confinement::membrane); };
  for (const Case &each :
       {Case{"concrete", pulled, 160}, Case{"three laws", of_three_laws, 80}, Case{"spheres", pressed, 120},
        Case{"clumps", tumbling_clumps, 120}, Case{"a cell", in_cell, 120}, Case{"under a membrane", confined, 120}})
    {
      omp_set_num_threads(1);
      const auto body = each.make();
      for (std::int64_t s = 0; s < each.steps; s += 10)
        body->advance(10);
      const MemoryState alone = state_of(*body);
      for (const std::int64_t moved : {0, 50})
        for (const bool silent : {true, false})
          {
            std::vector<std::string> different(3);
            rank_threads::run(3, [&](const std::shared_ptr<dem::Ranks> &ranks) {
              omp_set_num_threads(1);
              const auto shared = each.make();
              shared->specimen().share_among(ranks, moved);
              for (std::int64_t s = 0; s < each.steps; s += 10)
                {
                  shared->advance(10);
                  if (!silent && (s < each.steps / 2 || s % 30 == 0)) // what is read often, ranks keep
                    read_all(*shared, *ranks);
                }
              different[ranks->rank()] = differences(state_of(*shared), alone);
            });
            INFO(each.name << (silent ? ", nothing read" : ", all read") << ", ranges moved after " << moved
                           << " steps (0: never)");
            CHECK(different == std::vector<std::string>(3));
          }
    }
}
