// The work of a specimen is shared among ranks, and nobody sees it: doc/theory/ranks.md, 7.
#include "base/errors.h"
#include "clusters.h"
#include "dem/specimen/core.h"
#include "dem/specimen/rank_shares.h"
#include "dem/specimen/specimen.h"
#include "memory_state.h"
#include "periodic_cell_fixture.h"
#include "rank_threads.h"
#include "shared_bodies.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

using Eigen::Vector3d;
using namespace shared_bodies;
using namespace weak_bonds;

namespace
{
  /** All of a state, by name. */
  using State = std::map<std::string, std::vector<double>>;

  class StateKeeper : public base::StateVisitor
  {
  public:
    explicit StateKeeper(State &where)
      : state(where)
    {
    }
    void column(const std::string &name, base::Column &values) override
    {
      state[name].assign(values.begin(), values.end());
    }
    void column(const std::string &name, std::vector<std::int32_t> &values) override
    {
      state[name].assign(values.begin(), values.end());
    }
    void scalar(const std::string &name, double &value) override { state[name] = {value}; }
    void scalar(const std::string &name, std::int64_t &value) override { state[name] = {static_cast<double>(value)}; }

  private:
    State &state;
  };

  class StateGiver : public base::StateVisitor
  {
  public:
    explicit StateGiver(const State &from)
      : state(from)
    {
    }
    void column(const std::string &name, base::Column &values) override
    {
      values.assign(state.at(name).begin(), state.at(name).end());
    }
    void column(const std::string &name, std::vector<std::int32_t> &values) override
    {
      values.assign(state.at(name).begin(), state.at(name).end());
    }
    void scalar(const std::string &name, double &value) override { value = state.at(name).front(); }
    void scalar(const std::string &name, std::int64_t &value) override
    {
      value = static_cast<std::int64_t>(state.at(name).front());
    }

  private:
    const State &state;
  };

  State state_of(Body &body)
  {
    State       state;
    StateKeeper keeper(state);
    body.visit(keeper);
    return state;
  }

  /** Which parts differ. */
  std::string differences(const State &a, const State &b)
  {
    std::string names;
    for (const auto &[name, values] : a)
      if (b.count(name) == 0 || b.at(name) != values)
        names += " " + name;
    return names + (a.size() == b.size() ? "" : " (others)");
  }

  /** What is read of a specimen from outside, in a row. */
  std::vector<double> readings_of(const dem::ObservedSpecimen &specimen)
  {
    const dem::EnergyAccount e = specimen.energy();
    const dem::Counts        n = specimen.counts();
    std::vector<double>      row{e.external_work,
                            e.gravity,
                            e.initial,
                            e.kinetic,
                            e.elastic,
                            e.damage,
                            e.friction,
                            e.damping,
                            e.released,
                            n.deepest_overlap,
                            specimen.stable_step(),
                            specimen.mean_damage(),
                            specimen.unbalanced_ratio()};
    for (const std::size_t count : {n.links, n.contacts, n.broken, n.wall_contacts})
      row.push_back(static_cast<double>(count));
    const auto     append = [&](const auto &numbers) { row.insert(row.end(), numbers.begin(), numbers.end()); };
    const Vector3d force  = specimen.force_on({0, 1, 2, 3, 4, 5, 6, 7});
    append(std::vector<double>(force.data(), force.data() + 3));
    const dem::ParticleOutput particles = specimen.particles();
    append(particles.damage);
    for (std::size_t i = 0; i < particles.position.size(); ++i)
      {
        append(std::vector<double>(particles.position[i].data(), particles.position[i].data() + 3));
        append(std::vector<double>(particles.velocity[i].data(), particles.velocity[i].data() + 3));
        append(std::vector<double>(particles.stress[i].data(), particles.stress[i].data() + 9));
      }
    const dem::LinkOutput links = specimen.links();
    append(links.normal_force);
    append(links.damage);
    return row;
  }

  struct Case
  {
    const char  *name;
    Make         make;
    std::int64_t steps;
    std::size_t  broken; ///< at least
  };

  std::vector<Case> cases()
  {
    const auto three_laws = [] {
      return std::make_unique<Free>(
        thrown_apart(dem::LinkMaterials::by_pair({twice(parallel()), twice(point()), twice(flat())}, {0, 1, 2})));
    };
    return {{"concrete that is pulled apart", [] { return std::make_unique<Pulled>(); }, 800, 100},
            {"a cell under stresses", [] { return std::make_unique<CellUnderStress>(); }, 600, 10},
            {"grains that fall into a box", falling_grains, 600, 0},
            {"grains between a spread floor and a lid", grains_under_lid, 300, 0},
            {"clumps that tumble", tumbling_clumps, 500, 0},
            {"three laws in two materials", three_laws, 150, 100},
            {"flat joints", [] { return std::make_unique<Free>(thrown_apart(flat())); }, 150, 100},
            {"parallel bonds in the plane, with emission",
             [] { return std::make_unique<Free>(thrown_apart(parallel(), 2, 2)); }, 200, 100},
            {"a block under servo walls", [] { return std::make_unique<Confined>(); }, 300, 0},
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
    const State               half = state_of(*alone);
    const std::vector<double> read = readings_of(alone->specimen());
    alone->advance(each.steps - each.steps / 2);
    const State       whole  = state_of(*alone);
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
            {
              StateGiver giver(half);
              body->visit(giver);
            }
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
    std::vector<dem::RankMemory> at_first, at_work, after_sums, after_all, later; ///< of each rank
    std::size_t                  written = 0;                                     ///< numbers of a state
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
      State       state;
      StateKeeper keeper(state);
      body.visit_state(keeper);
      note(found.after_sums);
      if (ranks->rank() == 0)
        for (const auto &[name, values] : state)
          found.written += values.size();
      body.links();
      note(found.after_all);
      body.advance(20);
      note(found.later);
    });
    return found;
  }
} // namespace

TEST_CASE("from the first step a rank has memory for its own links, particles, copies and ghosts, and what all know",
          "[dem][ranks]")
{
  omp_set_num_threads(1);
  const auto make = [] {
    dem::Specimen block(cluster::cubic_lattice(32, 32, 32, 1e-3), cluster::bonded(1.5), cluster::concrete());
    block.set_velocity(0, Vector3d(1, 0, 0), Vector3d::Zero());
    return block;
  };
  dem::Specimen     alone = make();
  const std::size_t whole = alone.bytes();
  State             state;
  StateKeeper       keeper(state);
  alone.visit_state(keeper);
  std::size_t written = 0;
  for (const auto &[name, values] : state)
    written += values.size();
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
               {&memory.at_first, &memory.at_work, &memory.after_sums, &memory.later})
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

TEST_CASE("what a link does depends on no other link in its pack", "[dem][ranks]")
{
  omp_set_num_threads(1);
  const dem::LinkMaterials all[] = {cluster::concrete(), parallel(), point(), flat()};
  for (const dem::LinkMaterials &materials : all)
    {
      dem::SpecimenParameters p  = cluster::bonded(1.2);
      p.step_factor              = 0.1;
      const dem::Packing packing = bar(200);
      dem::SpecimenCore  core(packing, p, materials, nullptr);
      INFO(core.bond_law->name());
      for (std::size_t i = 0; i < packing.size(); ++i)
        for (int c = 0; c < 3; ++c)
          core.particles.velocity[dem::record_size * i + static_cast<std::size_t>(c)] =
            2000 * core.particles.pose_of(i)[c] + (c == 1 ? 8000 * core.particles.pose_of(i)[0] : 0);
      core.begin();
      for (int step = 0; step < 100; ++step)
        core.step();
      const base::Column &remembered = core.bonds.history.front();
      REQUIRE((core.cracks.count() > 20 ||
               std::any_of(remembered.begin(), remembered.end(), [](const double number) { return number > 0; })));

      // The same links in another order.
      dem::LinkSet            &links = core.bonds;
      std::vector<std::size_t> order(links.count);
      std::iota(order.begin(), order.end(), 0);
      std::shuffle(order.begin(), order.end(), std::mt19937(3));
      dem::LinkSet shuffled = links.empty_like();
      shuffled.resize(links.count, core.particles.count);
      for (std::size_t l = 0; l < links.count; ++l)
        shuffled.copy_line(links, order[l], l);
      core.bond_pass(links, core.particles, *core.bond_law, links.whole());
      core.bond_pass(shuffled, core.particles, *core.bond_law, shuffled.whole());
      std::size_t different = 0;
      for (std::size_t l = 0; l < links.count; ++l)
        {
          if (!links.is_alive(order[l]))
            continue;
          std::vector<double> row, other;
          links.get_history(order[l], row);
          shuffled.get_history(l, other);
          different += row != other || !std::equal(&shuffled.force[dem::record_size * l],
                                                   &shuffled.force[dem::record_size * l] + dem::record_size,
                                                   &links.force[dem::record_size * order[l]]);
        }
      CHECK(different == 0);
    }
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
  std::vector<std::string> words(3);
  rank_threads::run(3, [&](const std::shared_ptr<dem::Ranks> &ranks) {
    dem::Specimen specimen(bar(700), cluster::bonded(1.5), cluster::concrete());
    specimen.share_among(ranks);
    specimen.set_velocity(399, Vector3d(std::numeric_limits<double>::quiet_NaN(), 0, 0), Vector3d::Zero());
    try
      {
        specimen.advance(3);
      }
    catch (const base::NumericalError &error)
      {
        words[ranks->rank()] = error.what();
      }
  });
  CHECK_THAT(words[0], Catch::Contains("no longer has a finite velocity"));
  CHECK(words == std::vector<std::string>(3, words[0]));
}
