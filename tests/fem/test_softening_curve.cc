#include "fem/references/concrete_points.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fem::references;

using fem::SofteningCurve;

namespace
{
  const SofteningCurve curves[] = {{1, 0, 20}, {2, 0, 20}, {2, 0.1, 20}, {3.5, 0.3, 5}, {1, 0.2, 10}};
}

TEST_CASE("a softening curve is the strength left, with its slope, its inverse, its area and its steepest place")
{
  for (const SofteningCurve &curve : curves)
    {
      INFO("n " << curve.exponent << ", r " << curve.residual << ", b " << curve.stretch);
      CHECK(curve.at(0).value == 1);
      double           area = 0, steepest = 0;
      constexpr double step = 1e-3;
      for (double y = 0.5 * step; y < 400; y += step)
        {
          area += step * curve.at(y).value;
          steepest = std::max(steepest, -curve.at(y).slope);
        }
      CHECK(curve.area() == Approx(area).epsilon(1e-5));
      CHECK(steepest <= curve.steepest() * (1 + 1e-12)); // a bound: what is refused by it may be a little too much
      CHECK(curve.steepest() <= 1.1 * steepest + 1e-3 + curve.residual / curve.stretch);
      for (const double y : {0.01, 0.3, 1.0, 2.0})
        {
          const double h = 1e-6;
          CHECK(curve.at(y).slope == Approx((curve.at(y + h).value - curve.at(y - h).value) / (2 * h)).epsilon(1e-7));
          CHECK(curve.opening(curve.at(y).value) == Approx(y).epsilon(1e-9));
        }
    }
}

TEST_CASE("damage on any softening curve solves its own equation, with its slope and its inverse")
{
  const double onset = 1e-4, opening = 3e-4;
  for (const SofteningCurve &curve : curves)
    for (const double size : {0.01, 0.5})
      {
        const fem::DamageLaw law(onset, opening, curve);
        REQUIRE(size < law.largest_size());
        for (const double driven : {0.0, 0.02, 0.5, 1.0, 3.0})
          {
            INFO("n " << curve.exponent << ", r " << curve.residual << ", h " << size << ", driven " << driven);
            const double kappa  = driven * opening / size;
            const auto   answer = law.integrity(kappa, size);
            CHECK(answer.value ==
                  Approx(curve.at(size / opening * (kappa + (1 - answer.value) * onset)).value).epsilon(1e-12));
            if (driven == 0)
              continue;
            const double h = 1e-5 * kappa;
            const double slope =
              (law.integrity(kappa + h, size).value - law.integrity(kappa - h, size).value) / (2 * h);
            CHECK(answer.slope == Approx(slope).epsilon(1e-6).margin(1e-9 * size / opening));
            CHECK(law.inverse(1 - answer.value, size) == Approx(kappa).epsilon(1e-8));
          }
      }
}

TEST_CASE("concrete dissipates its fracture energy on any softening curve, whatever the size of the element", "[slow]")
{
  for (const SofteningCurve &curve : {curves[2], curves[4]})
    for (const double size : {0.02, 0.05}) // what is spent before the peak grows with the size
      {
        auto p               = material_m1();
        p.crack_opening      = 0;
        p.fracture_energy    = 100;
        p.element_size       = size;
        p.largest_increment  = 2e-4;
        p.softening_exponent = curve.exponent;
        p.residual_share     = curve.residual;
        p.residual_stretch   = curve.stretch;
        UniaxialPoint point(p);
        double        work = 0, strain = 0, stress = 0;
        const double  step = 0.002 * p.softening_opening() / size;
        for (int i = 1; i < 200000 && (stress > 1e-4 * p.tensile_strength || i < 1000); ++i)
          {
            const double length = strain < 2e-4 ? 1e-6 : step * (1 + 100 * strain * size / p.softening_opening() / 20);
            const double next   = point.go_to(strain + length, 1);
            work += 0.5 * (stress + next) * length;
            strain += length;
            stress = next;
          }
        INFO("n " << curve.exponent << ", h " << size);
        CHECK(work * size == Approx(100).epsilon(0.02));
      }
}
