// The universal law of size effect between its two ends: doc/theory/size-effect.md, 5.
#include "tests/apps/universal_law.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using Catch::WithinRel;

namespace
{
  /** With a transition between shallow notches and deep ones. */
  apps::UniversalLaw law_between()
  {
    apps::UniversalLaw law  = apps_tests::universal_law();
    law.form.grain          = 0.01;
    law.form.notch_exponent = 1.5;
    law.form.size_exponent  = 0.5;
    law.form.smallest       = 0.004;
    return law;
  }
} // namespace

TEST_CASE("the universal law with its transition tends to type 1 without a notch, and to type 2 under a deep one",
          "[apps][mesoscale]")
{
  const apps::UniversalLaw law = law_between();
  const double E = law.young, G = law.energy.value, c = law.zone.value, f = law.strength.value, D_b = law.layer.value,
               r = law.exponent.value, l_p = law.form.smallest;
  const auto type_1 = [&](const double D) { return f * std::pow(1 + r * D_b / (D + l_p), 1 / r); };
  const auto type_2 = [&](const double D, const double a) {
    return std::sqrt(E * G / (apps::shape_of_crack(a) * D + apps::slope_of_shape(a) * c));
  };
  for (const double D : {1e-6, 0.01, 0.1, 10.0})
    {
      CHECK_THAT(law.at({D, 0, 0}), WithinRel(type_1(D), 1e-12));
      CHECK_THAT(law.at({D, 0, 1e-9}), WithinRel(type_1(D), 1e-5)); // a scratch is no notch
    }
  // Small beams keep a finite strength, large ones have f_inf or break as a crack does.
  CHECK_THAT(law.at({1e-9, 0, 0}), WithinRel(f * std::pow(1 + r * D_b / l_p, 1 / r), 1e-6));
  CHECK_THAT(law.at({1e4, 0, 0}), WithinRel(f, 1e-5));
  for (const double a : {0.1, 0.3})
    {
      CHECK_THAT(law.at({100, 0, a}), WithinRel(type_2(100, a), 1e-2));
      CHECK_THAT(law.at({1e4, 0, a}), WithinRel(type_2(1e4, a), 1e-6));
      CHECK_THAT(law.at({1e4, 0, a}) * std::sqrt(1e4), WithinRel(std::sqrt(E * G / apps::shape_of_crack(a)), 1e-5));
    }
  // Between: lambda by hand, exp(-(0.1)^1.5 (0.09/0.01)^0.5).
  const apps::SizeStrength between{0.09, 0, 0.1};
  CHECK_THAT(law.form.smoothness(between), WithinRel(std::exp(-3 * std::pow(10.0, -1.5)), 1e-12));
  CHECK(law.at(between) < type_1(0.09));
  CHECK_THAT(law.at(between), WithinRel(law.at(between, law.form.smoothness(between)), 1e-15));
}

TEST_CASE("the universal law is found again from beams with shallow notches, deep ones and none", "[apps][mesoscale]")
{
  const apps::UniversalLaw        law = law_between();
  std::vector<apps::SizeStrength> beams;
  for (const double depth : {0.02, 0.04, 0.08, 0.16, 0.32})
    for (const double notch : {0.0, 0.025, 0.075, 0.15, 0.3})
      beams.push_back({depth, law.at({depth, 0, notch}), notch});
  const apps::UniversalLaw found = apps::fitted_universal(beams, law.young, law.form);
  CHECK_THAT(found.energy.value, WithinRel(40, 1e-3));
  CHECK_THAT(found.zone.value, WithinRel(0.012, 1e-3));
  CHECK_THAT(found.strength.value, WithinRel(3.5e6, 1e-3));
  CHECK_THAT(found.layer.value, WithinRel(0.008, 1e-3));
  CHECK_THAT(found.exponent.value, WithinRel(1.3, 1e-2));
  CHECK(found.scatter < 1e-5);
}
