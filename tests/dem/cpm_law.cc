#include "base/errors.h"
#include "dem/core/uniform_random.h"
#include "dem/laws/cpm.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

using Catch::Matchers::Contains;
using dem::CpmConstants;
using dem::CpmParameters;
using dem::DamageLaw;

namespace
{
  /** The material of the verification table, doc/theory/cpm.md, 3. */
  CpmParameters tabulated()
  {
    CpmParameters p;
    p.normal_modulus       = 1e9;
    p.shear_ratio          = 0.2;
    p.limit_elastic_strain = 1e-4;
    p.relative_ductility   = 1.5;
    p.cohesion             = 1e5;
    p.friction_coefficient = 0.8;
    return p;
  }

  CpmParameters tabulated_linear()
  {
    CpmParameters p      = tabulated();
    p.damage_law         = DamageLaw::linear;
    p.relative_ductility = 4;
    return p;
  }

  using State    = dem::CpmState<double, 3>;
  using Response = dem::CpmResponse<double, 3>;
  using Law      = dem::Cpm<true, true>;

  constexpr State virgin_link = {0.0, 0.0, {{0.0, 0.0, 0.0}}};
  constexpr State contact     = {0.0, 1.0, {{0.0, 0.0, 0.0}}};

  double length(const dem::Vec<double, 3> &v) { return std::sqrt(dem::dot(v, v)); }

  /** Work of the normal stress from zero to the strain, trapezoidal rule with the given number of increments [J/m^3]. */
  double tension_work(const CpmConstants &k, const double to, const int increments, State &state)
  {
    double work = 0, before = 0;
    for (int i = 1; i <= increments; ++i)
      {
        const double stress = Law::update(k, to * i / increments, 0.0, state).normal_stress;
        work += 0.5 * (before + stress) * to / increments;
        before = stress;
      }
    return work;
  }
} // namespace

TEST_CASE("CPM follows the published exponential envelope", "[dem]")
{
  const CpmConstants k(tabulated());
  struct Row
  {
    double kappa, damage, stress, strength_damage;
  };
  // doc/theory/cpm.md, 3: published output of a law tester, with which formulas agree to 1e-9.
  const Row rows[] = {{1.0e-4, 0, 100000, 0},
                      {1.1e-4, 0.149539104515, 93550.6985, 0.0644930150},
                      {1.5e-4, 0.522312459617, 71653.1311, 0.2834686894},
                      {2.5e-4, 0.852848223531, 36787.9441, 0.6321205588}};
  State     state  = virgin_link;
  for (const Row &row : rows)
    {
      const Response response = Law::update(k, row.kappa, 0.0, state);
      INFO("kappa = " << row.kappa);
      CHECK(state.damage == Approx(row.damage).margin(1e-15).epsilon(1e-9));
      CHECK(state.damage ==
            Approx(1 - 1e-4 / row.kappa * std::exp(-(row.kappa - 1e-4) / 1.5e-4)).margin(1e-15).epsilon(1e-14));
      CHECK(response.normal_stress == Approx(row.stress).epsilon(1e-9));
      CHECK(k.strength_damage(state.kappa, state.damage) == Approx(row.strength_damage).margin(1e-10).epsilon(0));
    }
}

TEST_CASE("CPM unloads towards the origin and is as stiff as ever in compression", "[dem]")
{
  const CpmConstants k(tabulated());
  State              state = virgin_link;
  Law::update(k, 1.5e-4, 0.0, state);
  const double damage = state.damage;
  CHECK(Law::update(k, 1.0e-4, 0.0, state).normal_stress == Approx(47768.754).epsilon(1e-8)); // printed to 8 digits
  CHECK(Law::update(k, -2e-5, 0.0, state).normal_stress == Approx(-20000).epsilon(1e-14));
  CHECK(state.kappa == 1.5e-4);
  CHECK(state.damage == damage);
}

TEST_CASE("CPM with linear softening reaches zero stress at the softening strain and stays there", "[dem]")
{
  const CpmParameters p = tabulated_linear();
  const CpmConstants  k(p);
  const double        e0 = p.limit_elastic_strain, ef = 4e-4;
  State               state = virgin_link;
  for (const double kappa : {1e-4, 1.5e-4, 2e-4, 3.9e-4})
    {
      const double straight = p.normal_modulus * e0 * (ef - kappa) / (ef - e0);
      CHECK(Law::update(k, kappa, 0.0, state).normal_stress == Approx(straight).epsilon(1e-12));
      CHECK(state.damage == Approx((1 - e0 / kappa) / (1 - e0 / ef)).margin(1e-15).epsilon(1e-14));
    }
  CHECK(Law::update(k, 4e-4, 0.0, state).normal_stress == Approx(0).margin(1e-9));
  CHECK(Law::update(k, 8e-4, 0.0, state).normal_stress == 0);
  CHECK(state.damage == 1);
}

TEST_CASE("CPM link is deleted in tension where its residual strength has fallen to the limit", "[dem][laws]")
{
  for (CpmParameters p : {tabulated(), tabulated_linear()})
    for (const double limit : {1e-4, 0.2})
      {
        p.residual_strength_limit = limit;
        const CpmConstants k(p);
        CHECK(1 - k.strength_damage(k.kappa_broken, k.damage_at(k.kappa_broken)) == Approx(limit).epsilon(1e-9));

        const auto              law = dem::CpmLaw::bonds({p}, {}, 3);
        const dem::LinkGeometry in_tension{0.5 * k.onset, 1, 1, 0}, in_compression{-0.5 * k.onset, 1, 1, 0};
        std::vector<double>     history(law->columns().size(), 0.0);
        for (const double share : {1 - 1e-9, 1 + 1e-9})
          {
            history[0] = share * k.kappa_broken;
            CHECK((law->phase(0, in_tension, history.data()) == dem::LinkPhase::gone) == (share > 1));
            CHECK(law->phase(0, in_compression, history.data()) == dem::LinkPhase::whole);
          }
      }
}

TEST_CASE("CPM inverts its damage function", "[dem]")
{
  for (const CpmParameters &p : {tabulated(), tabulated_linear()})
    {
      const CpmConstants k(p);
      CHECK(k.kappa_at(0) == p.limit_elastic_strain);
      for (const double omega : {1e-9, 1e-3, 0.1, 0.5, 0.9, 0.99, 0.999999})
        {
          // g' <= 1/eps_0 (1 + 1/1.5): a rounding of omega at 1 moves kappa by 1e-16/(1 - omega) relative.
          const double kappa = k.kappa_at(omega);
          CHECK(k.damage_at(kappa) == Approx(omega).margin(1e-15).epsilon(1e-14));
          CHECK(k.kappa_at(k.damage_at(kappa)) == Approx(kappa).epsilon(1e-15 / (1 - omega) + 1e-14));
        }
    }
}

TEST_CASE("CPM returns to the shear strength exactly in one step", "[dem]")
{
  const CpmConstants k(tabulated());
  const double       R = 1e5, G = 0.2e9;
  State              state    = {0.0, 0.0, {{0.0, 2 * R / G * 0.6, 2 * R / G * 0.8}}}; // trial stress 2 R
  const Response     first    = Law::update(k, 0.0, 0.0, state);
  const State        returned = state;
  const Response     second   = Law::update(k, 0.0, 0.0, state); // no increment: the trial is what was returned
  CHECK(length(first.shear_stress) == Approx(R).epsilon(1e-15));
  CHECK(G * length(returned.elastic_shear) == Approx(R).epsilon(1e-15));
  CHECK(length(second.shear_stress) == Approx(R).epsilon(1e-15));
  CHECK(first.plastic_work == Approx(R * R / G).epsilon(1e-14)); // sigma_T after return times plastic increment R/G
  CHECK(second.plastic_work == Approx(0).margin(1e-14 * R * R / G));
  CHECK(first.shear_stress[0] == 0);
  CHECK(first.shear_stress[2] / first.shear_stress[1] == Approx(0.8 / 0.6).epsilon(1e-14));
}

TEST_CASE("CPM shear strength is cohesion of what is undamaged plus friction", "[dem]")
{
  const CpmParameters p = tabulated();
  const CpmConstants  k(p);
  for (const double strain : {-5e-4, -1e-5, 0.0, 0.5e-4, 1.1e-4, 2.5e-4})
    {
      State          state    = {0.0, 0.0, {{0.0, 1.0, 0.0}}}; // far beyond
      const Response response = Law::update(k, strain, 0.0, state);
      const double   strength = p.cohesion * (1 - state.damage) - response.normal_stress * p.friction_coefficient;
      INFO("normal strain = " << strain);
      CHECK(length(response.shear_stress) == Approx(std::max(strength, 0.0)).margin(1e-9));
    }
}

TEST_CASE("CPM dissipates E eps_0 (eps_0/2 + eps_f) per volume in full tension", "[dem]")
{
  // 1e9 x 1e-4 (0.5e-4 + 1.5e-4) = 20 J/m^3, doc/theory/cpm.md, 3.
  const CpmConstants k(tabulated());
  const double       to    = 1e-4 + 30 * 1.5e-4;
  State              state = virgin_link;
  const double       work  = tension_work(k, to, 46000, state); // the peak falls on a sample
  // Trapezoid: step 1e-7, (step/eps_f)^2/12 = 4e-8. Beyond the last strain E eps_0 (eps_f + to/2) e^-30 = 1.2e-12 of 20 is left.
  CHECK(work == Approx(20).epsilon(1e-7));
  CHECK(k.dissipated_at(state.kappa, state.damage) == Approx(20).epsilon(2e-12));
}

TEST_CASE("CPM dissipation in closed form is the work done less the energy stored", "[dem]")
{
  for (const CpmParameters &p : {tabulated(), tabulated_linear()})
    {
      const CpmConstants k(p);
      for (const double to : {0.5e-4, 1.0e-4, 1.2e-4, 2.5e-4, 4e-4, 7e-4})
        {
          State        state  = virgin_link;
          const double work   = tension_work(k, to, 70000, state); // 7e-4: a sample at every multiple of 1e-8
          const double stored = 0.5 * (1 - state.damage) * p.normal_modulus * to * to;
          INFO("kappa = " << to);
          // Trapezoid error (1e-8/1.5e-4)^2/12 of 20 J/m^3, and a corner that falls between two samples: 1e-8^2 E/2.
          CHECK(k.dissipated_at(state.kappa, state.damage) == Approx(work - stored).margin(1e-7).epsilon(1e-7));
        }
    }
  // Linear softening: the whole triangle is E eps_0 eps_f/2.
  CHECK(CpmConstants(tabulated_linear()).dissipated_at(9e-4, 1.0) == Approx(0.5 * 1e9 * 1e-4 * 4e-4).epsilon(1e-14));
}

TEST_CASE("CPM with shear contribution is damaged by normal and shear strain together", "[dem]")
{
  CpmParameters p      = tabulated();
  p.shear_contribution = 0.5;
  const CpmConstants k(p);
  const auto         damage_of = [&](const double normal, const double shear) {
    State state = virgin_link;
    Law::update(k, normal, shear * shear, state);
    return state.damage;
  };
  const auto g = [](const double kappa) { return 1 - 1e-4 / kappa * std::exp(-(kappa - 1e-4) / 1.5e-4); };
  CHECK(damage_of(0, 4e-4) == Approx(g(2e-4)).epsilon(1e-14)); // (2.16): sqrt(<e>^2 + xi^2 shear^2)
  CHECK(damage_of(1.5e-4, 4e-4) == Approx(g(2.5e-4)).epsilon(1e-13));
  CHECK(damage_of(-1.5e-4, 4e-4) == Approx(g(2e-4)).epsilon(1e-14));
  CHECK(damage_of(0, 1.9e-4) == 0);
}

TEST_CASE("CPM with shear contribution accounts for the energy that damage takes from tension", "[dem]")
{
  // At a held opening e the stored energy (1 - omega) E e^2/2 falls with omega; no force moves, so all of it is dissipated.
  CpmParameters p      = tabulated();
  p.shear_contribution = 1;
  const CpmConstants k(p);
  State              state = virgin_link;
  const double       e = 1.5e-4, stored = 0.5 * 1e9 * e * e;
  Law::update(k, e, 0.0, state);
  const double before     = (1 - state.damage) * stored;
  double       dissipated = 0;
  for (const double shear : {1e-4, 2e-4, 5e-4})
    {
      const double damage = state.damage;
      Law::update(k, e, shear * shear, state);
      dissipated += Law::damage_work(k, e, e, state.damage - damage);
    }
  CHECK(dissipated == Approx(before - (1 - state.damage) * stored).epsilon(1e-13));
}

TEST_CASE("CPM contact carries no tension and shears by friction only", "[dem]")
{
  using Contact = dem::Cpm<false, true>;
  const CpmConstants k(tabulated());
  State              pulled = contact;
  pulled.elastic_shear      = {{1e-4, 0, 0}};
  const Response open       = Contact::update(k, 3e-4, 0.0, pulled);
  CHECK(open.normal_stress == 0);
  CHECK(length(open.shear_stress) == 0);
  CHECK(length(pulled.elastic_shear) == 0);

  State pressed         = contact;
  pressed.elastic_shear = {{3e-3, 0, 0}};
  const Response closed = Contact::update(k, -2e-4, 0.0, pressed);
  CHECK(closed.normal_stress == Approx(-2e5).epsilon(1e-15));
  CHECK(length(closed.shear_stress) == Approx(0.8 * 2e5).epsilon(1e-15));

  State stuck         = contact;
  stuck.elastic_shear = {{1e-4, 0, 0}}; // 20 kPa, below the strength
  CHECK(length(Contact::update(k, -2e-4, 0.0, stuck).shear_stress) == Approx(2e4).epsilon(1e-15));
}

namespace
{
  /** Eight links, by lane. */
  struct EightLinks
  {
    alignas(64) double strain[8], shear2[8], kappa[8], damage[8], shear[3][8];

    EightLinks(const CpmConstants &k, dem::UniformRandom &random)
    {
      for (int lane = 0; lane < 8; ++lane)
        {
          strain[lane] = (2 * random() - 1) * 6e-4;
          shear2[lane] = std::pow(random() * 6e-4, 2);
          kappa[lane]  = random() < 0.3 ? 0.0 : random() * 4e-4;
          damage[lane] = k.damage_at(kappa[lane]);
          for (auto &component : shear)
            component[lane] = (2 * random() - 1) * 2e-3;
        }
    }

    void copy_lane(const EightLinks &from, const int source, const int to)
    {
      strain[to] = from.strain[source];
      shear2[to] = from.shear2[source];
      kappa[to]  = from.kappa[source];
      damage[to] = from.damage[source];
      for (int c = 0; c < 3; ++c)
        shear[c][to] = from.shear[c][source];
    }

    /** Everything that an update gives, one row per quantity. */
    std::vector<std::array<double, 8>> update(const CpmConstants &k) const
    {
      using dem::load;
      dem::CpmState<dem::Pack, 3> state = {
        load(kappa), load(damage), {{load(shear[0]), load(shear[1]), load(shear[2])}}};
      const auto                         r = Law::update(k, load(strain), load(shear2), state);
      std::vector<std::array<double, 8>> rows;
      for (const dem::Pack &p :
           {r.normal_stress, r.shear_stress[0], r.shear_stress[1], r.shear_stress[2], r.plastic_work, state.kappa,
            state.damage, state.elastic_shear[0], state.elastic_shear[1], state.elastic_shear[2]})
        {
          rows.emplace_back();
          for (int lane = 0; lane < 8; ++lane)
            rows.back()[lane] = p[lane];
        }
      return rows;
    }

    std::array<double, 10> update_alone(const CpmConstants &k, const int lane) const
    {
      State      state = {kappa[lane], damage[lane], {{shear[0][lane], shear[1][lane], shear[2][lane]}}};
      const auto r     = Law::update(k, strain[lane], shear2[lane], state);
      return {r.normal_stress,        r.shear_stress[0],     r.shear_stress[1], r.shear_stress[2],
              r.plastic_work,         state.kappa,           state.damage,      state.elastic_shear[0],
              state.elastic_shear[1], state.elastic_shear[2]};
    }
  };

  template <typename Check>
  void for_many_packs(Check &&check)
  {
    dem::UniformRandom random(3);
    for (const double xi : {0.0, 0.7})
      for (CpmParameters p : {tabulated(), tabulated_linear()})
        {
          p.shear_contribution = xi;
          const CpmConstants k(p);
          for (int trial = 0; trial < 3000; ++trial)
            check(k, EightLinks(k, random), EightLinks(k, random));
        }
  }
} // namespace

TEST_CASE("CPM gives a link the same bits in every lane, whatever its neighbours do", "[dem]")
{
  int different = 0;
  for_many_packs([&](const CpmConstants &k, const EightLinks &here, const EightLinks &others) {
    EightLinks elsewhere = others; // lane 2 moves to lane 5, among strangers
    elsewhere.copy_lane(here, 2, 5);
    const auto one = here.update(k), two = elsewhere.update(k);
    for (std::size_t row = 0; row < one.size(); ++row)
      different += one[row][2] != two[row][5];
  });
  CHECK(different == 0);
}

TEST_CASE("CPM of a pack agrees with the single link to round-off", "[dem]")
{
  // Not to the bit: the compiler contracts a b + c to one rounding in one and not always in the other.
  double largest = 0;
  for_many_packs([&](const CpmConstants &k, const EightLinks &links, const EightLinks &) {
    const auto pack = links.update(k);
    for (int lane = 0; lane < 8; ++lane)
      {
        const auto alone = links.update_alone(k, lane);
        // Stresses relative to E and G times the largest strain, works to the product, damage and strains to one and to 1e-3.
        const double scale[10] = {6e5, 7e5, 7e5, 7e5, 2e3, 6e-4, 1, 3.5e-3, 3.5e-3, 3.5e-3};
        for (std::size_t row = 0; row < pack.size(); ++row)
          largest = std::max(largest, std::abs(pack[row][lane] - alone[row]) / scale[row]);
      }
  });
  CHECK(largest < 8 * 2.2e-16);
}

TEST_CASE("CPM refuses constants without meaning and names the entry", "[dem]")
{
  const auto refused = [](double CpmParameters::*entry, const double value) {
    CpmParameters p = tabulated();
    p.*entry        = value;
    return [p] { CpmConstants k(p); };
  };
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {0.0, -1.0, not_a_number})
    {
      CHECK_THROWS_WITH(refused(&CpmParameters::normal_modulus, wrong)(), Contains("Normal modulus"));
      CHECK_THROWS_WITH(refused(&CpmParameters::shear_ratio, wrong)(), Contains("Shear ratio"));
      CHECK_THROWS_WITH(refused(&CpmParameters::limit_elastic_strain, wrong)(), Contains("Limit elastic strain"));
      CHECK_THROWS_WITH(refused(&CpmParameters::relative_ductility, wrong)(), Contains("Relative ductility"));
      CHECK_THROWS_WITH(refused(&CpmParameters::residual_strength_limit, wrong)(), Contains("Residual strength limit"));
    }
  CHECK_THROWS_WITH(refused(&CpmParameters::cohesion, -1)(), Contains("Cohesion"));
  CHECK_THROWS_WITH(refused(&CpmParameters::friction_coefficient, -0.1)(), Contains("Friction coefficient"));
  CHECK_THROWS_WITH(refused(&CpmParameters::shear_contribution, -0.1)(), Contains("Shear contribution"));
  CHECK_THROWS_AS(refused(&CpmParameters::normal_modulus, -1)(), base::InputError);
  CHECK_THROWS_AS(refused(&CpmParameters::normal_modulus, std::numeric_limits<double>::infinity())(), base::InputError);

  CpmParameters brittle      = tabulated_linear();
  brittle.relative_ductility = 1;
  CHECK_THROWS_WITH(CpmConstants(brittle), Contains("Relative ductility") && Contains("linear"));
}

namespace
{
  /** Takes the entries that are words. */
  struct Words
  {
    std::map<std::string, bool> &required;

    template <typename Value>
    void operator()(const std::string &key,
                    Value &,
                    std::initializer_list<std::pair<const char *, typename std::common_type<Value>::type>> values,
                    const std::string &) const
    {
      CHECK(required.emplace(key, false).second);
      CHECK(values.size() == 2);
    }
  };
} // namespace

TEST_CASE("CPM block declares every parameter once, material constants without default", "[dem]")
{
  CpmParameters               p;
  std::map<std::string, bool> required;
  double                      next = 1;
  dem::CpmLaw::describe(
    p,
    [&](const std::string &key, double &member, const std::string &, const std::string &, double, double, bool needed) {
      CHECK(required.emplace(key, needed).second);
      member = next++;
    },
    Words{required});
  const std::map<std::string, bool> wanted = {{"Normal modulus", true},
                                              {"Shear ratio", true},
                                              {"Limit elastic strain", true},
                                              {"Relative ductility", true},
                                              {"Cohesion", true},
                                              {"Friction coefficient", true},
                                              {"Shear contribution", false},
                                              {"Residual strength limit", false},
                                              {"Damage law", false},
                                              {"Shear kinematics", false},
                                              {"Compression yield strain", false},
                                              {"Compression hardening", false},
                                              {"Strength surface", false},
                                              {"Logarithmic speed", false},
                                              {"Damage time", false},
                                              {"Damage rate exponent", false},
                                              {"Damage overstress", false},
                                              {"Plastic time", false},
                                              {"Plastic rate exponent", false},
                                              {"Prestress", false}};
  CHECK(required == wanted);
  // Written in the order of the struct: each entry has its own member.
  CHECK(p.normal_modulus + p.shear_ratio + p.limit_elastic_strain + p.relative_ductility + p.cohesion +
          p.friction_coefficient + p.shear_contribution + p.residual_strength_limit ==
        36);
  const dem::CpmOptions &o = p.options;
  CHECK(o.compression_yield_strain + o.compression_hardening + o.logarithmic_speed + o.damage_time + o.damage_exponent +
          o.plastic_time + o.plastic_exponent + o.prestress ==
        100);
}
