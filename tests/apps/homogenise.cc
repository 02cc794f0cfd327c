#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  // doc/theory/homogenisation.md, 5.
  const char *eight_spheres = "# periodic_cell 1 1 1\n"
                              "0.625 0.897 0.776 0.22\n0.225 0.300 0.874 0.22\n0.468 0.303 0.278 0.22\n"
                              "0.036 0.515 0.466 0.22\n0.508 0.871 0.361 0.22\n0.123 0.967 0.658 0.22\n"
                              "0.815 0.730 0.113 0.22\n0.921 0.123 0.092 0.22\n";
  // doc/theory/homogenisation.md, 5.
  const char *six_discs = "# periodic_cell 1 1 1\n"
                          "0.10 0.20 0 0.22\n0.55 0.15 0 0.22\n0.30 0.55 0 0.22\n"
                          "0.80 0.60 0 0.22\n0.05 0.85 0 0.22\n0.60 0.90 0 0.22\n";

  const std::vector<std::string> moduli = {"--normal-modulus", "1 Pa", "--shear-ratio", "0.2"};

  std::vector<std::string> command(std::vector<std::string> arguments)
  {
    arguments.insert(arguments.begin(), "homogenise");
    arguments.insert(arguments.end(), moduli.begin(), moduli.end());
    return arguments;
  }
} // namespace

TEST_CASE("homogenise writes the reference numbers of the cell of eight spheres", "[apps]")
{
  const ScratchFolder folder;
  folder.file("eight.txt", eight_spheres);
  const Outcome outcome = run(folder.path(), command({"eight.txt", "--interaction-ratio", "1.5", "-o", "out"}));
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("relaxed"));
  const auto json = nlohmann::json::parse(content_of(folder / "out/homogenised.json"));
  CHECK(json["particles"] == 8);
  CHECK(json["links"] == 37);
  CHECK(json["floaters"] == 0);
  CHECK(json["sum_LA_over_3V"].get<double>() == Approx(1.012725).margin(0.6e-6)); // digits printed there, all below
  CHECK(json["relaxed"]["E"].get<double>() == Approx(0.552921).margin(0.6e-6));
  CHECK(json["relaxed"]["nu"].get<double>() == Approx(0.199718).margin(0.6e-6));
  CHECK(json["relaxed"]["stiffness"][0][4].get<double>() == Approx(-0.07683566).margin(0.6e-8));
  CHECK(json["relaxed"]["stiffness"][5][5].get<double>() == Approx(0.2291952).margin(0.6e-7));
  CHECK(json["affine"]["E"].get<double>() == Approx(0.624201).margin(0.6e-6));
  CHECK(json["statistics"]["E"].get<double>() == Approx(0.626925).margin(0.6e-6));
  CHECK(json["isotropy"]["G"].get<double>() == Approx(0.22704).margin(0.6e-5));
  CHECK(json["isotropy"]["off"].get<double>() == Approx(0.13896).margin(0.6e-5));
  CHECK(json["residual"].get<double>() <= 1e-10);
}

TEST_CASE("homogenise gives plane stiffnesses of discs", "[apps]")
{
  const ScratchFolder folder;
  folder.file("six.txt", six_discs);
  const Outcome outcome =
    run(folder.path(), command({"six.txt", "--interaction-ratio", "1.25", "--thickness", "1", "-o", "out"}));
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto D = nlohmann::json::parse(content_of(folder / "out/homogenised.json"))["relaxed"]["stiffness"];
  CHECK(D[0][0].get<double>() == Approx(0.829303).margin(0.6e-6));
  CHECK(D[5][5].get<double>() == Approx(0.259156).margin(0.6e-6));
  CHECK(D[2][2].get<double>() == 0);
}

TEST_CASE("homogenise takes any law of links, one or several: a crystal of discs has the closed form (T8)", "[apps]")
{
  const ScratchFolder folder;
  // E = 2 sqrt(3) k_n (k_n + k_s)/(3 k_n + k_s) with k_n = E*, k_s = E*/2.5; nu = (k_n - k_s)/(3 k_n + k_s)
  const double young = 2 * std::sqrt(3.0) * 1.4 / 3.4, poisson = 0.6 / 3.4;
  folder.file("crystal.txt", "# periodic_cell 2 3.4641016151377544 1\nx y z radius material\n"
                             "0 0 0 1 first\n1 1.7320508075688772 0 1 second\n");
  const auto relaxed = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {"homogenise", "crystal.txt", "--interaction-ratio", "1.05", "--thickness", "1", "-o", "out"});
    const Outcome outcome = run(folder.path(), arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return nlohmann::json::parse(content_of(folder / "out/homogenised.json"))["relaxed"];
  };
  const auto law = [](const std::string &name) {
    return "    set Law = " + name + "\n    subsection " + name +
           "\n      set Effective modulus = 10e9\n      set Tensile strength = 1e6\n      set Cohesion = 1e6\n    "
           "end\n";
  };
  folder.file("laws.prm", "subsection Materials\n  subsection first\n" + law("flat-joint") +
                            "  end\n  subsection second\n" + law("contact-bond") +
                            "  end\nend\nsubsection Interfaces\n  subsection between\n"
                            "    set Material = first\n    set Other material = second\n" +
                            law("contact-bond") + "  end\nend\nsubsection Output\n  set Samples = 3\nend\n");
  for (const auto &arguments : std::vector<std::vector<std::string>>{
         {"--materials", "laws.prm"},
         {"--materials", "laws.prm", "-s", "Interfaces/between/contact-bond/Effective modulus=10e9"}})
    {
      const auto found = relaxed(arguments);
      CHECK(found["E"].get<double>() == Approx(10e9 * young).epsilon(1e-6));
      CHECK(found["nu"].get<double>() == Approx(poisson).epsilon(1e-6));
    }
  folder.file("crystal.txt", "# periodic_cell 2 3.4641016151377544 1\nx y z radius\n"
                             "0 0 0 1\n1 1.7320508075688772 0 1\n");
  for (const std::string name : {"flat-joint", "contact-bond"})
    {
      const auto found =
        relaxed({"--law", name, "-s", "Effective modulus=10e9", "-s", "Tensile strength=1e6", "-s", "Cohesion=1e6"});
      CHECK(found["E"].get<double>() == Approx(10e9 * young).epsilon(1e-6));
      CHECK(found["nu"].get<double>() == Approx(poisson).epsilon(1e-6));
    }
}

TEST_CASE("homogenise takes the law of the links once", "[apps]")
{
  const ScratchFolder folder;
  folder.file("eight.txt", eight_spheres);
  const auto refused = [&](std::vector<std::string> arguments, const std::string &why) {
    arguments.insert(arguments.begin(), {"homogenise", "eight.txt", "--interaction-ratio", "1.5"});
    const Outcome outcome = run(folder.path(), arguments);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(why));
  };
  refused({}, "give one of --normal-modulus with --shear-ratio, --law and --materials");
  refused({"--normal-modulus", "1 Pa"}, "--shear-ratio");
  refused({"--law", "flat-join"}, "Did you mean \"flat-joint\"?");
  refused({"--law", "CPM", "--normal-modulus", "1 Pa", "--shear-ratio", "1"}, "give one of");
  refused({"--law", "contact-bond", "-s", "Tensile strength=1e6", "-s", "Cohesion=1e6"}, "Effective modulus");
  refused({"--materials", "none.prm"}, "none.prm");
}

TEST_CASE("homogenise refuses what has no stiffness, with one message and status 2", "[apps]")
{
  const ScratchFolder folder;
  folder.file("free.txt", "0 0 0 1\n2 0 0 1\n");
  folder.file("eight.txt", eight_spheres);
  folder.file("six.txt", six_discs);
  const auto refused = [&](const std::vector<std::string> &arguments, const std::string &reason) {
    const Outcome outcome = run(folder.path(), command(arguments));
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(reason));
  };
  refused({"free.txt", "--interaction-ratio", "1.5", "-o", "out"}, "not a periodic packing");
  refused({"six.txt", "--interaction-ratio", "1.5"}, "--thickness");
  refused({"eight.txt", "--interaction-ratio", "1.5", "--thickness", "1"}, "do not lie in one plane");
  refused({"eight.txt", "--interaction-ratio", "0.5"}, "Interaction ratio = 0.5");
  refused({"missing.txt", "--interaction-ratio", "1.5"}, "missing.txt");
  CHECK(!std::filesystem::exists(folder / "out"));
}

TEST_CASE("a homogenisation scene sweeps over both ratios", "[apps]")
{
  const ScratchFolder folder;
  folder.file("eight.txt", eight_spheres);
  folder.file("sweep.prm",
              "set Kind = homogenisation\nsubsection Homogenisation\n  set Source = file\n  set File = eight.txt\n"
              "  set Normal modulus = 1 Pa\n  set Interaction ratios = 1.4, 1.5\n  set Shear ratios = 0.2, 1\nend\n");
  const Outcome outcome = run(folder.path(), {"run", "sweep.prm", "-o", "out"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto cases = nlohmann::json::parse(content_of(folder / "out/summary.json"))["cases"];
  REQUIRE(cases.size() == 4);
  CHECK(cases[2]["relaxed"]["E"].get<double>() == Approx(0.552921).margin(0.6e-6));
  CHECK(std::filesystem::exists(folder / "out/homogenised.csv"));
}

TEST_CASE("a cell without stiffness is reported to have none, by every solver", "[apps]")
{
  const ScratchFolder folder;
  // A dimer alone in its cell; and a string of spheres, each touching its own image, that resists nothing but being stretched.
  folder.file("dimer.txt", "# periodic_cell 5 5 5\n1 1 1 0.5\n1.7 1.6 1.3 0.5\n");
  folder.file("string.txt", "# periodic_cell 2.1 5 5\n1 1 1 1\n");
  const auto answer = [&](const std::string &packing, const std::string &solver) {
    const Outcome outcome =
      run(folder.path(), command({packing, "--interaction-ratio", "1.1", "--solver", solver, "-o", "out"}));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK_THAT(outcome.out, Contains("relaxed              none       none"));
    CHECK_THAT(outcome.out, Contains("has no moduli"));
    const auto json = nlohmann::json::parse(content_of(folder / "out/homogenised.json"));
    CHECK(json["relaxed"]["E"].is_null());
    CHECK(json["relaxed"]["nu"].is_null());
    CHECK(json["isotropy"].is_null());
    CHECK(json["statistics"]["E"].get<double>() > 0);
    return json["relaxed"];
  };
  for (const char *solver : {"automatic", "iterative", "direct"})
    {
      const auto dimer = answer("dimer.txt", solver);
      CHECK(dimer["resisted_strains"] == 0);
      for (const auto &row : dimer["stiffness"])
        for (const auto &entry : row)
          CHECK(entry.get<double>() == 0);
      const auto string = answer("string.txt", solver);
      CHECK(string["resisted_strains"] == 1);
      CHECK(string["stiffness"][0][0].get<double>() == Approx(M_PI * 2.1 / (5 * 5 * 2.1)).epsilon(1e-9)); // E A L/V
      CHECK(string["stiffness"][5][5].get<double>() == Approx(0).margin(1e-15));
    }
}

TEST_CASE("a loose tolerance does not give stiffness to a cell that has none", "[apps]")
{
  const ScratchFolder folder;
  folder.file("dimer.txt", "# periodic_cell 5 5 5\n1 1 1 0.5\n1.7 1.6 1.3 0.5\n");
  const Outcome outcome =
    run(folder.path(), command({"dimer.txt", "--interaction-ratio", "1.1", "--tolerance", "1e-2", "-o", "out"}));
  REQUIRE(outcome.status == 0);
  CHECK(nlohmann::json::parse(content_of(folder / "out/homogenised.json"))["relaxed"]["resisted_strains"] == 0);
}

TEST_CASE("a sweep over cells with and without moduli leaves out what is not", "[apps]")
{
  const ScratchFolder folder;
  folder.file("eight.txt", eight_spheres);
  folder.file("sweep.prm",
              "set Kind = homogenisation\nsubsection Homogenisation\n  set Source = file\n  set File = eight.txt\n"
              "  set Normal modulus = 1e9\n  set Interaction ratios = 1, 1.5\n  set Shear ratios = 0.2\nend\n");
  const Outcome outcome = run(folder.path(), {"run", "sweep.prm", "-o", "out"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto cases = nlohmann::json::parse(content_of(folder / "out/summary.json"))["cases"];
  CHECK(cases[0]["relaxed"]["E"].is_null());
  CHECK(cases[1]["relaxed"]["E"].get<double>() > 0.5);
  CHECK_THAT(content_of(folder / "out/homogenised.csv"), Contains("1,0.2,") && Contains(",none,none,none,none\n"));
}
