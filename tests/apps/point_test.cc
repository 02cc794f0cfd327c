#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  using Constants = std::vector<std::string>;

  /** Material M1 of doc/theory/damage-plastic-concrete.md, 6; one step per row. */
  const Constants m1 = {"Young modulus=30e9",   "Poisson ratio=0.2",  "Compressive strength=30e6",
                        "Tensile strength=3e6", "Crack opening=3e-4", "Softening A=35",
                        "Element size=1",       "Largest increment=0"};

  std::vector<std::string> command(const std::string &material, const Constants &constants)
  {
    std::vector<std::string> words = {"point-test", "--material", material, "--path", "path.csv", "-o", "out.csv"};
    for (const std::string &constant : constants)
      words.insert(words.end(), {"-s", constant});
    return words;
  }

  postprocess::CsvTable
  answer(const std::string &path, const Constants &constants, const std::string &material = "damage-plastic concrete")
  {
    const ScratchFolder folder;
    folder.file("path.csv", path);
    const Outcome outcome = run(folder.path(), command(material, constants));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return postprocess::read_csv_table(folder / "out.csv");
  }

  Constants with(Constants constants, const std::string &more)
  {
    constants.push_back(more);
    return constants;
  }

  /** Strain xx in equal steps; the other components as the header says. */
  std::string ramp(const std::string &header, const std::string &row, const double step, const int steps)
  {
    std::string text = header + "\n";
    for (int i = 1; i <= steps; ++i)
      text += fmt::format(fmt::runtime(row), i * step) + "\n";
    return text;
  }

  std::string uniaxial(const double step, const int steps)
  {
    return ramp("strain_xx,stress_yy,stress_zz", "{},0,0", step, steps);
  }

  double at(const postprocess::CsvTable &table, const std::string &column, const int row)
  {
    return table.column(column)[static_cast<std::size_t>(row - 1)];
  }
} // namespace

TEST_CASE("columns of a path are used in the units of their header, between semicolons, too", "[apps]")
{
  const auto row   = [](const std::string &path) { return answer(path, m1); };
  const auto by_si = row("strain_xx,stress_yy,stress_zz\n5e-5,-1e6,0\n");
  for (const char *path : {"strain_xx [%],stress_yy [MPa],stress_zz\n0.005,-1,0\n",
                           "strain_xx [per mille];stress_yy [N/mm^2];stress_zz\n0.05;-1;0\n"})
    for (const char *column : {"stress_xx", "stress_yy", "strain_yy"})
      CHECK(row(path).column(column).back() == Approx(by_si.column(column).back()).epsilon(1e-12));
  const ScratchFolder folder;
  folder.file("path.csv", "strain_xx [MPa]\n1e-5\n");
  const Outcome refused = run(folder.path(), command("damage-plastic concrete", m1));
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("path.csv: column strain_xx is in [MPa], expected [-]"));
}

TEST_CASE("point-test: uniaxial tension of concrete has the published values", "[apps]")
{
  const postprocess::CsvTable out = answer(uniaxial(1e-4, 5), m1);
  // doc/theory/damage-plastic-concrete.md, 6: tension, stress, kappa_P, kappa_D and damage at 1e-4, 2e-4 and 5e-4; digits as they were given.
  const double table[][5] = {{1, 2948603, 0.242505, 0, 0},
                             {2, 1960544, 14.24193, 9.296858e-5, 0.346485},
                             {5, 621539, 56.97227, 3.929686e-4, 0.792820}};
  for (const auto &line : table)
    {
      const int row = static_cast<int>(line[0]);
      CHECK(at(out, "stress_xx", row) == Approx(line[1]).epsilon(1e-5));
      CHECK(at(out, "kappa_P", row) == Approx(line[2]).epsilon(1e-5));
      CHECK(at(out, "kappa_D", row) == Approx(line[3]).epsilon(1e-5).margin(1e-15));
      CHECK(at(out, "damage", row) == Approx(line[4]).epsilon(1e-5).margin(1e-15));
      CHECK(std::abs(at(out, "stress_yy", row)) < 1e-3); // prescribed as zero
    }
  // OOFEM's regression values, from a coarser solver tolerance.
  CHECK(at(out, "stress_xx", 1) == Approx(2.94847927e6).epsilon(5e-4));
  CHECK(at(out, "stress_xx", 5) == Approx(6.21765727e5).epsilon(5e-4));

  const postprocess::CsvTable fine = answer(uniaxial(2.5e-5, 20), m1);
  CHECK(at(fine, "stress_xx", 4) == Approx(2948508).epsilon(1e-5));
  CHECK(at(fine, "stress_xx", 6) == Approx(2443953).epsilon(1e-5));
  CHECK(at(fine, "stress_xx", 20) == Approx(621550).epsilon(1e-5));
}

TEST_CASE("point-test: uniaxial compression of concrete has the published values", "[apps]")
{
  const postprocess::CsvTable out        = answer(uniaxial(-5e-4, 10), m1);
  const double                table[][4] = {{1, -14029124, 0.160563, 0},
                                            {3, -28413194, 0.611206, 0},
                                            {5, -29659340, 1.108015, 0.0113553},
                                            {10, -25960337, 2.411056, 0.134655}};
  for (const auto &line : table)
    {
      const int row = static_cast<int>(line[0]);
      CHECK(at(out, "stress_xx", row) == Approx(line[1]).epsilon(1e-4)); // the tolerance of the reference values
      CHECK(at(out, "kappa_P", row) == Approx(line[2]).epsilon(1e-4));
      CHECK(at(out, "damage", row) == Approx(line[3]).epsilon(1e-4).margin(1e-12));
    }
  // OOFEM's values carry 1 % of unbalance (doc/theory/damage-plastic-concrete.md, 6).
  CHECK(at(out, "stress_xx", 1) == Approx(-1.40303082e7).epsilon(0.015));
  CHECK(at(out, "stress_xx", 5) == Approx(-2.99825545e7).epsilon(0.015));
  CHECK(at(out, "stress_xx", 10) == Approx(-2.62968729e7).epsilon(0.015));
  // Past the peak: lateral over axial plastic strain is D_f, and kappa_D grows evenly.
  const auto gain = [&](const char *column) { return at(out, column, 10) - at(out, column, 9); };
  CHECK(gain("plastic_strain_yy") / gain("plastic_strain_xx") == Approx(-0.85).epsilon(1e-4));
  CHECK(gain("kappa_D") == Approx(5.52643e-6).epsilon(1e-4));

  const postprocess::CsvTable fine = answer(uniaxial(-1e-4, 50), m1);
  const double fine_rows[][2] = {{5, -14327151}, {10, -24794780}, {20, -29990244}, {25, -29407036}, {50, -25752107}};
  for (const auto &[row, stress] : fine_rows)
    CHECK(at(fine, "stress_xx", static_cast<int>(row)) == Approx(stress).epsilon(1e-4));
}

TEST_CASE("point-test: confined and hydrostatic paths of concrete have the published values", "[apps]")
{
  const postprocess::CsvTable confined = answer(ramp("strain_xx", "{}", -5e-4, 4), m1);
  CHECK(at(confined, "stress_xx", 1) == Approx(-15.212160e6).epsilon(1e-5));
  CHECK(at(confined, "stress_yy", 1) == Approx(-4.866728e6).epsilon(1e-5));
  CHECK(at(confined, "stress_xx", 4) == Approx(-41.015423e6).epsilon(1e-5));
  CHECK(at(confined, "stress_zz", 4) == Approx(-19.297160e6).epsilon(1e-5));
  CHECK(at(confined, "kappa_P", 4) == Approx(0.107101).epsilon(1e-5));

  const std::string normals   = "strain_xx,strain_yy,strain_zz";
  const std::string crush     = ramp(normals, "{0},{0},{0}", -5e-4, 5);
  const double      third[]   = {-22.260704e6, -36.081632e6, -48.335164e6, -59.947123e6, -71.338664e6};
  const auto        pressed   = answer(crush, m1);
  const auto        by_ninths = answer(crush, with(m1, "Vertex norm=0.1111111111111111"));
  for (int row = 1; row <= 5; ++row)
    CHECK(at(pressed, "stress_zz", row) == Approx(third[row - 1]).epsilon(1e-5));
  CHECK(at(by_ninths, "stress_xx", 1) == Approx(-21.266609e6).epsilon(1e-5));
  CHECK(at(by_ninths, "stress_xx", 5) == Approx(-59.160237e6).epsilon(1e-5));

  const auto   pulled    = answer(ramp(normals, "{0},{0},{0}", 5e-5, 4), m1);
  const double tension[] = {2.5e6, 1.723204e6, 0.958173e6, 0.555152e6};
  const double damage[]  = {0, 0.412698, 0.673436, 0.810793};
  for (int row = 1; row <= 4; ++row)
    {
      CHECK(at(pulled, "stress_yy", row) == Approx(tension[row - 1]).epsilon(1e-5));
      CHECK(at(pulled, "damage", row) == Approx(damage[row - 1]).epsilon(1e-5).margin(1e-15));
    }
}

TEST_CASE("point-test: a path that bends has the published stresses", "[apps]")
{
  // An independent program in 200 sub-steps per segment, tolerance 0.5 %.
  const double p1[] = {-1e-3, 2e-4, 1e-4, 0, 0, 3e-4}, p2[] = {-2e-3, 5e-4, 2e-4, 1e-4, 0, 6e-4};
  std::string  path = "strain_xx,strain_yy,strain_zz,strain_yz,strain_zx,strain_xy\n";
  for (int step = 1; step <= 400; ++step)
    for (int i = 0; i < 6; ++i)
      {
        const double part = step <= 200 ? step / 200.0 : (step - 200) / 200.0;
        path += fmt::format("{}{}", step <= 200 ? part * p1[i] : p1[i] + part * (p2[i] - p1[i]), i < 5 ? "," : "\n");
      }
  const postprocess::CsvTable out      = answer(path, m1);
  const double                first[]  = {-28.5145e6, -3.2598e6, -5.3643e6, 0, 0, 3.1568e6};
  const double                second[] = {-48.3628e6, -8.3497e6, -13.4673e6, 0.9726e6, 0, 4.7585e6};
  const char                 *names[]  = {"xx", "yy", "zz", "yz", "zx", "xy"};
  for (int i = 0; i < 6; ++i)
    {
      CHECK(at(out, std::string("stress_") + names[i], 200) == Approx(first[i]).epsilon(0.005).margin(1e-3));
      CHECK(at(out, std::string("stress_") + names[i], 400) == Approx(second[i]).epsilon(0.005).margin(1e-3));
    }
  CHECK(at(out, "kappa_P", 200) == Approx(0.226205).epsilon(0.005));
  CHECK(at(out, "kappa_P", 400) == Approx(0.294373).epsilon(0.005));
}

TEST_CASE("point-test: the concrete of the sequential mapping has its published curve", "[apps]")
{
  // doc/theory/damage-plastic-concrete.md, 6: OOFEM 2.3, to five digits.
  const postprocess::CsvTable out =
    answer(uniaxial(-3.5e-5, 90),
           {"Young modulus=33e9", "Poisson ratio=0.2", "Compressive strength=40e6", "Tensile strength=1e6",
            "Fracture energy=100", "Softening A=6", "Element size=2", "Reference size=2", "Largest increment=0"});
  const double published[][2] = {{10, -11.400}, {20, -22.208}, {30, -31.129}, {40, -36.663}, {50, -39.208},
                                 {60, -39.959}, {64, -39.999}, {70, -27.839}, {80, -15.088}, {90, -9.0535}};
  for (const auto &[row, stress] : published)
    CHECK(at(out, "stress_xx", static_cast<int>(row)) == Approx(1e6 * stress).epsilon(1e-4));
  CHECK(at(out, "kappa_P", 70) == Approx(1.0775).epsilon(1e-4));
  CHECK(at(out, "damage", 70) == Approx(0.30404).epsilon(1e-4));
  CHECK(at(out, "kappa_D", 70) == Approx(8.9096e-6).epsilon(1e-4));
}

TEST_CASE("point-test: one long row ends where many short ones do", "[apps]")
{
  Constants soft = with(m1, "Largest increment=2e-4");
  soft[1]        = "Poisson ratio=0.4";
  const auto out = answer("strain_xx,stress_yy,stress_zz\n-4e-4,0,0\n", soft);
  CHECK(at(out, "stress_xx", 1) == Approx(-11.65e6).epsilon(0.01));
  CHECK(at(out, "damage", 1) == 0);
}

TEST_CASE("point-test: elastic materials answer by Hooke's law, in strain, stress and mixed control", "[apps]")
{
  const double    E = 10e9, nu = 0.25;
  const Constants hooke = {"Young modulus=10e9", "Poisson ratio=0.25"};
  const auto      mixed = answer("strain_xx,stress_yy,stress_xy\n1e-3,2e6,1e6\n", hooke, "isotropic elastic");
  // zz is held: eps_zz = 0. sigma_yy, eps_xx given; from eps = (sigma - nu (others)) / E.
  const double s_yy = 2e6, e_xx = 1e-3;
  const double s_xx = (E * e_xx + nu * (1 + nu) * s_yy) / (1 - nu * nu);
  CHECK(at(mixed, "stress_xx", 1) == Approx(s_xx).epsilon(1e-10));
  CHECK(at(mixed, "stress_zz", 1) == Approx(nu * (s_xx + s_yy)).epsilon(1e-10));
  CHECK(at(mixed, "strain_xy", 1) == Approx(1e6 * 2 * (1 + nu) / E).epsilon(1e-10));

  // D = diag(1..6) GPa with D12 = 0.5 GPa.
  Constants full;
  for (int i = 1; i <= 6; ++i)
    for (int j = i; j <= 6; ++j)
      full.push_back(fmt::format("D{}{}={}", i, j, i == j ? i * 1e9 : (i == 1 && j == 2 ? 0.5e9 : 0.0)));
  const auto skew = answer("strain_xx,strain_yz\n2e-3,1e-3\n", full, "anisotropic elastic");
  CHECK(at(skew, "stress_xx", 1) == Approx(2e6).epsilon(1e-12));
  CHECK(at(skew, "stress_yy", 1) == Approx(1e6).epsilon(1e-12));
  CHECK(at(skew, "stress_yz", 1) == Approx(4e6).epsilon(1e-12));
}

TEST_CASE("point-test refuses a bad path, constant or material with its place", "[apps][S14]")
{
  const ScratchFolder folder;
  const auto          refused = [&](const std::string &path, const Constants &constants, const std::string &message,
                           const std::string &material = "damage-plastic concrete") {
    folder.file("path.csv", path);
    const Outcome outcome = run(folder.path(), command(material, constants));
    INFO(outcome.err);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(message));
    CHECK_FALSE(std::filesystem::exists(folder / "out.csv"));
    return outcome.err;
  };
  const std::string fine = "strain_xx\n1e-4\n";
  refused("strain_xx\n1e-4\nx\n", m1, "path.csv, line 3");
  refused("strain_xx,stress_yy\n", m1, "path.csv: has no row below the names of its columns");
  refused(std::string("strain_xx\n1e-4\n1\0e-4\n", 21), m1, "path.csv, line 3: holds a zero byte");
  refused("strain_x\n1e-4\n", m1, "column \"strain_x\" is not known. Did you mean \"strain_xx\"?");
  refused("strain_xx,stress_xx\n1e-4,0\n", m1, "strain and stress of the same component cannot both be given");
  refused(fine, with(m1, "Tensile strengh=1"), "\"Tensile strengh\" is not known. Did you mean \"Tensile strength\"?");
  refused(fine, {"Young modulus=30e9"}, "entries are not set and have no default:\n  \"Poisson ratio\" [-]: ");
  refused(fine, {"Young modulus=30e9"}, "\n  \"Tensile strength\" [Pa]: "); // all at once
  refused(fine, with(m1, "Tensile strength=40e6"),
          "Tensile strength = 40000000: must be below the compressive strength");
  refused(fine, with(m1, "Element size=0"), "element");
  refused(fine, m1, "Did you mean \"isotropic elastic\"?", "isotropic elastics");
  refused("stress_xx,stress_yy,stress_zz\n4e6,0,0\n", m1,
          "row 1: mixed control: the path from the last state can be followed over 7");
  refused("stress_xx,stress_yy,stress_zz\n4e6,0,0\n", m1, "Beyond a peak a component must be given in strain");
  // Strains alone are not blamed on stresses that nobody gave.
  const std::string far = refused("strain_xx\n1e-4\n1e6\n", with(m1, "Largest increment=2e-4"),
                                  "row 2: damage-plastic concrete: strain increment of");
  CHECK_THAT(far, Contains("All components are given in strain") && !Contains("stresses"));
  refused("strain_xx\n11\n", m1, "a strain of more than 1000 %");
  refused("strain_xx\n1e300\n", with(m1, "Largest increment=2e-4"),
          "strain increment of 1e+300 in one step"); // not in 301 digits
  // A law that fails nowhere answered with infinite stresses, and status 0.
  const Constants elastic = {"Young modulus=30e9", "Poisson ratio=0.2"};
  refused("strain_xx\n1e-4\n1e300\n", elastic, "row 2: a strain of 1e+300: must be from -1000 to 1000",
          "isotropic elastic");
  refused("stress_xx\n1e308\n", elastic, "row 1: a strain of 3e+297: must be from -1000 to 1000", "isotropic elastic");
}
