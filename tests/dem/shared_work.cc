// The work of a specimen is shared among ranks, and nobody sees it: doc/theory/ranks.md, 7.
#include "base/errors.h"
#include "clusters.h"
#include "dem/facets/shapes.h"
#include "dem/facets/surface.h"
#include "dem/laboratory/lab_test.h"
#include "dem/laws/contact_bond.h"
#include "dem/laws/flat_joint.h"
#include "dem/laws/linear_contact.h"
#include "dem/laws/parallel_bond.h"
#include "dem/loading/periodic_cell.h"
#include "dem/loading/uniaxial.h"
#include "dem/packing/lattice.h"
#include "dem/specimen/core.h"
#include "dem/specimen/specimen.h"
#include "laboratory_fixture.h"
#include "periodic_cell_fixture.h"
#include "rank_threads.h"

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

  /** A specimen in a test of some kind. */
  struct Body
  {
    virtual ~Body()                              = default;
    virtual dem::Specimen &specimen()            = 0;
    virtual void           advance(std::int64_t) = 0;
    virtual void           visit(base::StateVisitor &visitor) { specimen().visit_state(visitor); }
  };
  using Make = std::function<std::unique_ptr<Body>()>;

  /** Left to itself. */
  struct Free : Body
  {
    explicit Free(dem::Specimen &&given)
      : own(std::move(given))
    {
    }
    dem::Specimen &specimen() override { return own; }
    void           advance(const std::int64_t steps) override { own.advance(steps); }
    dem::Specimen  own;
  };

  dem::Packing bar(const std::size_t particles) { return cluster::random_cluster(5, particles, 0.7e-3, 1e-3); }

  struct Pulled : Body
  {
    Pulled()
      : own(
          cluster::cubic_lattice(8, 8, 16, 1e-3),
          [] {
            auto p             = cluster::bonded(1.5);
            p.physics.contacts = true;
            p.damping          = 0.1;
            return p;
          }(),
          cluster::concrete())
      , test(own, [] {
        dem::UniaxialParameters p;
        p.axis            = 2;
        p.strain_rate     = 60;
        p.grips.thickness = 2e-3;
        p.stop_strain     = 1;
        p.lateral_blocked = false;
        return p;
      }())
    {
    }
    dem::Specimen &specimen() override { return own; }
    void           advance(const std::int64_t steps) override { test.advance(steps); }
    void           visit(base::StateVisitor &visitor) override
    {
      own.visit_state(visitor);
      test.visit_state(visitor);
    }
    dem::Specimen     own;
    dem::UniaxialTest test;
  };

  struct CellUnderStress : Body
  {
    static dem::Packing packing()
    {
      dem::Packing       p = dem::make_lattice(dem::Lattice::face_centred_cubic, 1e-3, {6, 6, 6});
      dem::UniformRandom random(2);
      for (double &radius : p.radius)
        radius *= 1 - 0.1 * random();
      return p;
    }
    static dem::CellTestParameters path(const double dt)
    {
      dem::CellTestParameters p;
      dem::CellLeg            press, pull;
      press.duration     = 100 * dt;
      press.stress_given = {{true, true, true, true, true, true}};
      press.target << -1e6, -1e6, -1e6, 0, 0, 0;
      pull.duration     = 2000 * dt;
      pull.stress_given = {{true, true, false, true, true, true}};
      pull.target << -1e6, -1e6, 2e-2, 0, 0, 0;
      p.path = {press, pull};
      return p;
    }
    CellUnderStress()
      : own(
          packing(),
          [] {
            auto p             = cluster::bonded(1.2);
            p.physics.periodic = true;
            return p;
          }(),
          cluster::concrete())
      , test(own, path(own.time_step()))
    {
    }
    dem::Specimen &specimen() override { return own; }
    void           advance(const std::int64_t steps) override { test.advance(steps); }
    void           visit(base::StateVisitor &visitor) override
    {
      own.visit_state(visitor);
      test.visit_state(visitor);
    }
    dem::Specimen own;
    dem::CellTest test;
  };

  /** Loose grains fall into a box and on each other, with friction. */
  std::unique_ptr<Body> falling_grains()
  {
    dem::LinearContactParameters grains;
    grains.effective_modulus    = 1e8;
    grains.stiffness_ratio      = 1.5;
    grains.friction_coefficient = 0.5;
    dem::SpecimenParameters parameters;
    parameters.density           = 2600;
    parameters.interaction_ratio = 1;
    parameters.damping           = 0.2;
    parameters.gravity           = {0, 0, -9.81};
    dem::Packing       packing   = cluster::cubic_lattice(10, 10, 10, 1e-3);
    dem::UniformRandom random(3);
    for (Vector3d &x : packing.centre)
      x = 1.005 * x + Vector3d(1.1e-3, 1.1e-3, 1.1e-3) + 2e-5 * cluster::random_vector(random);
    dem::Specimen          specimen(packing, parameters, grains);
    dem::SurfaceParameters box;
    box.name    = "box";
    box.mesh    = dem::box(Vector3d(0, 0, 0), Vector3d(0.0215, 0.0215, 1), {true, true, true, true, true, false});
    box.contact = grains;
    specimen.surfaces().add(box);
    for (std::size_t i = 0; i < packing.size(); ++i)
      specimen.set_velocity(i, Vector3d(2, 0, -5), Vector3d::Zero());
    return std::make_unique<Free>(std::move(specimen));
  }

  /** Dumb-bells of two that fall into a box, each thrown and turned in its own way. */
  std::unique_ptr<Body> tumbling_clumps()
  {
    dem::LinearContactParameters grains;
    grains.effective_modulus    = 1e8;
    grains.stiffness_ratio      = 1.5;
    grains.friction_coefficient = 0.5;
    dem::SpecimenParameters parameters;
    parameters.density           = 2600;
    parameters.interaction_ratio = 1;
    parameters.damping           = 0.2;
    parameters.gravity           = {0, 0, -9.81};
    dem::Packing       packing   = cluster::cubic_lattice(8, 8, 12, 1e-3);
    dem::UniformRandom random(4);
    for (Vector3d &x : packing.centre)
      x = 1.05 * x + Vector3d(1.5e-3, 1.5e-3, 1.5e-3);
    dem::Specimen specimen(packing, parameters, grains);
    const double  mass = 2600 * 4 / 3 * 3.141592653589793 * 1e-9;
    for (std::size_t i = 0; i + 64 < packing.size(); i += 128)
      for (std::size_t k = i; k < i + 64; ++k)
        {
          dem::RigidClump clump;
          clump.particles = {k, k + 64};
          clump.mass      = 2 * mass;
          clump.centre    = 0.5 * (packing.centre[k] + packing.centre[k + 64]);
          clump.inertia   = mass * Vector3d(3e-6, 3e-6, 0.8e-6).asDiagonal();
          specimen.clumps().add(clump);
        }
    dem::SurfaceParameters box;
    box.name    = "box";
    box.mesh    = dem::box(Vector3d(0, 0, 0), Vector3d(0.019, 0.019, 1), {true, true, true, true, true, false});
    box.contact = grains;
    specimen.surfaces().add(box);
    std::vector<dem::AskedVelocity> asked;
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        asked.emplace_back();
        asked.back().particle = i;
        asked.back().given    = {{true, true, true, true, true, true}};
        asked.back().velocity = Vector3d(0, 0, -4) + 2 * cluster::random_vector(random);
      }
    specimen.set_velocities(asked);
    return std::make_unique<Free>(std::move(specimen));
  }

  dem::Specimen thrown_apart(const dem::LinkMaterials &materials, const int dimension = 3, const double emission = 0)
  {
    dem::SpecimenParameters p = cluster::bonded(1.2);
    p.step_factor             = 0.1;
    p.physics.dimension       = dimension;
    p.thickness               = dimension == 2 ? 1e-3 : 0;
    p.emission_reach          = emission;
    dem::Packing body = dimension == 3 ? bar(700) : dem::make_lattice(dem::Lattice::hexagonal, 1e-3, {30, 20, 1});
    body.periodic_cell.reset();
    if (materials.several())
      for (const auto &x : body.centre)
        body.material.push_back(x.x() > 0 ? 1 : 0);
    dem::Specimen specimen(body, p, materials);
    for (std::size_t i = 0; i < body.size(); ++i)
      specimen.set_velocity(i, 200 * body.centre[i] + 800 * Vector3d(0, body.centre[i].x(), 0),
                            Vector3d(0, 0, 10.0 * static_cast<double>(i % 3)));
    return specimen;
  }

  template <typename Parameters>
  dem::LinkMaterials twice(const Parameters &p)
  {
    return dem::Materials<Parameters>({{"mortar", p, 0}, {"grains", p, 0}});
  }

  dem::ParallelBondParameters cement()
  {
    dem::ParallelBondParameters p;
    p.effective_modulus    = 10e9;
    p.stiffness_ratio      = 2.5;
    p.friction_coefficient = 0.3;
    p.tensile_strength     = 0.3e6;
    p.cohesion             = 0.9e6;
    return p;
  }

  dem::ContactBondParameters spots()
  {
    dem::ContactBondParameters p;
    p.effective_modulus    = 5e9;
    p.stiffness_ratio      = 1.5;
    p.friction_coefficient = 0.2;
    p.tensile_strength     = 0.1e6;
    p.cohesion             = 0.4e6;
    return p;
  }

  dem::FlatJointParameters joints()
  {
    dem::FlatJointParameters p;
    p.effective_modulus    = 8e9;
    p.stiffness_ratio      = 2;
    p.friction_coefficient = 0.2;
    p.tensile_strength     = 0.2e6;
    p.cohesion             = 0.6e6;
    p.friction_angle       = 20;
    return p;
  }

  /** A block of spheres between platens under servo walls. */
  struct Confined : Body
  {
    static dem::LabParameters asked()
    {
      dem::LabParameters p = laboratory::between_platens(0.5);
      p.test               = laboratory::Test::confined;
      p.press.axis         = 2;
      p.pressure           = 1e6;
      p.largest_speed      = 0.05;
      p.confinement        = dem::LabParameters::Confinement::walls;
      p.stop_strain        = 1;
      return p;
    }
    static dem::SpecimenParameters spheres()
    {
      dem::SpecimenParameters p = laboratory::discs();
      p.physics.dimension       = 3;
      p.thickness               = 0;
      return p;
    }
    Confined()
      : run(cluster::cubic_lattice(9, 9, 9, laboratory::R), spheres(), laboratory::weak(), asked())
    {
    }
    dem::Specimen &specimen() override { return run.body; }
    void           advance(const std::int64_t steps) override { run.advance(steps); }
    void           visit(base::StateVisitor &visitor) override
    {
      run.body.visit_state(visitor);
      run.test.visit_state(visitor);
    }
    laboratory::Run run;
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
        thrown_apart(dem::LinkMaterials::by_pair({twice(cement()), twice(spots()), twice(joints())}, {0, 1, 2})));
    };
    return {{"concrete that is pulled apart", [] { return std::make_unique<Pulled>(); }, 800, 100},
            {"a cell under stresses", [] { return std::make_unique<CellUnderStress>(); }, 600, 10},
            {"grains that fall into a box", falling_grains, 600, 0},
            {"clumps that tumble", tumbling_clumps, 500, 0},
            {"three laws in two materials", three_laws, 150, 100},
            {"flat joints", [] { return std::make_unique<Free>(thrown_apart(joints())); }, 150, 100},
            {"parallel bonds in the plane, with emission",
             [] { return std::make_unique<Free>(thrown_apart(cement(), 2, 2)); }, 200, 100},
            {"a block under servo walls", [] { return std::make_unique<Confined>(); }, 300, 0}};
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
    const State half = state_of(*alone);
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
              different[ranks->rank()] = differences(half, state_of(*body)); // looking at it changes nothing
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
        std::int64_t particles = 0;
        for (const dem::RankWork &of : work)
          particles += of.particles;
        CHECK(particles == static_cast<std::int64_t>(counts.particles));
      }
  }
} // namespace

TEST_CASE("the work of a specimen shared among ranks leaves it in the same state to the last bit", "[dem][ranks]")
{
  for (const Case &each : cases())
    check_on_ranks(each, {{2, 0, true}, {3, 40, false}});
}

TEST_CASE("the same for other numbers of ranks, and after more steps", "[dem][ranks][slow]")
{
  for (Case each : cases())
    {
      each.steps *= 2;
      check_on_ranks(each, {{4, 0, false}, {5, 30, true}, {8, 50, false}});
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
  const dem::LinkMaterials all[] = {cluster::concrete(), cement(), spots(), joints()};
  for (const dem::LinkMaterials &materials : all)
    {
      dem::SpecimenParameters p  = cluster::bonded(1.2);
      p.step_factor              = 0.1;
      const dem::Packing packing = bar(200);
      dem::SpecimenCore  core(packing, p, materials);
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

TEST_CASE("what ranks cannot share is refused", "[dem][ranks]")
{
  rank_threads::run(1, [&](const std::shared_ptr<dem::Ranks> &ranks) {
    dem::Specimen coupled(bar(300), cluster::bonded(1.5), cluster::concrete());
    coupled.share_among(ranks);
    CHECK_THROWS_WITH(coupled.partners().apply_impulse(0, Vector3d::UnitX(), Vector3d::Zero()),
                      Catch::Contains("not on several ranks"));
  });
}
