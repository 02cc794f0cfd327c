#include "postprocess/files/summary.h"
#include "scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <limits>

using namespace postprocess;
using nlohmann::json;
using postprocess_tests::content_of;
using postprocess_tests::ScratchFolder;

TEST_CASE("a summary read back holds the same bits", "[postprocess]")
{
  const ScratchFolder folder;
  const json          summary = {{"figures", {{"young_modulus", {{"value", 2.7e10 / 3}, {"unit", "Pa"}}}}},
                                 {"steps", 9007199254740993LL}, // does not fit a double
                                 {"tiny", 5e-324}};
  write_json(folder / "summary.json", summary);
  REQUIRE(json::parse(content_of(folder / "summary.json")) == summary);
  REQUIRE(content_of(folder / "summary.json").find("\n  \"figures\"") != std::string::npos); // indented, for readers
}

TEST_CASE("a number that JSON cannot hold becomes null and is named", "[postprocess]")
{
  constexpr double    nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const ScratchFolder folder;
  write_json(folder / "summary.json",
             {{"figures", {{"strength", {{"value", nan}}}}}, {"list", {1.0, -inf}}, {"x", inf}});
  const json read = json::parse(content_of(folder / "summary.json"));
  REQUIRE(read["figures"]["strength"]["value"].is_null());
  REQUIRE(read["list"][0] == 1.0);
  REQUIRE(read["list"][1].is_null());
  REQUIRE(read["not_a_number"] == json({"/figures/strength/value: nan", "/list/1: -inf", "/x: inf"}));
}

TEST_CASE("a summary of finite numbers has no list of others", "[postprocess]")
{
  const ScratchFolder folder;
  write_json(folder / "summary.json", {{"x", 1.0}});
  REQUIRE_FALSE(json::parse(content_of(folder / "summary.json")).contains("not_a_number"));
  REQUIRE_THROWS_AS(write_json(folder / "s.json", json::array()), std::invalid_argument);
  REQUIRE_THROWS_AS(write_json(folder / "s.json", {{"not_a_number", 1}}), std::invalid_argument);
}
