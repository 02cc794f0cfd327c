// breccia invert: constants that give wanted responses, by the surfaces of analyses.
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** analysis.json of a published table. */
  std::string
  analysed(const std::string &table, const std::string &response, const std::string &factors, const std::string &model)
  {
    const ScratchFolder folder;
    const Outcome       outcome =
      run(folder.path(), {"analyse", places::sources() + "/apps/scenes/tables/" + table, "--response", response,
                          "--factors", factors, "--model", model, "-o", "out"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return content_of(folder / "out/analysis.json");
  }

  /** The surfaces of the published calibration of concrete, fitted to its runs, once for all tests. */
  void put_published(const ScratchFolder &folder)
  {
    static const std::string strength = analysed("concrete_strength.csv", "sigma_u", "sigc,tauc", "quadratic");
    static const std::string modulus  = analysed("concrete_modulus.csv", "E", "Ec,kn_ks,mu,Ecj,kn_ks_j", "quadratic");
    static const std::string poisson  = analysed("concrete_orthogonal.csv", "nu", "Ec,kn_ks,mu,kn_ks_j", "linear");
    folder.file("strength.json", strength);
    folder.file("modulus.json", modulus);
    folder.file("poisson.json", poisson);
  }

  const std::vector<std::string> all_surfaces = {"strength.json", "modulus.json", "poisson.json"};

  /** The bounds of the paper. */
  const std::vector<std::string> published_box = {"--box", "sigc=10,30", "--box", "tauc=10,30"};

  Outcome
  inverted(const ScratchFolder &folder, const std::vector<std::string> &surfaces, const std::vector<std::string> &more)
  {
    std::vector<std::string> words = {"invert"};
    words.insert(words.end(), surfaces.begin(), surfaces.end());
    words.insert(words.end(), more.begin(), more.end());
    return run(folder.path(), words);
  }

  nlohmann::json inversion_in(const ScratchFolder &folder)
  {
    return nlohmann::json::parse(content_of(folder / "out/inversion.json"));
  }

  /** A surface that a user writes by hand. */
  std::string surface(const std::string &response, const std::string &box, const std::string &terms)
  {
    return R"({"response": {"name": ")" + response + R"("}, "surface": {"box": )" + box + R"(, "terms": )" + terms +
           "}}";
  }
} // namespace

TEST_CASE("breccia invert meets all five published targets of concrete exactly, and says how far answers spread",
          "[apps]")
{
  const ScratchFolder folder;
  put_published(folder);
  const double targets[5][3] = {
    {59.67, 32.68, 0.201}, {42.67, 26.78, 0.209}, {36.54, 25.66, 0.218}, {47.67, 21.54, 0.222}, {43.6, 24.67, 0.222}};
  for (const auto &target : targets)
    {
      std::vector<std::string> words = published_box;
      words.insert(words.end(), {"--target", "sigma_u=" + std::to_string(target[0]), "--target",
                                 "E=" + std::to_string(target[1]), "--target", "nu=" + std::to_string(target[2]),
                                 "--starts", "1", "--generations", "50", "--population", "50", "-o", "out"});
      const Outcome outcome = inverted(folder, all_surfaces, words);
      INFO(outcome.err);
      REQUIRE(outcome.status == 0);
      CHECK_THAT(outcome.out, !Contains("warning"));
      const auto found = inversion_in(folder);
      CHECK(found["reached"] == true);
      CHECK(found["misfit"].get<double>() < 1e-10);
      CHECK(found["solutions"].size() > 50);
      for (const auto &solution : found["solutions"])
        CHECK(solution["misfit"].get<double>() < 1e-6);
      CHECK(found["constants"].size() == 7); // four more than targets: no answer is the only one
      for (const auto &[name, constant] : found["constants"].items())
        {
          INFO(name);
          CHECK(constant["value"].get<double>() >= constant["box"][0].get<double>());
          CHECK(constant["value"].get<double>() <= constant["box"][1].get<double>());
          CHECK(constant["largest"].get<double>() > constant["least"].get<double>());
        }
    }
}

TEST_CASE("the report of an inversion is one page with its figures, answers and picture", "[apps]")
{
  const ScratchFolder folder;
  put_published(folder);
  const Outcome outcome = inverted(folder, all_surfaces,
                                   {"--target", "sigma_u=42.67", "--target", "E=26.78", "--target", "nu=0.209",
                                    "--starts", "1", "--generations", "30", "--population", "50", "-o", "out"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const std::string page = content_of(folder / "out/report.html");
  CHECK_THAT(page,
             Contains("data:image/png;base64,iVBORw0KGgo") && Contains("sigma_u") && Contains("equally good answers"));
  CHECK_THAT(page, !Contains("src=\"http") && !Contains("href=") && !Contains("<script"));
  CHECK(page.size() <= 2000000);
}

TEST_CASE("breccia invert names the target that cannot be met, and by how much it is missed", "[apps]")
{
  const ScratchFolder folder;
  put_published(folder);
  std::vector<std::string> words = published_box;
  words.insert(words.end(), {"--target", "sigma_u=15", "--target", "E=30", "--target", "nu=0.2", "--starts", "1",
                             "--generations", "50", "--population", "50", "-o", "out"});
  const Outcome outcome = inverted(folder, all_surfaces, words);
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("warning: sigma_u = 15 cannot be met within the box: the surface comes to 19.98"));
  const auto found = inversion_in(folder);
  CHECK(found["reached"] == false);
  CHECK(found["responses"]["sigma_u"]["value"].get<double>() == Approx(19.986).margin(3e-3)); // at (10, 10)
  CHECK(found["constants"]["sigc"]["value"].get<double>() == Approx(10).margin(1e-6));
  CHECK(found["constants"]["tauc"]["value"].get<double>() == Approx(10).margin(1e-6));
  CHECK(std::fabs(found["responses"]["E"]["relative_deviation"].get<double>()) < 1e-6);
  CHECK(std::fabs(found["responses"]["nu"]["relative_deviation"].get<double>()) < 1e-6);
}

TEST_CASE("breccia invert gives the least sum of magnitudes where two targets contradict each other", "[apps]")
{
  const ScratchFolder folder;
  folder.file("p.json", surface("p", R"({"x": [0, 4]})", R"({"x": 1})"));
  folder.file("q.json", surface("q", R"({"x": [0, 4]})", R"({"x": 3})"));
  // |x - 1| / 1 + |3 x - 9| / 9 is least at x = 1, where q misses; the sum of squares would miss both
  const Outcome outcome =
    inverted(folder, {"p.json", "q.json"}, {"--target", "p=1", "--target", "q=9", "--starts", "1", "-o", "out"});
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK(inversion_in(folder)["constants"]["x"]["value"].get<double>() == Approx(1).margin(1e-6));
  CHECK_THAT(outcome.out, Contains("q = 9 cannot be met within the box: the surface comes to 3, off by -66.7 %"));
  // relative to what the surface gives, |x - 1| / x + |3 x - 9| / (3 x) = 2 / x up to x = 3
  REQUIRE(inverted(folder, {"p.json", "q.json"},
                   {"--target", "p=1", "--target", "q=9", "--over-prediction", "--starts", "1", "-o", "out"})
            .status == 0);
  CHECK(inversion_in(folder)["constants"]["x"]["value"].get<double>() == Approx(3).margin(1e-5));
}

TEST_CASE("the published errors of repeat runs are relative to the runs, and those relative to the targets are others",
          "[apps]")
{
  // Means of five runs for the first targets as a surface that hardly varies.
  const ScratchFolder folder;
  folder.file("s.json", surface("sigma_u", R"({"x": [0, 1]})", R"({"1": 57.738, "x": 1e-9})"));
  folder.file("e.json", surface("E", R"({"x": [0, 1]})", R"({"1": 34.082, "x": 1e-9})"));
  folder.file("n.json", surface("nu", R"({"x": [0, 1]})", R"({"1": 0.2148, "x": 1e-9})"));
  std::vector<std::string> words = {"--target", "sigma_u=59.67", "--target", "E=32.68", "--target",
                                    "nu=0.201", "--starts",      "1",        "-o",      "out"};
  const auto               off   = [&](const std::string &response) {
    return 100 * std::fabs(inversion_in(folder)["responses"][response]["relative_deviation"].get<double>());
  };
  REQUIRE(inverted(folder, {"s.json", "e.json", "n.json"}, words).status == 0);
  CHECK(off("sigma_u") == Approx(3.24).margin(5e-3));
  CHECK(off("E") == Approx(4.29).margin(5e-3));
  CHECK(off("nu") == Approx(6.87).margin(5e-3));
  CHECK(inversion_in(folder)["misfit"].get<double>() == Approx(0.0324 + 0.0429 + 0.0687).margin(1.5e-4));
  words.emplace_back("--over-prediction");
  REQUIRE(inverted(folder, {"s.json", "e.json", "n.json"}, words).status == 0);
  CHECK(inversion_in(folder)["misfit"].get<double>() == Approx(0.033461 + 0.041136 + 0.064246).margin(2e-5));
}

TEST_CASE("breccia invert gives the same file for the same seed, and warns outside the runs of a surface", "[apps]")
{
  const ScratchFolder folder;
  folder.file("y.json", surface("y", R"({"a": [0, 1], "b": [0, 1]})", R"({"1": 1, "a": 1, "b*a": 2, "b^2": 1})"));
  const std::vector<std::string> words = {"--target", "y=3", "--generations", "20", "--population", "20"};
  std::vector<std::string>       one = words, two = words;
  one.insert(one.end(), {"-o", "out"});
  two.insert(two.end(), {"-o", "again"});
  REQUIRE(inverted(folder, {"y.json"}, one).status == 0);
  REQUIRE(inverted(folder, {"y.json"}, two).status == 0);
  CHECK(content_of(folder / "out/inversion.json") == content_of(folder / "again/inversion.json"));
  const Outcome wide =
    inverted(folder, {"y.json"}, {"--target", "y=50", "--box", "a=0,9", "--box", "b=2,4", "--starts", "1"});
  CHECK(wide.status == 0);
  CHECK_THAT(wide.out, Contains("outside the runs that the surface of y was fitted to"));
}

TEST_CASE("breccia invert refuses what it cannot answer, in one message", "[apps]")
{
  const ScratchFolder folder;
  folder.file("y.json", surface("y", R"({"a": [0, 1]})", R"({"a": 1})"));
  folder.file("z.json", surface("z", R"({"a": [2, 3]})", R"({"a": 1})"));
  folder.file("bad.json", surface("y", R"({"a": [0, 1]})", R"({"c^2": 1})"));
  folder.file("range.json", R"({"response": {"name": "y"}, "model": "range"})");
  folder.file("words.json", "no json");
  const auto [words, said]     = GENERATE(table<std::vector<std::string>, std::string>(
    {{{"gone.json", "--target", "y=1"}, "gone.json"},
         {{"words.json", "--target", "y=1"}, "words.json: is no JSON. Wanted is an analysis.json"},
         {{"range.json", "--target", "y=1"}, "range.json: holds no surface"},
         {{"bad.json", "--target", "y=1"}, "bad.json: the term \"c^2\" is not made of powers"},
         {{"y.json", "--target", "x=1"}, "y.json: no --target is given for its response y"},
         {{"y.json", "--target", "y=1", "--target", "x=1"}, "--target x: no surface has this response"},
         {{"y.json", "--target", "y=1", "--target", "y=2"}, "--target y is given twice"},
         {{"y.json", "--target", "y=much"}, "--target y=much: \"much\" is no number"},
         {{"y.json", "--target", "y"}, "--target y: NAME=VALUE is wanted"},
         {{"y.json", "--target", "y=0"}, "must not be zero"},
         {{"y.json", "--target", "y=1", "--box", "b=0,1"}, "--box b: no surface has this factor"},
         {{"y.json", "--target", "y=1", "--box", "a=1"}, "--box a=1: NAME=LOWEST,HIGHEST is wanted"},
         {{"y.json", "--target", "y=1", "--box", "a=1,1"}, "--box a=1,1: the lowest value must be below"},
         {{"y.json", "--target", "y=1", "--population", "31"}, "--population 31: an even number is wanted"},
         {{"y.json", "z.json", "--target", "y=1", "--target", "z=1"}, "leave no room for a. Give one by --box"}}));
  std::vector<std::string> all = words;
  all.insert(all.begin(), "invert");
  const Outcome outcome = run(folder.path(), all);
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains(said));
}
