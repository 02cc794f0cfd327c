// The same bits for any number of ranks and threads, with ranges moved and after a restart, on scenes of all sorts: doc/theory/ranks.md, 3.
#include "course_on_ranks.h"
#include "dem/laws/cpm.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

using namespace shared_bodies;
using namespace weak_bonds;

namespace
{
  constexpr std::int64_t steps_between_rows = 25, steps_between_moves = 50;

  struct Scene
  {
    Make                        make;
    std::int64_t                steps; ///< a half of them ends with a row
    std::function<void(Body &)> check; ///< whether what it is for has happened, at its end
  };

  /** Alone: what is kept half way and at the end. */
  struct Course
  {
    Table               first, second; ///< halves
    MemoryState         half, end;
    std::vector<double> read; ///< at the end
  };

  struct Split
  {
    std::size_t  ranks;
    int          threads; ///< of each of them
    std::int64_t moved;   ///< ranges after so many steps; 0: never
  };

  Course alone(const Scene &scene)
  {
    omp_set_num_threads(1);
    const auto body = scene.make();
    Course     of;
    of.first  = go_on(*body, scene.steps / 2, steps_between_rows);
    of.half   = state_of(*body);
    of.second = go_on(*body, scene.steps / 2, steps_between_rows);
    of.end    = state_of(*body);
    of.read   = readings_of(body->specimen());
    scene.check(*body);
    return of;
  }

  /** @param half from which each rank goes on; null: from the start @param keep where to put the state half way, of the first; null: nowhere */
  void compare(const Scene &scene, const Course &whole, const Split &split, const MemoryState *half, MemoryState *keep)
  {
    std::vector<std::string> different(split.ranks);
    rank_threads::run(split.ranks, [&](const std::shared_ptr<dem::Ranks> &ranks) {
      omp_set_num_threads(split.threads);
      std::string &found = different[ranks->rank()];
      const auto   body  = scene.make();
      body->specimen().share_among(ranks, split.moved);
      if (half)
        restore(*half, *body);
      else
        found += difference_of_rows(go_on(*body, scene.steps / 2, steps_between_rows), whole.first);
      if (keep)
        {
          MemoryState now = state_of(*body);
          found += differences(now, whole.half);
          if (ranks->rank() == 0)
            *keep = std::move(now);
        }
      found += difference_of_rows(go_on(*body, scene.steps / 2, steps_between_rows), whole.second);
      found += differences(state_of(*body), whole.end);
      if (readings_of(body->specimen()) != whole.read)
        found += " read at the end";
    });
    INFO(split.ranks << " ranks of " << split.threads << " threads, ranges moved after " << split.moved
                     << " steps (0: never), " << (half ? "resumed" : "from the start"));
    CHECK(different == std::vector<std::string>(split.ranks));
  }

  void check_all_ways(const Scene &scene)
  {
    const Course whole = alone(scene);
    for (const std::size_t ranks : {1, 2, 3, 4, 8})
      for (const int threads : {1, 2})
        compare(scene, whole, {ranks, threads, 0}, nullptr, nullptr);
    for (const std::size_t ranks : {2, 4, 8})
      compare(scene, whole, {ranks, 2, steps_between_moves}, nullptr, nullptr);
    MemoryState of_three;
    compare(scene, whole, {3, 1, steps_between_moves}, nullptr, &of_three);
    for (const std::size_t ranks : {1, 5, 8})
      compare(scene, whole, {ranks, 2, 0}, &of_three, nullptr);
  }

  dem::Counts counts_of(Body &body) { return body.specimen().counts(); }
} // namespace

TEST_CASE("concrete that is pulled apart has the same bits on any ranks and threads", "[dem][ranks][slow]")
{
  check_all_ways({[] { return std::make_unique<Pulled>(32, 200); }, 200,
                  [](Body &body) {
                    CHECK(counts_of(body).particles > 7 * 256); // as many bricks as the most ranks
                    CHECK(counts_of(body).broken > 100);
                  }});
}

TEST_CASE("a cell that is led along legs of stress has the same bits on any ranks and threads", "[dem][ranks][slow]")
{
  check_all_ways({[] { return std::make_unique<CellUnderStress>(); }, 150,
                  [](Body &body) {
                    CHECK(dynamic_cast<CellUnderStress &>(body).test.stresses_at_ends().size() == 1); // in the second
                  }});
}

TEST_CASE("elastic spheres pressed by a plate have the same bits on any ranks and threads", "[dem][ranks][slow]")
{
  check_all_ways({[] { return grains_in_box(elastic_grains(), true); }, 150,
                  [](Body &body) {
                    CHECK(counts_of(body).contacts > 1000);
                    CHECK(counts_of(body).wall_contacts > 90);
                    CHECK(body.specimen().surfaces().at(1).touching > 10); // the plate
                  }});
}

TEST_CASE("concrete of two materials has the same bits on any ranks and threads", "[dem][ranks][slow]")
{
  const auto make = [] {
    dem::CpmParameters mortar    = cluster::concrete();
    mortar.relative_ductility    = 5;
    dem::CpmParameters aggregate = mortar;
    aggregate.normal_modulus *= 2.5;
    aggregate.cohesion *= 5;
    return std::make_unique<Free>(
      thrown_apart(dem::CpmMaterials({{"mortar", mortar, 0}, {"aggregate", aggregate, 5000}}), 3, 0, 5));
  };
  check_all_ways({make, 150, [](Body &body) {
                    const dem::LinkOutput links = body.specimen().links();
                    for (const std::int32_t pair : {0, 1, 2})
                      CHECK(std::count(links.pair.begin(), links.pair.end(), pair) > 5);
                    CHECK(counts_of(body).broken > 100);
                  }});
}

TEST_CASE("a specimen of flat joints has the same bits on any ranks and threads", "[dem][ranks][slow]")
{
  check_all_ways({[] { return std::make_unique<Free>(thrown_apart(flat())); }, 100,
                  [](Body &body) { CHECK(counts_of(body).broken > 100); }});
}

TEST_CASE("clumps that tumble have the same bits on any ranks and threads", "[dem][ranks][slow]")
{
  check_all_ways({tumbling_clumps, 150, [](Body &body) {
                    CHECK(counts_of(body).contacts > 50);
                    CHECK(counts_of(body).wall_contacts > 10);
                  }});
}

namespace
{
  void check_confined(const Confined::Confinement how)
  {
    check_all_ways({[how] { return std::make_unique<Confined>(how); }, 150,
                    [](Body &body) {
                      const dem::LabTest &test = dynamic_cast<Confined &>(body).run.test;
                      CHECK(test.stage() == dem::LabTest::Stage::loading);
                      CHECK(test.reading().confinement > 0.5 * test.parameters().pressure);
                      CHECK(test.reading().stress > test.parameters().pressure);
                    }});
  }
} // namespace

TEST_CASE("a block under servo walls has the same bits on any ranks and threads", "[dem][ranks][slow]")
{
  check_confined(Confined::Confinement::walls);
}

TEST_CASE("a block under a membrane has the same bits on any ranks and threads", "[dem][ranks][slow]")
{
  check_confined(Confined::Confinement::membrane);
}

TEST_CASE("a cylinder in a jacket has the same bits on any ranks and threads", "[dem][ranks][slow]")
{
  check_confined(Confined::Confinement::cylinder);
}
