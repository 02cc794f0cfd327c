// One link of each bonded law along paths of displacements and forces: the exact answers T1 to T12 of doc/theory, to the digits given.
#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  constexpr double R = 1e-3, modulus = 10.38e9, k_n = modulus / (2 * R), k_s = k_n / 2.5; // [Pa/m]
  constexpr double tension = 0.29e6;

  using Words = std::vector<std::string>;

  /** What a link of mortar answers. @param more options and constants, the latter as "Key=value" */
  postprocess::CsvTable mortar(const std::string &law,
                               const std::string &path,
                               const Words       &more     = {},
                               const std::string &radius_1 = "1e-3",
                               const std::string &radius_2 = "1e-3")
  {
    const ScratchFolder folder;
    folder.file("path.csv", path);
    Words words     = {"link-test", "--law",      law,      "--path",     "path.csv", "-o",
                       "out.csv",   "--radius-1", radius_1, "--radius-2", radius_2};
    Words constants = {"Effective modulus=10.38e9", "Stiffness ratio=2.5", "Friction coefficient=0.21"};
    if (law != "linear")
      constants.insert(constants.end(), {"Tensile strength=0.29e6", "Cohesion=1.98e6"});
    if (law == "flat-joint" || law == "parallel-bond")
      constants.push_back("Friction angle=20.7");
    for (const std::string &word : more)
      (word.find('=') != std::string::npos ? constants : words).push_back(word);
    for (const std::string &constant : constants)
      words.insert(words.end(), {"-s", constant});
    const Outcome outcome = run(folder.path(), words);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return postprocess::read_csv_table(folder / "out.csv");
  }

  const Words plane = {"--dimension", "2", "--thickness", "1"};

  Words in_plane(Words more)
  {
    more.insert(more.end(), plane.begin(), plane.end());
    return more;
  }

  /** A column driven evenly from zero, the others constant. */
  std::string ramp(const std::string &names, const std::string &others, const double end, const int rows)
  {
    std::string path = names + "\n";
    for (int i = 1; i <= rows; ++i)
      path += fmt::format("{}{}\n", end * i / rows, others.empty() ? "" : "," + others);
    return path;
  }

  double largest(const std::vector<double> &values)
  {
    double most = 0;
    for (const double v : values)
      most = std::max(most, std::abs(v));
    return most;
  }
} // namespace

TEST_CASE("link-test breaks bonds in tension at 580 N, all elements at once (T1)", "[apps][laws]")
{
  const double opening = tension / k_n;
  for (const std::string law : {"contact-bond", "parallel-bond", "flat-joint"})
    {
      const auto out = mortar(law, ramp("normal_displacement [m]", "", 1.01 * opening, 1010), plane);
      CHECK(out.column("normal_force")[999] == 0);
      CHECK(out.column("normal_force")[998] == Approx(579.42).epsilon(1e-9));
      CHECK(out.column("normal_force")[499] == Approx(modulus * out.column("normal_displacement")[499]).epsilon(1e-12));
      CHECK(out.column("broken")[998] == 0);
      CHECK(out.column("broken")[999] == (law == "flat-joint" ? 4 : 1));
      // Of the step in which it breaks the work is that of the forces before and after.
      CHECK(out.column("dissipated_by_damage")[1009] == Approx(0.5 * 580 * opening).epsilon(2e-3));
    }
  CHECK(opening == Approx(5.58767e-8).epsilon(1e-6));
}

TEST_CASE("link-test shears flat joints at c - sigma tan phi, then at friction (T2)", "[apps][laws]")
{
  const double published[][3] = {
    {-5e6, 3.8693426e6, 1.05e6}, {-1e6, 2.3578685e6, 0.21e6}, {0, 1.98e6, 0}, {0.2e6, 1.9044263e6, 0}};
  for (const auto &[stress, peak, residual] : published)
    {
      const int         rows = 20000;
      const double      end  = 1.01 * peak / k_s;
      const std::string held = fmt::format("{}", stress / k_n);
      const auto out = mortar("flat-joint", ramp("shear_displacement_1,normal_displacement", held, end, rows), plane);
      CHECK(largest(out.column("shear_force_1")) / (2 * R) == Approx(peak).epsilon(1.0 / rows));
      CHECK(std::abs(out.column("shear_force_1").back()) / (2 * R) == Approx(residual).epsilon(1e-9).margin(1e-3));
      CHECK(out.column("shear_force_1")[0] < 0); // it opposes the displacement
      CHECK(out.column("broken").back() == 4);
    }
}

TEST_CASE("link-test bends flat joints about a fixed middle (T3)", "[apps][laws]")
{
  const double unit           = tension / (k_n * R);
  const double published[][2] = {{2, 0.386667}, {4, 0.257778}, {8, 0.220952}};
  for (const auto &[elements, moment] : published)
    {
      const double first = unit / (1 - 1 / elements);
      const auto   out   = mortar("flat-joint", ramp("bending_1 [rad]", "", first, 1000),
                                  in_plane({fmt::format("Elements={}", elements)}));
      CHECK(-out.column("bending_moment_1")[998] == Approx(0.999 * moment).epsilon(2e-6));
      CHECK(out.column("broken")[998] == 0);
      CHECK(out.column("broken")[999] == 1);
    }
  const auto after = mortar("flat-joint", fmt::format("bending_1\n{}\n{}\n", 1.6 * unit, 3 * unit), plane);
  CHECK(after.column("normal_force")[0] == Approx(-174.0).epsilon(1e-9));
  CHECK(std::abs(after.column("bending_moment_1")[0]) == Approx(0.174).epsilon(1e-9));
  CHECK(after.column("normal_force")[1] == Approx(-326.25).epsilon(1e-9));
  CHECK(std::abs(after.column("bending_moment_1")[1]) == Approx(0.32625).epsilon(1e-9));
  const auto bond = mortar("parallel-bond", ramp("bending_1", "", unit, 1000), plane);
  CHECK(-bond.column("bending_moment_1")[998] == Approx(0.999 * 0.193333).epsilon(2e-6));
  CHECK(bond.column("bending_moment_1")[999] == Approx(0).margin(1e-9));
  const auto blind = mortar("parallel-bond", ramp("bending_1", "", 5 * unit, 10), in_plane({"Moment contribution=0"}));
  CHECK(largest(blind.column("broken")) == 0);
}

TEST_CASE("link-test bends flat joints without axial force until one element is left (T4)", "[apps][laws]")
{
  const std::vector<double> four = {0.257778, 0.163125, 0.096667},
                            six  = {0.232000, 0.167824, 0.114568, 0.072500, 0.042963};
  for (const auto &moments : {four, six})
    {
      const int    n = static_cast<int>(moments.size()) + 1, rows = 4000;
      const double last = n == 4 ? 4e-4 : 5e-4;
      const auto   out  = mortar("flat-joint", ramp("bending_1,normal_force [N]", "0", last, rows),
                                 in_plane({fmt::format("Elements={}", n)}));
      CHECK(largest(out.column("normal_force")) < 1e-6);
      CHECK(out.column("broken").back() == n - 1); // the last cannot fail in tension
      for (int k = 0; k < n - 1; ++k)
        {
          const double b = 2 * R * (n - k) / n, l = 2 * R / n;
          const double turn = 2 * tension / (k_n * (b - l));
          // The row before the break, and the one after.
          const auto row = static_cast<std::size_t>(std::ceil(turn / last * rows - 1e-9)) - 1;
          CHECK(out.column("broken")[row - 1] == k);
          CHECK(out.column("broken")[row] == k + 1);
          CHECK(-out.column("bending_moment_1")[row - 1] ==
                Approx(moments[static_cast<std::size_t>(k)] * out.column("bending_1")[row - 1] / turn).epsilon(1e-5));
        }
      const double l = 2 * R / n;
      CHECK(-out.column("bending_moment_1").back() == Approx(k_n * l * l * l * last / 12).epsilon(1e-6));
    }
}

TEST_CASE("link-test closes a slit element partly (T5)", "[apps][laws]")
{
  const auto out =
    mortar("flat-joint", "normal_displacement,bending_1\n-0.2e-6,4e-4\n", in_plane({"Elements=1", "Slit fraction=1"}));
  CHECK(out.column("normal_force")[0] == Approx(-2335.5).epsilon(1e-9));
  CHECK(out.column("bending_moment_1")[0] == Approx(-1.16775).epsilon(1e-9));
  CHECK(out.column("broken")[0] == 0);
}

TEST_CASE("link-test bends a slit joint without axial force about its edge, g = R theta", "[apps][laws]")
{
  // Nothing presses: the joint touches at its rim alone, so that every row has an answer.
  const auto out =
    mortar("flat-joint", ramp("bending_1,normal_force [N]", "0", 4e-4, 8), in_plane({"Elements=3", "Slit fraction=1"}));
  REQUIRE(out.rows() == 8);
  for (std::size_t row = 0; row < out.rows(); ++row)
    {
      CHECK(out.column("normal_displacement")[row] == Approx(R * out.column("bending_1")[row]).epsilon(1e-5));
      CHECK(out.column("normal_force")[row] == Approx(0).margin(1e-6));
      CHECK(out.column("bonded_elements")[row] == 0);
    }
}

TEST_CASE("link-test breaks parallel bonds under an eccentric pull that is held (T6)", "[apps][laws]")
{
  const double published[][2] = {{2, 8000}, {3, 10.472}};
  for (const auto &[dimension, load] : published)
    {
      std::string path = "normal_force [N], bending_moment_1 [N m]\n";
      for (const double part : {0.5, 0.999, 0.9999})
        path += fmt::format("{},{}\n", part * load, part * load * 0.5e-3);
      const Words more = {"Tensile strength=10e6", "Cohesion=1e9", "--dimension", fmt::format("{}", int(dimension))};
      const auto  out  = mortar("parallel-bond", path, more);
      CHECK(largest(out.column("broken")) == 0);
      CHECK(out.column("normal_force")[2] == Approx(0.9999 * load).epsilon(1e-9));
      CHECK(out.column("bending_moment_1")[2] == Approx(0.9999 * load * 0.5e-3).epsilon(1e-9));
      const ScratchFolder folder;
      folder.file("path.csv", path + fmt::format("{},{}\n", 1.0001 * load, 1.0001 * load * 0.5e-3));
      const Outcome outcome =
        run(folder.path(), {"link-test", "--law", "parallel-bond", "--path", "path.csv", "--dimension",
                            fmt::format("{}", int(dimension)), "-s", "Effective modulus=10.38e9", "-s",
                            "Tensile strength=10e6", "-s", "Cohesion=1e9"});
      CHECK(outcome.status == 1);
      CHECK_THAT(outcome.err, Contains("row 4") && Contains("The rows before it are written"));
      CHECK(std::count(outcome.out.begin(), outcome.out.end(), '\n') == 4); // a line of names, three rows
    }
}

TEST_CASE("link-test answers the same when the particles change places or the path is turned about the link (T12)",
          "[apps][laws]")
{
  const auto same = [](const postprocess::CsvTable &one, const postprocess::CsvTable &other, const Words &columns) {
    for (const std::string &name : columns)
      for (std::size_t row = 0; row < one.rows(); ++row)
        {
          INFO(name << ", row " << row);
          const double size = largest(one.column(name));
          CHECK(std::abs(one.column(name)[row] - other.column(name)[row]) <= 1e-12 * size);
        }
  };
  // Pulled, sheared and bent until it breaks, whole or in parts; pressed together and slid then.
  const std::string path = "normal_displacement,shear_displacement_1,bending_1\n"
                           "2e-8,1e-8,2e-5\n3e-8,5e-8,8e-5\n3e-8,1e-7,2e-4\n-4e-8,2e-7,2e-4\n-4e-8,-5e-7,0\n";
  const std::string sheared =
                      "normal_displacement,shear_displacement_1\n2e-8,1e-8\n3e-8,5e-7\n-4e-8,1e-6\n-4e-8,2e-6\n",
                    turned = "normal_displacement,shear_displacement_2\n2e-8,1e-8\n3e-8,5e-7\n-4e-8,1e-6\n-4e-8,2e-6\n";
  for (const std::string law : {"contact-bond", "parallel-bond", "flat-joint"})
    {
      INFO(law);
      const bool  bends      = law != "contact-bond";
      const auto &driven     = bends ? path : sheared;
      Words       quantities = {"normal_force", "shear_force_1", "broken"};
      if (bends)
        quantities.emplace_back("bending_moment_1");
      const auto one = mortar(law, driven, plane, "1e-3", "1.7e-3");
      CHECK(largest(one.column("broken")) > 0);
      same(one, mortar(law, driven, plane, "1.7e-3", "1e-3"), quantities);

      auto       in_space = mortar(law, sheared);
      const auto other    = mortar(law, turned);
      CHECK(largest(in_space.column("broken")) > 0);
      CHECK(largest(in_space.column("shear_force_1")) > 0);
      same(in_space, other, {"normal_force", "broken"});
      for (std::string &name : in_space.names)
        if (name == "shear_force_1")
          name = "shear_force_2";
        else if (name == "shear_force_2")
          name = "shear_force_1";
      same(in_space, other, {"shear_force_2"});
    }
}

TEST_CASE("link-test goes on with a linear contact when a bond is gone, and slides it", "[apps][laws]")
{
  const auto out =
    mortar("flat-joint", "normal_displacement,shear_displacement_1\n1e-7,0\n-1e-8,0\n-1e-8,1e-6\n", plane);
  CHECK(out.column("broken") == std::vector<double>{4, 4, 4});
  CHECK(out.column("normal_force")[0] == 0);
  CHECK(out.column("normal_force")[1] == Approx(-1e-8 * modulus));
  CHECK(out.column("shear_force_1")[2] == Approx(-0.21 * 1e-8 * modulus));
}

TEST_CASE("link-test closes a joint that has slid while open where it was made, by less or more than its length (6.6)",
          "[apps][laws]")
{
  // Made of particles that overlap by two micrometres, as they lie in a packing; it opens by one and does not come off.
  for (const double slip : {1.9e-3, 2.2e-3})
    {
      const std::string s = fmt::format("{}", slip);
      const auto        out =
        mortar("flat-joint",
               "normal_displacement,shear_displacement_1\n1e-6,0\n1e-6," + s + "\n0.5e-6," + s + "\n-1e-7," + s + "\n",
               in_plane({"--gap", "-2e-6"}));
      INFO("slid by " << slip);
      CHECK(out.column("broken").back() == 4);
      CHECK(out.column("normal_force")[1] == 0);
      CHECK(out.column("normal_force")[2] == 0);
      CHECK(out.column("normal_force")[3] == Approx(-1e-7 * modulus).epsilon(1e-9));
    }
}

TEST_CASE("link-test loses no energy to a contact softer than the joint whose place it takes", "[apps][laws]")
{
  std::string path = "normal_displacement,shear_displacement_1\n-1e-7,0\n";
  for (int i = 1; i <= 220; ++i)
    path += fmt::format("-1e-7,{}\n", 1e-5 * i);
  const auto out  = mortar("flat-joint", path, in_plane({"Slit fraction=1", "Contact effective modulus=2e9"}));
  const auto rubs = out.column("dissipated_by_sliding"), broke = out.column("dissipated_by_damage");
  CHECK(out.column("replaced").back() == 1);
  for (std::size_t row = 1; row < out.rows(); ++row)
    REQUIRE(rubs[row] + broke[row] >= (rubs[row - 1] + broke[row - 1]) * (1 - 1e-12));
  CHECK(out.column("normal_force").back() == Approx(-1e-7 * modulus).epsilon(1e-9));
}

TEST_CASE("link-test bends a joint without bonds at no normal force until it stands on its edge", "[apps][laws]")
{
  for (const int dimension : {2, 3})
    for (const int rows : {1, 10, 400})
      {
        INFO("dimension " << dimension << ", rows " << rows);
        const auto out = mortar("flat-joint", ramp("bending_1 [rad],normal_force [N]", "0", 4e-4, rows),
                                {"Slit fraction=1", "--dimension", std::to_string(dimension), "--thickness", "1"});
        REQUIRE(out.rows() == static_cast<std::size_t>(rows));
        for (std::size_t row = 0; row < out.rows(); ++row)
          {
            const double turn = out.column("bending_1")[row], gap = out.column("normal_displacement")[row];
            INFO("row " << row << ", gap over R turn " << gap / (R * turn));
            // In space elements are closed or open by their centroids, inside the rim.
            REQUIRE(gap <= R * turn * (1 + 1e-12));
            // Once its edge is clear, be it by rounding, the joint is gone, and nothing moves the pair any more.
            const bool gone = row > 0 && gap == out.column("normal_displacement")[row - 1];
            if (!gone)
              REQUIRE(gap >= (dimension == 2 ? 1 - 1e-4 : 0.6) * R * turn);
            REQUIRE(std::abs(out.column("normal_force")[row]) < 1e-9 * k_n * R * turn * 2 * R);
          }
      }
}

TEST_CASE("bonds of infinite strength hold whatever is done to them; other constants cannot be infinite",
          "[apps][laws]")
{
  const Words unbreakable = {"Tensile strength=inf", "Cohesion=inf"};
  for (const std::string law : {"contact-bond", "parallel-bond", "flat-joint"})
    {
      INFO(law);
      const auto out =
        mortar(law, "normal_displacement,shear_displacement_1\n1e-4,0\n1e-4,1e-4\n", in_plane(unbreakable));
      CHECK(largest(out.column("broken")) == 0);
      CHECK(out.column("normal_force").back() == Approx(1e-4 * modulus).epsilon(1e-9));
      CHECK(-out.column("shear_force_1").back() == Approx(1e-4 * modulus / 2.5).epsilon(1e-9));
    }
  const ScratchFolder folder;
  folder.file("path.csv", "normal_displacement\n1e-8\n");
  const Outcome outcome =
    run(folder.path(), {"link-test", "--law", "flat-joint", "--path", "path.csv", "-s", "Effective modulus=inf", "-s",
                        "Tensile strength=1e6", "-s", "Cohesion=1e6"});
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains("Effective modulus = inf: expected a number > 0"));
}

TEST_CASE("link-test takes displacements and forces in multiples of their units", "[apps]")
{
  const auto force_of = [](const std::string &path) { return mortar("contact-bond", path).column("normal_force"); };
  const std::vector<double> metres = force_of("normal_displacement [m]\n-1e-7\n-2e-7\n"),
                            small  = force_of("normal_displacement [um]\n-0.1\n-0.2\n");
  CHECK(metres[1] != 0);
  CHECK(small[1] == Approx(metres[1]).epsilon(1e-12));
  CHECK(force_of("normal_force [kN]\n-1e-5\n")[0] == Approx(-0.01).epsilon(1e-9));
}

TEST_CASE("link-test refuses columns that a law or a plane does not have, with their place", "[apps][S14]")
{
  const ScratchFolder folder;
  const auto          refused = [&](const std::string &path, const Words &more, const std::string &message) {
    folder.file("path.csv", path);
    Words words = {"link-test",
                   "--law",
                   "contact-bond",
                   "--path",
                   "path.csv",
                   "-s",
                   "Effective modulus=1e9",
                   "-s",
                   "Tensile strength=1e6",
                   "-s",
                   "Cohesion=1e6"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(folder.path(), words);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(message));
  };
  refused("normal_displacement,bending_1\n0,0\n", {}, "resists no rotation");
  refused("normal_displacement,shear_displacement_2\n0,0\n", {"--dimension", "2"}, "a link in the plane has none");
  refused("normal_displacement,normal_force\n0,0\n", {}, "give one of them");
  refused("normal_displacement [kN]\n0\n", {}, "column normal_displacement is in [kN], expected [m]");
  refused("normal_strain,normal_displacement\n0,0\n", {}, "do not go together");
  refused("normal_displacement\n-1\n", {}, "out of range");
}
