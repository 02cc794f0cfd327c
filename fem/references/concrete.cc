#include "fem/references/concrete.h"

#include "fem/materials/damage_plastic/stress_invariants.h"
#include "fem/references/concrete_points.h"

#include <cmath>
#include <string>

namespace fem::references
{
  namespace
  {
    using base::Comparisons;
    using base::Voigt;

    // Reference values have 7 to 10 digits; their limit for whole runs is 1e-4.
    constexpr double of_run = 1e-4;

    Voigt voigt_of_six(const double a, const double b, const double c, const double d, const double e, const double f)
    {
      return (Voigt() << a, b, c, d, e, f).finished();
    }

    std::string at_strain(const std::string &quantity, const double strain)
    {
      std::string text = std::to_string(1e3 * strain);
      text.erase(text.find_last_not_of('0') + 1);
      return quantity + " at " + text + "e-3";
    }

    /** Moves a point and compares its stress. */
    void stress_row(Comparisons &rows, UniaxialPoint &point, const double strain, const int steps, const double stress)
    {
      rows.of(at_strain("stress", strain) + ", " + std::to_string(steps) + " steps", "Pa", point.go_to(strain, steps))
        .within(of_run, stress);
    }

    void hardening_row(Comparisons &rows, const UniaxialPoint &point, const double kappa_p)
    {
      rows.of(at_strain("kappa_P", point.state.strain[0]), "", point.state.kappa_p).within(of_run, kappa_p);
    }

    void damage_row(Comparisons &rows, const UniaxialPoint &point, const double damage)
    {
      rows.of(at_strain("damage", point.state.strain[0]), "", point.state.damage).within(of_run, damage);
    }
  } // namespace

  void yield_constants(Comparisons &rows)
  {
    const YieldSurface m1(material_m1()), m2(material_m2());
    rows.of("m_0 of M1", "", m1.friction()).within(1e-11, 10.2245901639);
    rows.of("A_g of M1", "", m1.dilation_a()).within(1e-10, 5.4122950820);
    rows.of("B_g of M1", "", m1.dilation_b()).within(1e-9, 0.6465039786);
    rows.of("m_0 of M2", "", m2.friction()).within(1e-11, 41.2856557377);
    rows.of("A_g of M2", "", m2.dilation_a()).within(1e-11, 20.7178278689);
    rows.of("B_g of M2", "", m2.dilation_b()).within(1e-9, 0.4068451495);
    rows.of("q_h at kappa_P = 0.25", "", m1.hardening(0.25).value).within(1e-14, 0.6203125);
    rows.of("q_h at kappa_P = 0.5", "", m1.hardening(0.5).value).within(1e-14, 0.8875);
    rows.of("q_h at kappa_P = 0.75", "", m1.hardening(0.75).value).within(1e-14, 0.9859375);
    rows.of("x_h at sigma_V = 0", "", m1.ductility(0.0).value).within(1e-8, 4.25471946e-5);
    rows.of("x_h at sigma_V = -f_c/3", "", m1.ductility(-1.0 / 3.0).value).within(1e-8, 3e-3);
    rows.of("x_h at sigma_V = -f_c", "", m1.ductility(-1.0).value).within(1e-8, 2.48270891e-2);
    rows.of("x_h at sigma_V = -3 f_c", "", m1.ductility(-3.0).value).within(1e-8, 5.97030204e-2);
  }

  void yield_at_general_stress(Comparisons &rows)
  {
    const auto             p = material_m1();
    const YieldSurface     surface(p);
    const StressInvariants s(voigt_of_six(-20e6, -10e6, -2e6, 1e6, 2e6, -3e6));
    rows.of("sigma_V", "Pa", s.volumetric).within(1e-7, -10.666667e6);
    rows.of("rho", "Pa", s.deviatoric).within(1e-9, 13.80821012e6);
    rows.of("theta", "", s.lode).within(1e-9, 0.6546533060);

    const double fc = p.compressive_strength, x = s.volumetric / fc, y = s.deviatoric / fc;
    const double r = surface.lode_radius(s.lode).value;
    const auto   f = [&](const double kappa) { return surface.yield(x, y, r, surface.hardening(kappa).value); };
    rows.of("f at kappa_P = 0", "", f(0.0)).within(1e-9, 0.3297730226);
    rows.of("f at kappa_P = 0.5", "", f(0.5)).within(1e-9, -1.030577767);
    rows.of("f at kappa_P = 1", "", f(1.0)).within(1e-9, -1.398618760);
    const auto g = surface.potential(x, y, surface.hardening(0.5).value);
    rows.of("dg/dsigma_V at kappa_P = 0.5", "", g.x).within(1e-8, 2.29326539);
    rows.of("dg/drho at kappa_P = 0.5", "", g.y).within(1e-8, 4.65891901);
    const double lode = 4 * std::cos(s.lode) * std::cos(s.lode);
    rows.of("x_h over Lode's part", "", surface.ductility(x).value / lode).within(1e-8, 1.52990032e-3);

    const StressInvariants compression(voigt_of_six(-10e6, 0, 0, 0, 0, 0));
    const double           rc  = surface.lode_radius(compression.lode).value;
    const auto             f_c = [&](const double hardening) {
      return surface.yield(compression.volumetric / fc, compression.deviatoric / fc, rc, hardening);
    };
    rows.of("f in compression by 10 MPa, q_h = 0.1", "", f_c(0.1)).within(1e-9, 0.1011111111);
    rows.of("f in compression by 10 MPa, q_h = 0.8875", "", f_c(0.8875)).within(1e-9, -0.6765451389);
  }

  void damage_over_opening(Comparisons &rows)
  {
    struct Value
    {
      double kappa, size, damage;
    };
    const DamageLaw law(3e6 / 30e9, 3e-4);
    for (const Value &v : {Value{1e-5, 1.0, 0.0481995117},
                           {1e-4, 1.0, 0.365700067},
                           {1e-3, 1.0, 0.974217843},
                           {1e-5, 0.1, 0.00344213334},
                           {1e-4, 0.1, 0.0338754457},
                           {1e-3, 0.1, 0.290370554}})
      rows
        .of(at_strain("damage", v.kappa) + ", size " + (v.size < 1 ? "0.1 m" : "1 m"), "",
            1 - law.integrity(v.kappa, v.size).value)
        .within(1e-8, v.damage);
  }

  void uniaxial_tension(Comparisons &rows)
  {
    UniaxialPoint point(material_m1());
    stress_row(rows, point, 1e-4, 1, 2948603);
    rows.of("stress at 0.1e-3 by OOFEM", "Pa", point.state.stress[0]).within(of_run, 2.94847927e6);
    hardening_row(rows, point, 0.242505);
    rows.of("damage before the peak", "", point.state.damage).within_margin(0, 0);
    stress_row(rows, point, 2e-4, 1, 1960544);
    hardening_row(rows, point, 14.24193);
    rows.of("kappa_D at 0.2e-3", "", point.state.kappa_d).within(of_run, 9.296858e-5);
    damage_row(rows, point, 0.346485);
    stress_row(rows, point, 5e-4, 3, 621539);
    hardening_row(rows, point, 56.97227);
    rows.of("kappa_D at 0.5e-3", "", point.state.kappa_d).within(of_run, 3.929686e-4);
    damage_row(rows, point, 0.792820);
    rows.of("stress at 0.5e-3 by OOFEM", "Pa", point.state.stress[0])
      .within(1e-3, 6.21765727e5); // its solver tolerance

    UniaxialPoint fine(material_m1());
    stress_row(rows, fine, 1e-4, 4, 2948508);
    stress_row(rows, fine, 1.5e-4, 2, 2443953);
    stress_row(rows, fine, 5e-4, 14, 621550);
  }

  void uniaxial_compression(Comparisons &rows)
  {
    UniaxialPoint point(material_m1());
    stress_row(rows, point, -5e-4, 1, -14029124);
    hardening_row(rows, point, 0.160563);
    stress_row(rows, point, -1.5e-3, 2, -28413194);
    hardening_row(rows, point, 0.611206);
    stress_row(rows, point, -2.5e-3, 2, -29659340);
    hardening_row(rows, point, 1.108015);
    damage_row(rows, point, 0.0113553);
    // OOFEM's are about 1 % out of equilibrium.
    rows.of("stress at -2.5e-3 by OOFEM", "Pa", point.state.stress[0]).within(0.015, -2.99825545e7);

    const DamagePlasticState before = point.state;
    stress_row(rows, point, -5e-3, 5, -25960337);
    hardening_row(rows, point, 2.411056);
    damage_row(rows, point, 0.134655);
    rows.of("stress at -5e-3 by OOFEM", "Pa", point.state.stress[0]).within(0.015, -2.62968729e7);
    const Voigt plastic = point.state.plastic_strain - before.plastic_strain;
    // D_f, at the peak stress only up to the lateral residual.
    rows.of("lateral over axial plastic strain", "", plastic[1] / plastic[0]).within(1e-3, -0.85);
    rows.of("kappa_D of a step", "", (point.state.kappa_d - before.kappa_d) / 5).within(1e-3, 5.52643e-6);

    UniaxialPoint fine(material_m1());
    stress_row(rows, fine, -5e-4, 5, -14327151);
    stress_row(rows, fine, -1e-3, 5, -24794780);
    stress_row(rows, fine, -2e-3, 10, -29990244);
    stress_row(rows, fine, -2.5e-3, 5, -29407036);
    stress_row(rows, fine, -5e-3, 25, -25752107);
  }

  void confined_strain(Comparisons &rows)
  {
    const DamagePlasticConcrete law(material_m1());
    const auto                  first = follow(law, {voigt_of_six(-5e-4, 0, 0, 0, 0, 0)}, 1);
    rows.of("uniaxial strain -0.5e-3: axial stress", "Pa", first.stress[0]).within(of_run, -15.212160e6);
    rows.of("uniaxial strain -0.5e-3: lateral stress", "Pa", first.stress[1]).within(of_run, -4.866728e6);
    const auto last = follow(law, {voigt_of_six(-2e-3, 0, 0, 0, 0, 0)}, 4);
    rows.of("uniaxial strain -2e-3: axial stress", "Pa", last.stress[0]).within(of_run, -41.015423e6);
    rows.of("uniaxial strain -2e-3: lateral stress", "Pa", last.stress[1]).within(of_run, -19.297160e6);
    rows.of("uniaxial strain -2e-3: kappa_P", "", last.kappa_p).within(of_run, 0.107101);

    const double compressed[5] = {-22.260704e6, -36.081632e6, -48.335164e6, -59.947123e6, -71.338664e6};
    for (int n = 1; n <= 5; ++n)
      rows
        .of(at_strain("hydrostatic pressure", -5e-4 * n), "Pa",
            follow(law, {-5e-4 * n * base::voigt_identity()}, n).stress[0])
        .within(of_run, compressed[n - 1]);

    auto old_norm        = material_m1();
    old_norm.vertex_norm = 1.0 / 9.0;
    const DamagePlasticConcrete old_law(old_norm);
    for (const auto &[n, pressure] : {std::pair{1, -21.266609e6}, {5, -59.160237e6}})
      rows
        .of(at_strain("hydrostatic pressure, earlier norm", -5e-4 * n), "Pa",
            follow(old_law, {-5e-4 * n * base::voigt_identity()}, n).stress[0])
        .within(of_run, pressure);

    const double stretched[4] = {2.5e6, 1.723204e6, 0.958173e6, 0.555152e6};
    const double damage[4]    = {0, 0.412698, 0.673436, 0.810793};
    for (int n = 1; n <= 4; ++n)
      {
        const auto s = follow(law, {5e-5 * n * base::voigt_identity()}, n);
        rows.of(at_strain("hydrostatic tension", 5e-5 * n), "Pa", s.stress[0]).within(of_run, stretched[n - 1]);
        auto row = rows.of(at_strain("damage in hydrostatic tension", 5e-5 * n), "", s.damage);
        if (damage[n - 1] > 0)
          row.within(of_run, damage[n - 1]);
        else
          row.within_margin(0, 0);
      }
  }

  void non_proportional_path(Comparisons &rows)
  {
    const std::vector<Voigt>    path = {voigt_of_six(-1e-3, 2e-4, 1e-4, 0, 0, 3e-4),
                                        voigt_of_six(-2e-3, 5e-4, 2e-4, 1e-4, 0, 6e-4)};
    const DamagePlasticConcrete law(material_m1());
    const auto                  at_1 = follow(law, {path[0]}, 200), at_2 = follow(law, path, 200);
    const Voigt                 s_1          = 1e6 * voigt_of_six(-28.5145, -3.2598, -5.3643, 0, 0, 3.1568);
    const Voigt                 s_2          = 1e6 * voigt_of_six(-48.3628, -8.3497, -13.4673, 0.9726, 0, 4.7585);
    const char                 *component[6] = {"xx", "yy", "zz", "yz", "zx", "xy"};
    // 0.5 % of each component; where zero is printed, 0.5 % of the smallest other one.
    for (int i = 0; i < 6; ++i)
      {
        const std::string name = std::string("sigma_") + component[i];
        rows.of(name + " at the first corner", "Pa", at_1.stress[i])
          .within_margin(0.005 * std::max(3e6, std::fabs(s_1[i])), s_1[i]);
        rows.of(name + " at the second corner", "Pa", at_2.stress[i])
          .within_margin(0.005 * std::max(0.9726e6, std::fabs(s_2[i])), s_2[i]);
      }
    rows.of("kappa_P at the first corner", "", at_1.kappa_p).within(0.005, 0.226205);
    rows.of("kappa_P at the second corner", "", at_2.kappa_p).within(0.005, 0.294373);
  }

  void published_compression(Comparisons &rows)
  {
    struct Point
    {
      int    step; ///< of 3.5e-5
      double stress;
    };
    UniaxialPoint point(material_m2());
    int           at = 0;
    const auto    to = [&](const int step) {
      while (at < step)
        point.go_to(-3.5e-5 * ++at, 1);
    };
    for (const Point &p : {Point{10, -11.400},
                           {20, -22.208},
                           {30, -31.129},
                           {40, -36.663},
                           {50, -39.208},
                           {60, -39.959},
                           {64, -39.999},
                           {65, -40.000},
                           {66, -38.972},
                           {70, -27.839},
                           {80, -15.088},
                           {90, -9.0535}})
      {
        to(p.step);
        rows.of(at_strain("stress", point.state.strain[0]), "Pa", point.state.stress[0]).within(of_run, 1e6 * p.stress);
        if (p.step == 65)
          rows.of("damage at the peak", "", point.state.damage).within_margin(0, 0);
        if (p.step != 70)
          continue;
        rows.of("kappa_P at -2.45e-3", "", point.state.kappa_p).within(of_run, 1.0775);
        rows.of("damage at -2.45e-3", "", point.state.damage).within(of_run, 0.30404);
        rows.of("kappa_D at -2.45e-3", "", point.state.kappa_d).within(of_run, 8.9096e-6);
      }
  }
} // namespace fem::references
