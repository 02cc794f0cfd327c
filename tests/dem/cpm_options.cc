// Options of the cohesive particle model (doc/theory/cpm-options.md) against published values and closed forms.
#include "base/errors.h"
#include "dem/core/uniform_random.h"
#include "dem/laws/cpm_extended.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

using Catch::Matchers::Contains;
using dem::CpmExtendedConstants;
using dem::CpmParameters;
using dem::StrengthSurface;

namespace
{
  CpmParameters plain()
  {
    CpmParameters p;
    p.normal_modulus       = 30e9;
    p.shear_ratio          = 0.2;
    p.limit_elastic_strain = 1e-4;
    p.relative_ductility   = 5;
    p.cohesion             = 3.5e6;
    p.friction_coefficient = 0.8;
    return p;
  }

  using Bond          = dem::CpmExtended<true>;
  using Contact       = dem::CpmExtended<false>;
  using ExtendedState = dem::CpmExtendedState<double, 3>;

  ExtendedState fresh(const CpmExtendedConstants &k)
  {
    ExtendedState s{};
    s.plastic_strain = k.plastic_prestrain();
    return s;
  }

  double
  normal_stress(const CpmExtendedConstants &k, const double strain, ExtendedState &state, const double per_second = 0)
  {
    return Bond::update(k, strain, 0.0, per_second, state).normal_stress;
  }

  double length_of(const dem::Vec<double, 3> &v) { return std::sqrt(dem::dot(v, v)); }
} // namespace

TEST_CASE("CPM flows in compression as published, however many steps it takes, and unloads elastically", "[dem][laws]")
{
  CpmParameters p                    = plain();
  p.options.compression_yield_strain = -2e-4;
  p.options.compression_hardening    = 0.5;
  const CpmExtendedConstants k(p);
  for (const int steps : {1, 7, 1000})
    {
      ExtendedState state  = fresh(k);
      double        stress = 0;
      for (int i = 1; i <= steps; ++i)
        stress = normal_stress(k, -6e-4 * i / steps, state);
      INFO(steps << " steps");
      CHECK(stress == Approx(-12e6).epsilon(1e-12));
      CHECK(state.plastic_strain == Approx(-2e-4).epsilon(1e-11));
      // Unloading with E, to zero at the plastic strain; past it damage starts after the limit strain.
      CHECK(normal_stress(k, -5e-4, state) == Approx(-9e6).epsilon(1e-11));
      CHECK(normal_stress(k, -2e-4, state) == Approx(0).margin(1e-3));
      CHECK(normal_stress(k, -1e-4, state) == Approx(3e6).epsilon(1e-11));
      CHECK(state.damage == Approx(0).margin(1e-11));
      CHECK(state.plastic_strain == Approx(-2e-4).epsilon(1e-11));
      CHECK(normal_stress(k, -6e-4, state) == Approx(-12e6).epsilon(1e-11)); // back onto the hardening line
      CHECK(normal_stress(k, -8e-4, state) == Approx(-15e6).epsilon(1e-11));
    }
}

TEST_CASE("CPM logarithmic strength has its published value, and value and slope of the linear one at no stress",
          "[dem][laws]")
{
  CpmParameters p            = plain();
  p.options.strength_surface = StrengthSurface::logarithmic;
  const CpmExtendedConstants k(p), linear(plain());
  CHECK(Bond::strength(k, 0.0, -10e6) == Approx(4.448306e6).epsilon(2e-7)); // printed to seven digits
  CHECK(Bond::strength(k, 0.0, -10e6) == Approx(3.5e6 * (1 + 0.08 * std::log(1 + 10 / 0.35))).epsilon(1e-14));
  for (const double damage : {0.0, 0.3, 1.0})
    {
      CHECK(Bond::strength(k, damage, 0.0) == Bond::strength(linear, damage, 0.0));
      const double h = 1.0; // of 0.35 MPa, where the logarithm has bent by h/(2 c_0 Y_0) = 1.4e-6
      CHECK((Bond::strength(k, damage, -h) - Bond::strength(k, damage, 0.0)) / h == Approx(0.8).epsilon(3e-6));
      for (const double tension : {0.1e6, 1e6, 5e6})
        CHECK(Bond::strength(k, damage, tension) == Bond::strength(linear, damage, tension));
    }
  // What is sheared far beyond bears just that.
  ExtendedState state          = fresh(k);
  state.elastic_shear          = {{0, 1.0, 0}};
  const auto          response = Bond::update(k, -10e6 / 30e9, 0.0, 0.0, state);
  dem::Vec<double, 3> shear    = response.shear_stress;
  CHECK(length_of(shear) == Approx(3.5e6 * (1 + 0.08 * std::log(1 + 10 / 0.35))).epsilon(1e-12));
}

TEST_CASE("CPM visco-damage: steady opening has the overstress of its definition", "[dem][laws]")
{
  for (const bool reduced : {false, true})
    for (const double M : {0.2, 0.5, 1.0})
      {
        CpmParameters p             = plain();
        p.options.damage_time       = 50;
        p.options.damage_exponent   = M;
        p.options.damage_overstress = reduced ? dem::DamageOverstress::undamaged : dem::DamageOverstress::whole;
        const CpmExtendedConstants k(p);
        ExtendedState              state = fresh(k);
        normal_stress(k, 1e-3, state); // no time passes: damaged as if slowly
        const double omega = state.damage;
        CHECK(state.damage_strain == Approx(omega * 1e-3).epsilon(1e-14));
        normal_stress(k, 0.0, state);
        CHECK(state.damage_strain == 0);
        // Reloading up to kappa, at a constant rate: eps_d comes to grow by omega times that.
        const double rate = 0.01, dt = 1e-5;
        double       stress = 0, strain = 0;
        for (int i = 1; strain < 9.9e-4; ++i)
          {
            strain = rate * dt * i;
            stress = normal_stress(k, strain, state, 1 / dt);
          }
        const double factor     = reduced ? 1 - omega : 1.0;
        const double overstress = 30e9 * 1e-4 * factor * std::pow(50 * omega * rate, M);
        INFO("M = " << M);
        CHECK(stress - (1 - omega) * 30e9 * strain == Approx(overstress).epsilon(1e-4));
        CHECK(state.damage == omega);
        CHECK(stress <= 30e9 * strain * (1 + 1e-14)); // never stiffer than undamaged
      }
}

TEST_CASE("CPM visco-damage: overstress at a held opening dies out as its differential equation says", "[dem][laws]")
{
  // M = 1: E x = E eps_0 tau x', x = x_0 exp(-t/(eps_0 tau)); implicit Euler divides by 1 + dt/(eps_0 tau) a step.
  CpmParameters p           = plain();
  p.options.damage_time     = 100;
  p.options.damage_exponent = 1;
  const CpmExtendedConstants k(p);
  ExtendedState              state = fresh(k);
  const double               dt = 1e-4, strain = 3e-4;
  double                     stress = normal_stress(k, strain, state, 1e12); // at once: nothing has softened yet
  const double               slow   = (1 - state.damage) * 30e9 * strain;
  CHECK(stress == Approx(30e9 * strain).epsilon(1e-8));
  double above = stress - slow;
  for (int i = 0; i < 200; ++i)
    {
      stress = normal_stress(k, strain, state, 1 / dt);
      above /= 1 + dt / (1e-4 * 100);
      CHECK(stress - slow == Approx(above).epsilon(1e-10));
    }
  CHECK(normal_stress(k, 2e-4, state, 1 / dt) == Approx((1 - state.damage) * 30e9 * 2e-4).epsilon(1e-12));
}

TEST_CASE("CPM visco-plasticity: steady sliding has the overstress of its definition", "[dem][laws]")
{
  for (const double M : {0.2, 0.5, 1.0})
    {
      CpmParameters p            = plain();
      p.options.plastic_time     = 3;
      p.options.plastic_exponent = M;
      const CpmExtendedConstants          k(p);
      ExtendedState                       state = fresh(k);
      const double                        rate = 0.02, dt = 1e-4, normal = -1e-4;
      dem::CpmExtendedResponse<double, 3> response;
      for (int i = 0; i < 20000; ++i)
        {
          state.elastic_shear[1] += 0.6 * rate * dt;
          state.elastic_shear[2] += 0.8 * rate * dt;
          response = Bond::update(k, normal, 0.0, 1 / dt, state);
        }
      const double strength = 3.5e6 + 0.8 * 30e9 * 1e-4, overstress = 3.5e6 * std::pow(3 * rate, M);
      INFO("M = " << M);
      CHECK(length_of(response.shear_stress) == Approx(strength + overstress).epsilon(1e-9));
      CHECK(response.plastic_shear == Approx(rate * dt).epsilon(1e-8));
      CHECK(response.overstress_share == Approx(overstress / (strength + overstress)).epsilon(1e-8));
      CHECK(response.plastic_work == Approx((strength + overstress) * rate * dt).epsilon(1e-8));
    }
}

TEST_CASE("CPM prestress is borne from the start and is no part of the stress", "[dem][laws]")
{
  CpmParameters p                    = plain();
  p.options.compression_yield_strain = -2e-4; // 6 MPa
  p.options.compression_hardening    = 0.5;
  for (const double sigma : {-3e6, -6e6, -9e6}) // below, at, and past the yield stress
    {
      p.options.prestress = sigma;
      const CpmExtendedConstants k(p);
      INFO("prestress " << sigma);
      ExtendedState state = fresh(k);
      CHECK(normal_stress(k, 0.0, state) == Approx(0).margin(1e-2));
      CHECK(k.prestrain == Approx(sigma >= -6e6 ? sigma / 30e9 : -2e-4 - 3e6 / 15e9).epsilon(1e-14));
      CHECK(state.plastic_strain == Approx(sigma < -6e6 ? -1e-4 : 0.0).margin(1e-15));
      // It presses: friction counts it.
      ExtendedState sheared = fresh(k);
      sheared.elastic_shear = {{0, 0, 1}};
      CHECK(length_of(Bond::update(k, 0.0, 0.0, 0.0, sheared).shear_stress) ==
            Approx(3.5e6 - 0.8 * sigma).epsilon(1e-9));
      // Further compression is elastic up to the yield stress, then on the hardening line.
      const double more = 1e-4, elastic = std::max(0.0, 2e-4 + sigma / 30e9);
      const double expected = -30e9 * (std::min(more, elastic) + 0.5 * std::max(more - elastic, 0.0));
      CHECK(normal_stress(k, -more, state) == Approx(expected).epsilon(1e-9));
      // Damage starts when the prestress is undone and the limit strain reached.
      ExtendedState pulled = fresh(k);
      const double  onset  = 1e-4 - sigma / 30e9;
      CHECK(normal_stress(k, onset * (1 - 1e-9), pulled) == Approx(30e9 * onset).epsilon(1e-8));
      CHECK(pulled.damage == 0);
      normal_stress(k, onset * 1.1, pulled);
      CHECK(pulled.damage > 0);
    }
}

TEST_CASE("CPM with all options off gives the bits of the plain law", "[dem][laws]")
{
  const CpmExtendedConstants k(plain());
  dem::UniformRandom         random(5);
  ExtendedState              state     = fresh(k);
  dem::CpmState<double, 3>   alone     = {0.0, 0.0, {{0, 0, 0}}};
  int                        different = 0, slid = 0;
  for (int i = 0; i < 3000; ++i)
    {
      const double strain = 8e-4 * (random() - 0.5);
      for (int c = 0; c < 3; ++c)
        {
          const double more = 2e-3 * (random() - 0.5);
          state.elastic_shear[c] += more;
          alone.elastic_shear[c] += more;
        }
      const auto response = Bond::update(k, strain, 0.0, 1e6, state);
      const auto expected = dem::Cpm<true, true>::update(k, strain, 0.0, alone);
      different += response.normal_stress != expected.normal_stress || state.kappa != alone.kappa ||
                   state.damage != alone.damage || response.slides != expected.slides;
      slid += response.slides;
      for (int c = 0; c < 3; ++c)
        different +=
          response.shear_stress[c] != expected.shear_stress[c] || state.elastic_shear[c] != alone.elastic_shear[c];
    }
  CHECK(different == 0);
  CHECK(slid > 1000);
}

TEST_CASE("CPM options: eight links side by side have the bits of each of them alone", "[dem][laws]")
{
  CpmParameters p                    = plain();
  p.shear_contribution               = 0.3;
  p.options.compression_yield_strain = -2e-4;
  p.options.strength_surface         = StrengthSurface::logarithmic;
  p.options.damage_time = p.options.plastic_time = 1e-2;
  p.options.prestress                            = -1e6;
  const CpmExtendedConstants k(p);
  dem::UniformRandom         random(8);
  int                        different = 0;
  for (int trial = 0; trial < 2000; ++trial)
    {
      alignas(64) double in[7][8], out[8][8]; // strain, shear squared, kappa, plastic strain, elastic shear
      ExtendedState      alone[8];
      for (int lane = 0; lane < 8; ++lane)
        {
          for (int row = 0; row < 7; ++row)
            in[row][lane] = 2e-3 * (random() - 0.5);
          in[1][lane] *= in[1][lane];
          in[2][lane] = std::fabs(in[2][lane]);
          in[3][lane] = -0.1 * std::fabs(in[3][lane]);
          alone[lane] = {
            {in[2][lane], k.damage_at(in[2][lane]), {{in[4][lane], in[5][lane], in[6][lane]}}}, in[3][lane], 0};
        }
      using dem::load;
      dem::CpmExtendedState<dem::Pack, 3> pack;
      pack.kappa              = load(in[2]);
      pack.damage             = dem::pack_of([&](const int lane) { return alone[lane].damage; });
      pack.elastic_shear      = {{load(in[4]), load(in[5]), load(in[6])}};
      pack.plastic_strain     = load(in[3]);
      pack.damage_strain      = dem::Pack(0.0);
      const auto      r       = Bond::update(k, load(in[0]), load(in[1]), dem::Pack(1e6), pack);
      const dem::Pack found[] = {r.normal_stress, r.shear_stress[0],  r.overstress_share,  pack.kappa,
                                 pack.damage,     pack.damage_strain, pack.plastic_strain, pack.elastic_shear[2]};
      for (int row = 0; row < 8; ++row)
        dem::store(found[row], out[row]);
      for (int lane = 0; lane < 8; ++lane)
        {
          ExtendedState &own        = alone[lane];
          const auto     single     = Bond::update(k, in[0][lane], in[1][lane], 1e6, own);
          const double   expected[] = {
              single.normal_stress, single.shear_stress[0], single.overstress_share, own.kappa,
              own.damage,           own.damage_strain,      own.plastic_strain,      own.elastic_shear[2]};
          for (int row = 0; row < 8; ++row)
            different += out[row][lane] != expected[row];
        }
    }
  CHECK(different == 0);
}

TEST_CASE("CPM options refuse what has no meaning, by entry", "[dem][laws]")
{
  const auto refusal = [](const std::function<void(CpmParameters &)> &change) {
    CpmParameters p = plain();
    change(p);
    try
      {
        dem::CpmLaw::check(p);
      }
    catch (const base::InputError &error)
      {
        return std::string(error.what());
      }
    return std::string("accepted");
  };
  CHECK(refusal([](CpmParameters &) {}) == "accepted");
  CHECK_THAT(refusal([](CpmParameters &p) { p.options.compression_yield_strain = 1e-4; }),
             Contains("CPM/Compression yield strain"));
  CHECK_THAT(refusal([](CpmParameters &p) { p.options.compression_hardening = 1; }),
             Contains("CPM/Compression hardening"));
  CHECK_THAT(refusal([](CpmParameters &p) { p.options.damage_time = -1; }), Contains("CPM/Damage time"));
  CHECK_THAT(refusal([](CpmParameters &p) { p.options.damage_exponent = 0; }), Contains("CPM/Damage rate exponent"));
  CHECK_THAT(refusal([](CpmParameters &p) { p.options.plastic_time = NAN; }), Contains("CPM/Plastic time"));
  CHECK_THAT(refusal([](CpmParameters &p) { p.options.prestress = 1e6; }), Contains("CPM/Prestress"));
  CHECK_THAT(refusal([](CpmParameters &p) {
               p.options.strength_surface = StrengthSurface::logarithmic;
               p.cohesion                 = 0;
             }),
             Contains("CPM/Cohesion"));
  CHECK_THAT(refusal([](CpmParameters &p) {
               p.options.compression_yield_strain = -1e-4;
               p.options.compression_hardening    = 0;
               p.options.prestress                = -4e6;
             }),
             Contains("CPM/Prestress"));
  CpmParameters p     = plain();
  p.options.prestress = -1e6;
  dem::Physics elastic;
  elastic.damage = false;
  CHECK_THROWS_WITH(dem::CpmLaw::bonds({p}, elastic, 3), Contains("not without Physics/Damage and Friction"));
  CpmParameters flowing                    = plain();
  flowing.options.compression_yield_strain = -1e-3;
  CHECK_THROWS_WITH(dem::mean_of({"a", plain(), 0}, {"b", flowing, 0}),
                    Contains("Compression yield strain: material a"));
}
