#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::vector<std::string> with_constants(std::vector<std::string> arguments,
                                          const std::string       &relative_ductility,
                                          const std::string       &cohesion,
                                          const std::string       &friction)
  {
    for (const std::string &constant :
         {std::string("Normal modulus=1e9"), std::string("Shear ratio=0.5"), std::string("Limit elastic strain=1e-4"),
          "Relative ductility=" + relative_ductility, "Cohesion=" + cohesion, "Friction coefficient=" + friction})
      arguments.insert(arguments.end(), {"-s", constant});
    return arguments;
  }

  postprocess::CsvTable
  answer(const std::string &path, const std::string &cohesion = "1e9", const std::string &friction = "0")
  {
    const ScratchFolder folder;
    folder.file("path.csv", path);
    const Outcome outcome =
      run(folder.path(), with_constants({"link-test", "--law", "CPM", "--path", "path.csv", "-o", "out.csv"}, "1.5",
                                        cohesion, friction));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return postprocess::read_csv_table(folder / "out.csv");
  }
} // namespace

TEST_CASE("link-test gives the published answer of the CPM law in tension", "[apps]")
{
  // doc/theory/cpm.md, 3, which agrees with the published law tester to 1e-9; digits as they were given.
  const double                published[][4] = {{1.0e-4, 0, 100000, 0},
                                                {1.1e-4, 0.149539104515, 93550.6985, 0.0644930150},
                                                {1.5e-4, 0.522312459617, 71653.1311, 0.2834686894},
                                                {2.5e-4, 0.852848223531, 36787.9441, 0.6321205588}};
  const postprocess::CsvTable out            = answer("normal_strain\n1.0e-4\n1.1e-4\n1.5e-4\n2.5e-4\n");
  REQUIRE(out.rows() == 4);
  for (std::size_t i = 0; i < 4; ++i)
    {
      CHECK(out.column("kappa")[i] == Approx(published[i][0]).epsilon(1e-12));
      CHECK(out.column("damage")[i] ==
            Approx(published[i][1]).margin(2e-12)); // twelve printed digits, the second cut off
      CHECK(out.column("normal_stress")[i] == Approx(published[i][2]).epsilon(1e-9));
      CHECK(out.column("strength_damage")[i] == Approx(published[i][3]).epsilon(1e-9).margin(1e-12));
    }
}

TEST_CASE("link-test takes strains in per cent where the header says so", "[apps]")
{
  const postprocess::CsvTable plain = answer("normal_strain\n1.1e-4\n1.5e-4\n"),
                              shown = answer("normal_strain [%]\n1.1e-2\n1.5e-2\n");
  for (std::size_t row = 0; row < 2; ++row)
    CHECK(shown.column("normal_stress")[row] == Approx(plain.column("normal_stress")[row]).epsilon(1e-12));
}

TEST_CASE("link-test dissipates 20 J/m^3 of damage in tension to failure and then breaks the link", "[apps]")
{
  // E eps_0 (eps_0/2 + eps_f) = 1e9 * 1e-4 * (0.5e-4 + 1.5e-4): doc/theory/cpm.md, 3.
  const postprocess::CsvTable out = answer("normal_strain\n0\n1e-3\n1.4e-3\n2e-3\n");
  CHECK(out.column("broken") == std::vector<double>{0, 0, 0, 1});
  // At 1.4e-3 the strength left is e^-8.67 = 1.7e-4, and so is the part of the softening area that is missing.
  CHECK(out.column("dissipated_by_damage")[2] == Approx(20).epsilon(1e-3));
  CHECK(out.column("normal_stress")[3] == 0);
}

TEST_CASE("link-test returns a shear overload to the strength exactly and keeps the plastic strain", "[apps]")
{
  // doc/theory/cpm.md, 2: one step with twice the shear strength R, then no further strain: the trial
  // stress of the second step must equal R. Here R = c_0 = 1e4 Pa, G = 5e8 Pa: twice R at a shear strain of 4e-5.
  const postprocess::CsvTable out =
    answer("shear_strain_2, normal_strain\n4e-5, 0\n4e-5, 0\n# back to the plastic strain\n2e-5, 0\n", "1e4");
  CHECK(out.column("shear_stress_2")[0] == Approx(1e4).epsilon(1e-12));
  CHECK(out.column("shear_stress_2")[1] == Approx(1e4).epsilon(1e-12));
  CHECK(out.column("plastic_shear_strain_2")[1] == Approx(2e-5).epsilon(1e-12));
  CHECK(std::abs(out.column("shear_stress_2")[2]) < 1e-8);
  CHECK(out.column("shear_stress_1")[2] == 0);
  CHECK(out.column("dissipated_by_sliding")[1] == Approx(1e4 * 2e-5).epsilon(1e-12)); // R times the plastic strain
}

TEST_CASE("link-test raises the shear strength with compression by the friction coefficient", "[apps]")
{
  // (2.18) of Stransky (2018): strength c_0 - sigma_N tan(phi); sigma_N = -1e9 * 1e-4.
  const postprocess::CsvTable out = answer("normal_strain,shear_strain_1\n-1e-4,1\n", "1e4", "0.8");
  CHECK(out.column("shear_stress_1")[0] == Approx(1e4 + 0.8 * 1e5).epsilon(1e-12));
}

TEST_CASE("link-test refuses a bad path or constant with its place", "[apps][S14]")
{
  const ScratchFolder folder;
  const auto          refused = [&](const std::string &path, const std::string &message) {
    folder.file("path.csv", path);
    const Outcome outcome =
      run(folder.path(), with_constants({"link-test", "--law", "CPM", "--path", "path.csv"}, "1.5", "1e4", "0"));
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(message));
    CHECK(outcome.out.empty());
  };
  refused("normal_strain\n1e-4\nx\n", "path.csv, line 3");
  refused("normal_strain\n", "path.csv: has no row below the names of its columns");
  refused("normal_strain,shear_strain_1\n1e-4\n", "path.csv, line 2");
  refused("normal_strain,shear_strain\n1e-4,0\n",
          "column \"shear_strain\" is not known. Did you mean \"shear_strain_1\"?");
  refused("shear_strain_1\n0\n", "normal_strain");
  folder.file("path.csv", "normal_strain\n0\n");
  const Outcome missing =
    run(folder.path(), {"link-test", "--law", "CPM", "--path", "path.csv", "-s", "Normal modulus=1e9"});
  CHECK(missing.status == 2);
  CHECK_THAT(missing.err,
             Contains("5 entries are not set and have no default:\n") && Contains("\n  \"Shear ratio\" [-]: G/E"));
  const Outcome unknown =
    run(folder.path(), {"link-test", "--law", "CPM", "--path", "path.csv", "-s", "Normal modulos=1e9"});
  CHECK_THAT(unknown.err, Contains("\"Normal modulos\" is not known. Did you mean \"Normal modulus\"?"));
  CHECK(run(folder.path(), {"link-test", "--law", "CPM", "--path", "none.csv"}).status == 2);
}

TEST_CASE("link-test sent into a file by the shell is written after what stands there", "[apps]")
{
  const ScratchFolder folder;
  folder.file("path.csv", "normal_strain\n1e-4\n");
  const std::string log     = folder.file("log.txt", "kept\n");
  const std::string command = places::program() + " link-test --law linear --path " + (folder / "path.csv").string() +
                              " -s \"Effective modulus=1e9\" >> " + log;
  REQUIRE(std::system(command.c_str()) == 0);
  CHECK_THAT(content_of(log), Catch::StartsWith("kept\nnormal_strain"));
}

TEST_CASE("link-test drives every law there is, whatever the case of its name", "[apps]")
{
  const ScratchFolder folder;
  folder.file("path.csv", "normal_strain,shear_strain_1\n-1e-4,0\n-1e-4,1e-4\n2e-4,1e-4\n");
  const auto of = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"link-test", "--path", "path.csv", "-o", "out.csv", "--law"});
    const Outcome outcome = run(folder.path(), words);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return postprocess::read_csv_table(folder / "out.csv");
  };
  const auto linear = of({"Linear", "-s", "Effective modulus=1e9", "-s", "Friction coefficient=0.5"});
  CHECK(linear.column("normal_stress")[0] == Approx(-1e5)); // E* times the strain
  CHECK(linear.column("shear_stress_1")[1] == Approx(4e4)); // E*/2.5, below 0.5 of the pressure
  CHECK(linear.column("normal_stress")[2] == 0);
  const auto bond =
    of({"parallel-bond", "-s", "Effective modulus=1e9", "-s", "Tensile strength=1.5e5", "-s", "Cohesion=1e6"});
  CHECK(bond.column("normal_stress")[0] == Approx(-2e5)); // bond and contact
  CHECK(bond.column("broken") == std::vector<double>{0, 0, 1});
  CHECK(bond.column("normal_stress")[2] == 0);
}

TEST_CASE("link-test drives the options of the CPM law, and with a time from row to row those that depend on the rate",
          "[apps]")
{
  const ScratchFolder folder;
  folder.file("press.csv", "normal_strain\n-6e-4\n-5e-4\n-2e-4\n");
  const auto drive = [&](const std::string &path, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"link-test", "--law", "CPM", "--path", path, "-o", "out.csv"};
    for (const char *constant : {"Normal modulus=30e9", "Shear ratio=0.5", "Limit elastic strain=1e-4",
                                 "Relative ductility=5", "Cohesion=3.5e6", "Friction coefficient=0.8"})
      arguments.insert(arguments.end(), {"-s", constant});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(folder.path(), arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return postprocess::read_csv_table(folder / "out.csv");
  };
  const auto pressed = drive("press.csv", {"-s", "Compression yield strain=-2e-4", "-s", "Compression hardening=0.5"});
  CHECK(pressed.column("normal_stress")[0] == Approx(-12e6).epsilon(1e-12)); // doc/theory/cpm-options.md, 1
  CHECK(pressed.column("plastic_strain")[0] == Approx(-2e-4).epsilon(1e-12));
  CHECK(pressed.column("normal_stress")[1] == Approx(-9e6).epsilon(1e-11));
  CHECK(pressed.column("dissipated_by_sliding")[2] == Approx(0.5 * 12e6 * 2e-4).epsilon(1e-9)); // of one large step

  // One row from rest with M = 1: a e^beta = a/(1 + eps_0 tau/dt) with a = omega e.
  folder.file("pull.csv", "normal_strain\n3e-4\n");
  const auto slow  = drive("pull.csv", {"-s", "Damage time=100", "-s", "Damage rate exponent=1"});
  const auto quick = drive("pull.csv", {"-s", "Damage time=100", "-s", "Damage rate exponent=1", "--row-time", "1e-2"});
  const double omega = slow.column("damage")[0], gap = omega * 3e-4;
  CHECK(slow.column("normal_stress")[0] == Approx(30e9 * (1 - omega) * 3e-4).epsilon(1e-12));
  CHECK(quick.column("damage_strain")[0] == Approx(gap / (1 + 1e-4 * 100 / 1e-2)).epsilon(1e-12));
  CHECK(quick.column("normal_stress")[0] == Approx(30e9 * (3e-4 - gap / 2)).epsilon(1e-12));
  CHECK(quick.column("dissipated_by_rate")[0] > 0);
}
