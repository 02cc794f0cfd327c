// What every link law must obey, whatever its formulas: each registered law runs through here.
#include "clusters.h"
#include "dem/laws/registry.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

using Eigen::Vector3d;

namespace
{
  /** Gives the constants of a law values under which everything it can do happens at strains of 1e-4. */
  class Typical : public dem::ConstantVisitor
  {
  public:
    void number(
      const char *key, double &member, const char *, const char *meaning, double, double, const bool required) override
    {
      CHECK_FALSE(std::string(meaning).empty());
      const std::map<std::string, double> values = {{"Normal modulus", 25e9},      {"Effective modulus", 25e9},
                                                    {"Shear ratio", 0.2},          {"Limit elastic strain", 1e-4},
                                                    {"Relative ductility", 5},     {"Cohesion", 3e6},
                                                    {"Friction coefficient", 0.8}, {"Tensile strength", 4e6},
                                                    {"Friction angle", 30},        {"Young modulus", 25e9}};
      const auto                          found  = values.find(key);
      INFO("a typical value of \"" << key << "\" is wanted here");
      CHECK((found != values.end() || !required));
      if (found != values.end())
        member = found->second;
    }
    void choice(const char *,
                const std::vector<std::string> &words,
                const std::size_t               initial,
                std::function<void(std::size_t)>,
                const char *) override
    {
      CHECK(initial < words.size());
    }
  };

  dem::LinkMaterials typical(const dem::LinkLawKind &kind)
  {
    const auto constants = kind.constants();
    Typical    values;
    constants->visit(values);
    constants->check();
    return kind.materials({{"", constants.get(), 0}});
  }

  /** One link in space, driven step by step; its own history and accounts. */
  struct Link
  {
    explicit Link(std::shared_ptr<const dem::LinkLaw> of, const Vector3d &n = {1, 0, 0})
      : law(std::move(of))
      , history(law->columns().size(), 0.0)
    {
      dem::NewLink fresh;
      fresh.distance     = 2e-3;
      fresh.first_radius = fresh.second_radius = 1e-3;
      fresh.area                               = 3e-6;
      fresh.direction                          = n;
      law->begin(0, fresh, history.data());
      step.geometry  = {0, 2e-3, 2e-3, 3e-6};
      step.direction = n;
    }

    void advance(const double strain, const Vector3d &shear, const Vector3d &turn)
    {
      step.strain_before     = step.geometry.strain;
      step.geometry.strain   = strain;
      step.geometry.length   = (1 + strain) * step.geometry.reference;
      step.shear_increment   = shear;
      step.twist_increment   = turn.dot(step.direction);
      step.bending_increment = turn - step.twist_increment * step.direction;
      before                 = history;
      answer                 = law->update(0, step, before.data(), history.data());
    }
    double stored() const { return law->stored(0, step.geometry, history.data()); }
    double dissipated() const { return law->damage_dissipation(0, step.geometry, history.data()); }
    bool   gone() const { return law->phase(0, step.geometry, history.data()) == dem::LinkPhase::gone; }

    std::shared_ptr<const dem::LinkLaw> law;
    std::vector<double>                 history, before;
    dem::LinkStep                       step;
    dem::LinkAnswer                     answer;
  };

  /** A smooth random way: normal strain, two shears, three rotations, all growing. */
  struct Way
  {
    explicit Way(const std::uint64_t seed)
    {
      dem::UniformRandom random(seed);
      for (int c = 0; c < 6; ++c)
        {
          frequency[c] = 1 + 3 * random();
          phase[c]     = 6.28 * random();
        }
    }
    double at(const int c, const double t) const { return t * std::sin(6.28 * frequency[c] * t + phase[c]); }
    double frequency[6], phase[6];
  };

  constexpr double strains = 1.5e-4, turns = 1e-4;
} // namespace

TEST_CASE("every link law names what it remembers, each once, with unit and meaning", "[dem][laws]")
{
  std::set<std::string> laws;
  for (const auto &kind : dem::link_laws())
    {
      CHECK(laws.insert(kind->name()).second);
      CHECK_FALSE(kind->meaning().empty());
      CHECK(dem::find_link_law(kind->name()) == kind.get());
      for (const int dimension : {2, 3})
        {
          dem::Physics physics;
          physics.dimension = dimension;
          std::set<std::string> columns;
          for (const auto &of : {typical(*kind).bonds(physics), typical(*kind).contacts(physics)})
            {
              columns.clear();
              for (const dem::LinkQuantity &quantity : of->columns())
                {
                  CHECK(columns.insert(quantity.name).second);
                  CHECK_FALSE(quantity.unit.empty());
                  CHECK_FALSE(quantity.meaning.empty());
                }
            }
        }
    }
  CHECK(dem::find_link_law("cpm") == dem::find_link_law("CPM"));
  CHECK(dem::find_link_law("none") == nullptr);
}

TEST_CASE("every link law balances work, stored and dissipated energy on random ways", "[dem][laws]")
{
  for (const auto &kind : dem::link_laws())
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
      {
        INFO(kind->name() << ", way " << seed);
        double error[2];
        for (int refinement = 0; refinement < 2; ++refinement)
          {
            Link      link(typical(*kind).bonds(dem::Physics()));
            const Way way(seed);
            const int n    = 4000 << (3 * refinement);
            double    work = 0, spent = 0, largest = 0;
            for (int i = 1; i <= n && !link.gone(); ++i)
              {
                const auto change = [&](const int c) {
                  return way.at(c, double(i) / n) - way.at(c, double(i - 1) / n);
                };
                const Vector3d force = link.answer.force, moment = link.answer.moment;
                const double   strain = link.step.geometry.strain;
                const Vector3d slip(0, strains * change(1), strains * change(2)),
                  turn = turns * Vector3d(change(3), change(4), change(5));
                link.advance(strains * way.at(0, double(i) / n), slip, turn);
                const Vector3d moved =
                  link.step.geometry.reference * (Vector3d(link.step.geometry.strain - strain, 0, 0) + slip);
                work += 0.5 * (force + link.answer.force).dot(moved) + 0.5 * (moment + link.answer.moment).dot(turn);
                spent += link.answer.friction + link.answer.damage + link.answer.released;
                CHECK(link.answer.friction >= 0);
                largest = std::max(largest, link.stored() + spent + link.dissipated());
              }
            error[refinement] = std::abs(work - link.stored() - spent - link.dissipated()) /
                                std::max(largest, std::numeric_limits<double>::min()); // it may never have touched
          }
        CHECK(error[1] < 2e-3);
        CHECK(error[1] < std::max(0.3 * error[0], 1e-10));
      }
}

TEST_CASE("every link law's tangent is the derivative of its update", "[dem][laws]")
{
  dem::UniformRandom random(9);
  for (const auto &kind : dem::link_laws())
    {
      constexpr int trials   = 60;
      int           compared = 0;
      for (int trial = 0; trial < trials; ++trial)
        {
          const Vector3d n = cluster::random_direction(random);
          Link           link(typical(*kind).bonds(dem::Physics()), n);
          const auto     across      = [&](Vector3d v) { return Vector3d(v - v.dot(n) * n); };
          const auto     random_step = [&](const double size) {
            const double   strain = size * strains * (2 * random() - 1);
            const Vector3d slip   = size * strains * across(cluster::random_vector(random)),
                           turn   = size * turns * cluster::random_vector(random);
            link.advance(strain, slip, turn);
          };
          random_step(2);
          if (link.gone())
            continue;
          const Link start = link;
          random_step(1);
          const Link at = link;
          // Input: strain vector (strain along n, slip across) and rotation; answer: force over area, moment.
          const auto answer_at = [&](const base::Vector6 &change) {
            Link           moved = start;
            const Vector3d e     = change.head<3>();
            moved.advance(at.step.geometry.strain + e.dot(n), at.step.shear_increment + across(e),
                          at.step.bending_increment + at.step.twist_increment * n + change.tail<3>());
            base::Vector6 out;
            out << moved.answer.force / at.step.geometry.area, moved.answer.moment;
            return out;
          };
          dem::LinkTangent kind_of;
          kind_of.damages =
            at.law->damaging_strain(0, at.history.data()) > at.law->damaging_strain(0, start.history.data());
          kind_of.slides              = at.answer.slides;
          const base::Matrix6 tangent = at.law->tangent(0, at.step, start.history.data(), at.history.data(), kind_of);
          double              worst   = 0;
          const double        h       = 1e-10;
          bool                kink    = false; // within h of another branch
          for (int c = 0; c < 6; ++c)
            {
              const base::Vector6 unit     = base::Vector6::Unit(c);
              const base::Vector6 forward  = (answer_at(h * unit) - answer_at({0, 0, 0, 0, 0, 0})) / h,
                                  backward = (answer_at({0, 0, 0, 0, 0, 0}) - answer_at(-h * unit)) / h;
              const double modulus = 25e9, moment = c < 3 ? modulus * 3e-9 : 1.0; // of a lever of the radius
              kink = kink || (forward - backward).head<3>().norm() > 1e-3 * modulus ||
                     (forward - backward).tail<3>().norm() > 1e-3 * moment;
              // Most laws have no force of a rotation at all.
              const double        force = c < 3 || !tangent.col(c).head<3>().isZero(0) ? modulus : 1.0;
              const base::Vector6 off   = 0.5 * (forward + backward) - tangent.col(c);
              worst = std::max({worst, off.head<3>().norm() / force, off.tail<3>().norm() / moment});
            }
          INFO(kind->name() << ", trial " << trial);
          if (kink)
            continue;
          ++compared;
          CHECK(worst < 2e-5);
        }
      INFO(kind->name());
      CHECK(compared > trials / 2);
    }
}
