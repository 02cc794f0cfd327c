// doc/theory/damage-plastic-concrete.md, 6: values published, or from an independent implementation.
#include "fem/materials/damage_plastic/stress_invariants.h"
#include "tests/fem/concrete_fixture.h"

#include <catch2/catch.hpp>

#include <cmath>

using base::Voigt;

namespace
{
  Voigt voigt(const double a, const double b, const double c, const double d, const double e, const double f)
  {
    return (Voigt() << a, b, c, d, e, f).finished();
  }

  // Reference values have 7 to 10 digits; their tolerance for whole runs is 1e-4.
  constexpr double run_tolerance = 1e-4;
}

TEST_CASE("yield surface of concrete: derived constants and hardening law", "[fem]")
{
  const fem::YieldSurface m1(material_m1());
  CHECK(m1.friction() == Approx(10.2245901639).epsilon(1e-11));
  CHECK(m1.dilation_a() == Approx(5.4122950820).epsilon(1e-10));
  CHECK(m1.dilation_b() == Approx(0.6465039786).epsilon(1e-9));
  const fem::YieldSurface m2(material_m2());
  CHECK(m2.friction() == Approx(41.2856557377).epsilon(1e-11));
  CHECK(m2.dilation_a() == Approx(20.7178278689).epsilon(1e-11));
  CHECK(m2.dilation_b() == Approx(0.4068451495).epsilon(1e-9));

  CHECK(m1.hardening(0.25).value == Approx(0.6203125).epsilon(1e-14));
  CHECK(m1.hardening(0.5).value == Approx(0.8875).epsilon(1e-14));
  CHECK(m1.hardening(0.75).value == Approx(0.9859375).epsilon(1e-14));

  CHECK(m1.ductility(0.0).value == Approx(4.25471946e-5).epsilon(1e-8));
  CHECK(m1.ductility(-1.0 / 3.0).value == Approx(3e-3).epsilon(1e-8));
  CHECK(m1.ductility(-1.0).value == Approx(2.48270891e-2).epsilon(1e-8));
  CHECK(m1.ductility(-3.0).value == Approx(5.97030204e-2).epsilon(1e-8));
}

TEST_CASE("yield surface of concrete: spot values at a general stress", "[fem]")
{
  const auto                  p = material_m1();
  const fem::YieldSurface     surface(p);
  const fem::StressInvariants s(voigt(-20e6, -10e6, -2e6, 1e6, 2e6, -3e6));
  CHECK(s.volumetric == Approx(-10.666667e6).epsilon(1e-7));
  CHECK(s.deviatoric == Approx(13.80821012e6).epsilon(1e-9));
  CHECK(s.lode == Approx(0.6546533060).epsilon(1e-9));

  const double fc = p.compressive_strength, x = s.volumetric / fc, y = s.deviatoric / fc;
  const double r = surface.lode_radius(s.lode).value;
  const auto   f = [&](const double kappa) { return surface.yield(x, y, r, surface.hardening(kappa).value); };
  CHECK(f(0.0) == Approx(0.3297730226).epsilon(1e-9));
  CHECK(f(0.5) == Approx(-1.030577767).epsilon(1e-9));
  CHECK(f(1.0) == Approx(-1.398618760).epsilon(1e-9));

  const auto g = surface.potential(x, y, surface.hardening(0.5).value);
  CHECK(g.x == Approx(2.29326539).epsilon(1e-8));
  CHECK(g.y == Approx(4.65891901).epsilon(1e-8));
  const double lode = 4 * std::cos(s.lode) * std::cos(s.lode);
  CHECK(surface.ductility(x).value / lode == Approx(1.52990032e-3).epsilon(1e-8));

  const fem::StressInvariants compression(voigt(-10e6, 0, 0, 0, 0, 0));
  const double                rc = surface.lode_radius(compression.lode).value;
  CHECK(surface.yield(compression.volumetric / fc, compression.deviatoric / fc, rc, 0.1) ==
        Approx(0.1011111111).epsilon(1e-9));
  CHECK(surface.yield(compression.volumetric / fc, compression.deviatoric / fc, rc, 0.8875) ==
        Approx(-0.6765451389).epsilon(1e-9));
}

TEST_CASE("damage law of concrete: values over size, and its inverse", "[fem]")
{
  const fem::DamageLaw law(3e6 / 30e9, 3e-4);
  CHECK(1 - law.integrity(1e-5, 1.0).value == Approx(0.0481995117).epsilon(1e-8));
  CHECK(1 - law.integrity(1e-4, 1.0).value == Approx(0.365700067).epsilon(1e-8));
  CHECK(1 - law.integrity(1e-3, 1.0).value == Approx(0.974217843).epsilon(1e-8));
  CHECK(1 - law.integrity(1e-5, 0.1).value == Approx(0.00344213334).epsilon(1e-8));
  CHECK(1 - law.integrity(1e-4, 0.1).value == Approx(0.0338754457).epsilon(1e-8));
  CHECK(1 - law.integrity(1e-3, 0.1).value == Approx(0.290370554).epsilon(1e-8));
  for (const double damage : {1e-6, 0.1, 0.5, 0.9, 0.999999})
    CHECK(1 - law.integrity(law.inverse(damage, 0.3), 0.3).value ==
          Approx(damage).epsilon(1e-9)); // 1 - omega loses digits near 1
}

TEST_CASE("concrete in uniaxial tension: reference values of stress, hardening and damage", "[fem]")
{
  UniaxialPoint point(material_m1());
  CHECK(point.go_to(1e-4, 1) == Approx(2948603).epsilon(run_tolerance));
  CHECK(point.state.stress[0] == Approx(2.94847927e6).epsilon(run_tolerance)); // OOFEM regression test
  CHECK(point.state.kappa_p == Approx(0.242505).epsilon(run_tolerance));
  CHECK(point.state.damage == 0);
  CHECK(point.go_to(2e-4, 1) == Approx(1960544).epsilon(run_tolerance));
  CHECK(point.state.kappa_p == Approx(14.24193).epsilon(run_tolerance));
  CHECK(point.state.kappa_d == Approx(9.296858e-5).epsilon(run_tolerance));
  CHECK(point.state.damage == Approx(0.346485).epsilon(run_tolerance));
  CHECK(point.go_to(5e-4, 3) == Approx(621539).epsilon(run_tolerance));
  CHECK(point.state.kappa_p == Approx(56.97227).epsilon(run_tolerance));
  CHECK(point.state.kappa_d == Approx(3.929686e-4).epsilon(run_tolerance));
  CHECK(point.state.damage == Approx(0.792820).epsilon(run_tolerance));
  CHECK(point.state.stress[0] == Approx(6.21765727e5).epsilon(1e-3)); // OOFEM, its solver tolerance

  UniaxialPoint fine(material_m1());
  CHECK(fine.go_to(1e-4, 4) == Approx(2948508).epsilon(run_tolerance));
  CHECK(fine.go_to(1.5e-4, 2) == Approx(2443953).epsilon(run_tolerance));
  CHECK(fine.go_to(5e-4, 14) == Approx(621550).epsilon(run_tolerance));
}

TEST_CASE("concrete in uniaxial compression: reference values of stress, hardening and damage", "[fem]")
{
  UniaxialPoint point(material_m1());
  CHECK(point.go_to(-5e-4, 1) == Approx(-14029124).epsilon(run_tolerance));
  CHECK(point.state.kappa_p == Approx(0.160563).epsilon(run_tolerance));
  CHECK(point.go_to(-1.5e-3, 2) == Approx(-28413194).epsilon(run_tolerance));
  CHECK(point.state.kappa_p == Approx(0.611206).epsilon(run_tolerance));
  CHECK(point.go_to(-2.5e-3, 2) == Approx(-29659340).epsilon(run_tolerance));
  CHECK(point.state.kappa_p == Approx(1.108015).epsilon(run_tolerance));
  CHECK(point.state.damage == Approx(0.0113553).epsilon(run_tolerance));
  CHECK(point.state.stress[0] == Approx(-2.99825545e7).epsilon(0.015)); // OOFEM, about 1 % out of equilibrium

  const fem::DamagePlasticState before = point.state;
  CHECK(point.go_to(-5e-3, 5) == Approx(-25960337).epsilon(run_tolerance));
  CHECK(point.state.kappa_p == Approx(2.411056).epsilon(run_tolerance));
  CHECK(point.state.damage == Approx(0.134655).epsilon(run_tolerance));
  CHECK(point.state.stress[0] == Approx(-2.62968729e7).epsilon(0.015));

  const Voigt plastic = point.state.plastic_strain - before.plastic_strain;
  CHECK(plastic[1] / plastic[0] ==
        Approx(-0.85).epsilon(1e-3)); // D_f, at the peak stress only up to the lateral residual
  CHECK((point.state.kappa_d - before.kappa_d) / 5 == Approx(5.52643e-6).epsilon(1e-3));

  UniaxialPoint fine(material_m1());
  CHECK(fine.go_to(-5e-4, 5) == Approx(-14327151).epsilon(run_tolerance));
  CHECK(fine.go_to(-1e-3, 5) == Approx(-24794780).epsilon(run_tolerance));
  CHECK(fine.go_to(-2e-3, 10) == Approx(-29990244).epsilon(run_tolerance));
  CHECK(fine.go_to(-2.5e-3, 5) == Approx(-29407036).epsilon(run_tolerance));
  CHECK(fine.go_to(-5e-3, 25) == Approx(-25752107).epsilon(run_tolerance));
}

TEST_CASE("concrete in oedometric and hydrostatic strain: reference values", "[fem]")
{
  const fem::DamagePlasticConcrete law(material_m1());
  const auto                       first = follow(law, {voigt(-5e-4, 0, 0, 0, 0, 0)}, 1);
  CHECK(first.stress[0] == Approx(-15.212160e6).epsilon(run_tolerance));
  CHECK(first.stress[1] == Approx(-4.866728e6).epsilon(run_tolerance));
  const auto last = follow(law, {voigt(-2e-3, 0, 0, 0, 0, 0)}, 4);
  CHECK(last.stress[0] == Approx(-41.015423e6).epsilon(run_tolerance));
  CHECK(last.stress[1] == Approx(-19.297160e6).epsilon(run_tolerance));
  CHECK(last.kappa_p == Approx(0.107101).epsilon(run_tolerance));

  const double compressed[5] = {-22.260704e6, -36.081632e6, -48.335164e6, -59.947123e6, -71.338664e6};
  for (int n = 1; n <= 5; ++n)
    CHECK(follow(law, {-5e-4 * n * base::voigt_identity()}, n).stress[0] ==
          Approx(compressed[n - 1]).epsilon(run_tolerance));

  auto old_norm        = material_m1();
  old_norm.vertex_norm = 1.0 / 9.0;
  const fem::DamagePlasticConcrete old_law(old_norm);
  CHECK(follow(old_law, {-5e-4 * base::voigt_identity()}, 1).stress[0] == Approx(-21.266609e6).epsilon(run_tolerance));
  CHECK(follow(old_law, {-25e-4 * base::voigt_identity()}, 5).stress[0] == Approx(-59.160237e6).epsilon(run_tolerance));

  const double stretched[4] = {2.5e6, 1.723204e6, 0.958173e6, 0.555152e6};
  const double damage[4]    = {0, 0.412698, 0.673436, 0.810793};
  for (int n = 1; n <= 4; ++n)
    {
      const auto s = follow(law, {5e-5 * n * base::voigt_identity()}, n);
      CHECK(s.stress[0] == Approx(stretched[n - 1]).epsilon(run_tolerance));
      CHECK(s.damage == Approx(damage[n - 1]).epsilon(run_tolerance));
    }
}

TEST_CASE("concrete on a non-proportional path: reference values", "[fem]")
{
  const std::vector<Voigt> path = {voigt(-1e-3, 2e-4, 1e-4, 0, 0, 3e-4), voigt(-2e-3, 5e-4, 2e-4, 1e-4, 0, 6e-4)};
  const fem::DamagePlasticConcrete law(material_m1());
  const auto                       at_1 = follow(law, {path[0]}, 200), at_2 = follow(law, path, 200);
  const Voigt                      s_1 = 1e6 * voigt(-28.5145, -3.2598, -5.3643, 0, 0, 3.1568);
  const Voigt                      s_2 = 1e6 * voigt(-48.3628, -8.3497, -13.4673, 0.9726, 0, 4.7585);
  // 0.5 % of each component; where zero is printed, 0.5 % of the smallest other one.
  for (int i = 0; i < 6; ++i)
    {
      CHECK(at_1.stress[i] == Approx(s_1[i]).epsilon(0.005).margin(0.005 * 3e6));
      CHECK(at_2.stress[i] == Approx(s_2[i]).epsilon(0.005).margin(0.005 * 0.9726e6));
    }
  CHECK(at_1.kappa_p == Approx(0.226205).epsilon(0.005));
  CHECK(at_2.kappa_p == Approx(0.294373).epsilon(0.005));
}

TEST_CASE("concrete of the sequential mapping: published curve in uniaxial compression", "[fem]")
{
  const double  published[10][2] = {{-3.5e-4, -11.400},  {-7.0e-4, -22.208}, {-1.05e-3, -31.129}, {-1.4e-3, -36.663},
                                    {-1.75e-3, -39.208}, {-2.1e-3, -39.959}, {-2.24e-3, -39.999}, {-2.45e-3, -27.839},
                                    {-2.8e-3, -15.088},  {-3.15e-3, -9.0535}};
  UniaxialPoint point(material_m2());
  int           next = 0;
  for (int n = 1; n <= 90; ++n)
    {
      point.go_to(-3.5e-5 * n, 1);
      if (n == 65)
        {
          CHECK(point.state.stress[0] == Approx(-40.000e6).epsilon(1e-4));
          CHECK(point.state.damage == 0);
        }
      if (n == 66)
        {
          CHECK(point.state.stress[0] == Approx(-38.972e6).epsilon(1e-4));
          CHECK(point.state.damage > 0);
        }
      if (n == 70)
        {
          CHECK(point.state.kappa_p == Approx(1.0775).epsilon(1e-4));
          CHECK(point.state.damage == Approx(0.30404).epsilon(1e-4));
          CHECK(point.state.kappa_d == Approx(8.9096e-6).epsilon(1e-4));
        }
      if (next < 10 && std::fabs(-3.5e-5 * n - published[next][0]) < 1e-9)
        CHECK(point.state.stress[0] == Approx(published[next++][1] * 1e6).epsilon(1e-4));
    }
  CHECK(next == 10);
}
