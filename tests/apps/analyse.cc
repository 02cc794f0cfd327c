// breccia analyse: a table of runs, as a study or a user leaves it.
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string published(const std::string &name) { return places::sources() + "/apps/scenes/tables/" + name; }

  const std::string all_columns = "Ec,kn_ks,sigc,tauc,mu,Ecg,kn_ks_g,mu_g,Ecj,kn_ks_j,sigcj,taucj,mu_j,null_col";

  nlohmann::json analysis_in(const ScratchFolder &folder, std::vector<std::string> words)
  {
    words.insert(words.begin(), "analyse");
    words.insert(words.end(), {"-o", "out"});
    const Outcome outcome = run(folder.path(), words);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return nlohmann::json::parse(content_of(folder / "out/analysis.json"));
  }
} // namespace

TEST_CASE("breccia analyse fits the published surface of strength and draws it", "[apps]")
{
  const ScratchFolder folder;
  const auto          found =
    analysis_in(folder, {published("concrete_strength.csv"), "--response", "sigma_u", "--factors", "sigc,tauc"});
  CHECK(found["response"]["unit"] == "MPa");
  CHECK(found["surface"]["terms"].size() == 6);
  CHECK(found["surface"]["terms"]["1"].get<double>() == Approx(-0.481246).margin(6e-7));
  CHECK(found["surface"]["terms"]["sigc^2"].get<double>() == Approx(-0.031381).margin(6e-7));
  CHECK(found["surface"]["terms"]["sigc*tauc"].get<double>() == Approx(0.066025).margin(6e-7));
  CHECK(found["r_squared"].get<double>() == Approx(0.98813).margin(5e-6));
  CHECK(found["adjusted_r_squared"].get<double>() == Approx(0.97965).margin(5e-6));
  CHECK(found["press_r_squared"].get<double>() == Approx(0.9387).margin(5e-5));
  CHECK(found["standard_error"].get<double>() == Approx(1.942).margin(5e-4));
  CHECK(found["lack_of_fit"]["F"].get<double>() == Approx(2.468).margin(5e-4));
  CHECK(found["residuals"].size() == 13);
  CHECK(found["flags"].empty());
  CHECK(found["gaussian_process"]["left_out_r_squared"].get<double>() > 0.9);
  for (const char *file :
       {"analysis.csv", "residuals.csv", "effects.png", "half_normal.png", "residuals.png", "contours.png"})
    CHECK(std::filesystem::file_size(folder / "out" / file) > 100);
  CHECK_THAT(content_of(folder / "out/analysis.csv"), Contains("\nsigc*tauc,0.066"));
}

TEST_CASE("the report of an analysis is one page with its figures and pictures", "[apps]")
{
  const ScratchFolder folder;
  analysis_in(folder, {published("concrete_strength.csv"), "--response", "sigma_u", "--factors", "sigc,tauc"});
  const std::string page     = content_of(folder / "out/report.html");
  std::size_t       pictures = 0;
  for (auto at = page.find("data:image/png;base64,iVBORw0KGgo"); at != std::string::npos;
       at      = page.find("data:image/png;base64,iVBORw0KGgo", at + 1))
    ++pictures;
  CHECK(pictures == 4);
  CHECK_THAT(page, Contains("sigma_u") && Contains("0.98")); // R squared
  CHECK_THAT(page, !Contains("src=\"http") && !Contains("href=") && !Contains("<script"));
  CHECK(page.size() <= 2000000);
}

TEST_CASE("breccia analyse flags the mistyped run and the copied one of the published design", "[apps]")
{
  const ScratchFolder folder;
  const auto found = analysis_in(folder, {published("concrete_orthogonal.csv"), "--response", "nu", "--factors",
                                          all_columns, "--model", "anova", "--null", "null_col"});
  CHECK(found["anova"]["kn_ks"]["F"].get<double>() == Approx(1117.10).margin(5e-3));
  CHECK(found["anova"]["kn_ks"]["degrees"] == 2);
  CHECK(found["anova"]["null_col"]["p"].get<double>() > 0.05);
  CHECK(found["anova_error"]["degrees"] == 35);
  CHECK(found["anova_error"]["sum_of_squares"].get<double>() == Approx(0.010310328).epsilon(1e-7));
  std::vector<int> flagged;
  for (const auto &flag : found["flags"])
    flagged.push_back(flag["run"]);
  CHECK(flagged == std::vector<int>{35, 37, 14});
  CHECK_THAT(found["flags"][0]["reason"].get<std::string>(), Contains("equal to run 37"));
  CHECK_THAT(found["flags"][2]["reason"].get<std::string>(), Contains("-15.3"));
  CHECK(found["residuals"][13]["studentised"].get<double>() == Approx(-15.3).margin(0.05));
  CHECK(found["residuals"][13]["left_out_prediction"].get<double>() == Approx(0.140).margin(5e-4));
  CHECK(found["array"]["balanced"] == false);
  CHECK(found["array"]["proportional"] == true);
  CHECK(found["array"]["rank"] == 29);
  REQUIRE(found["warnings"].size() == 1);
  CHECK_THAT(found["warnings"][0].get<std::string>(), Contains("levels were collapsed"));
}

TEST_CASE(
  "breccia analyse says that the null column of the modulus is significant, and can pool it or take it as the error",
  "[apps]")
{
  const ScratchFolder            folder;
  const std::vector<std::string> words  = {published("concrete_orthogonal.csv"),
                                           "--response",
                                           "E_GPa",
                                           "--factors",
                                           all_columns,
                                           "--model",
                                           "anova",
                                           "--null",
                                           "null_col"};
  const auto                     factor = analysis_in(folder, words);
  CHECK(factor["anova"]["null_col"]["F"].get<double>() == Approx(31.3257).margin(5e-5));
  CHECK_THAT(factor["warnings"].dump(), Contains("null column null_col is significant"));
  std::vector<std::string> pooled = words, error = words;
  pooled.insert(pooled.end(), {"--null-as", "pooled"});
  error.insert(error.end(), {"--null-as", "error"});
  const auto as_pooled = analysis_in(folder, pooled);
  CHECK(as_pooled["anova_error"]["degrees"] == 37);
  CHECK(as_pooled["anova"]["kn_ks_j"]["F"].get<double>() == Approx(2.76).margin(5e-3));
  CHECK_FALSE(as_pooled["anova"].contains("null_col"));
  const auto as_error = analysis_in(folder, error);
  CHECK(as_error["anova_error"]["degrees"] == 2);
  CHECK(as_error["anova"]["Ec"]["F"].get<double>() == Approx(95.914).margin(5e-3));
}

TEST_CASE("breccia analyse gives ranges and linear regressions of the published design", "[apps]")
{
  const ScratchFolder folder;
  const auto          ranges = analysis_in(
             folder, {published("concrete_orthogonal.csv"), "--response", "E", "--factors", all_columns, "--model", "range"});
  CHECK(ranges["ranges"]["Ec"]["rank"] == 1);
  CHECK(ranges["ranges"]["Ec"]["range"].get<double>() == Approx(32.008).margin(5e-4));
  CHECK_FALSE(ranges.contains("r_squared"));
  const auto linear = analysis_in(folder, {published("concrete_orthogonal.csv"), "--response", "sigma_u", "--factors",
                                           "sigc_MPa,tauc_MPa", "--model", "linear"});
  CHECK(linear["surface"]["terms"]["tauc"].get<double>() == Approx(0.77971023).margin(6e-9));
  CHECK(linear["r_squared"].get<double>() == Approx(0.759859).margin(5e-7));
  CHECK_THAT(linear["warnings"].dump(), Contains("explains 76.0 %"));
}

TEST_CASE("breccia analyse leaves out runs without the response, and reads words and units of other columns", "[apps]")
{
  const ScratchFolder folder;
  folder.file("runs.csv", "run,who,A [mm],B,y [kN]\nr1,ann,1,1,2\nr2,bob,2,1,3.1\nr3,ann,1,2,3.9\n"
                          "# run r4 failed\nr4,bob,2,2,nan\nr5,eve,3,2,6.1\nr6,eve,3,1,4\nr7,eve,3,3,7.9\n");
  const auto found = analysis_in(folder, {"runs.csv", "--response", "y", "--factors", "A,B", "--model", "linear"});
  CHECK(found["runs"] == 6);
  CHECK(found["response"]["unit"] == "kN");
  CHECK(found["residuals"][3]["run"] == "r5");
  CHECK_THAT(found["warnings"].dump(), Contains("Run r4 has no y"));
}

TEST_CASE("breccia analyse refuses what a table does not carry, in one message", "[apps]")
{
  const ScratchFolder folder;
  folder.file("runs.csv", "run,A,B,A_mm,y\n1,1,1,2,2\n2,2,2,3,3.1\n3,3,3,1,3.9\n4,4,4,1,4.8\n");
  const auto [words, said]     = GENERATE(table<std::vector<std::string>, std::string>(
    {{{"gone.csv", "--response", "y", "--factors", "A"}, "gone.csv: cannot be read"},
         {{"runs.csv", "--response", "z", "--factors", "A"},
          "runs.csv: there is no column z. Columns: run, A, B, A_mm, y."},
         {{"runs.csv", "--response", "y", "--factors", "A,A"}, "the column A is given twice"},
         {{"runs.csv", "--response", "y", "--factors", "A,B"}, "fewer runs than terms: 4 runs for 6 terms"},
         {{"runs.csv", "--response", "y", "--factors", "A,B", "--model", "linear"}, "do not distinguish these terms"},
         {{"runs.csv", "--response", "y", "--factors", "A", "--null", "B", "--model", "anova"},
          "--null B: is none of the factors"},
         {{"runs.csv", "--response", "y", "--factors", "A", "--model", "cubic"}, "--model: cubic not in"}}));
  std::vector<std::string> all = words;
  all.insert(all.begin(), "analyse");
  const Outcome outcome = run(folder.path(), all);
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains(said));
}
