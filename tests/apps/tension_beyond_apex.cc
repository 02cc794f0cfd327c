// A tensile strength that bonds never reach, because they break in shear before, is said by check and by the run.
#include "tests/apps/scene_runs.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

using namespace apps_tests;
using Catch::Contains;

TEST_CASE("A tensile strength beyond c / tan phi is reported", "[apps]")
{
  const ScratchFolder folder;
  const std::string   law   = "Material/flat-joint/";
  const auto          check = [&](const std::vector<std::string> &changes) {
    return outcome_of(folder, "check", places::scene("rock_tension.prm"), changes).out;
  };
  CHECK_THAT(check({}), !Contains("is never reached"));
  CHECK_THAT(check({law + "Cohesion=1e6"}),
             Contains("Material: Tensile strength = 6e+06 Pa is never reached") && Contains("= 5.671e+06 Pa"));
  CHECK_THAT(check({law + "Cohesion=1e6", law + "Friction angle=0"}), !Contains("is never reached"));
  CHECK_THAT(check({law + "Cohesion=1e6", law + "Tensile strength=inf"}), !Contains("is never reached"));
}

TEST_CASE("A run keeps the warning of a tensile strength beyond c / tan phi", "[apps][slow]")
{
  const ScratchFolder folder;
  const auto          warnings = results_of(folder, places::scene("jointed_cube.prm"),
                                            {"Material/flat-joint/Cohesion=1e6", "Loading/Tests=tension"}, {"test"})
                          .summary["warnings"];
  INFO(warnings.dump(1));
  REQUIRE_FALSE(warnings.empty());
  bool said = false;
  for (const auto &warning : warnings)
    said = said || warning.get<std::string>().find("is never reached") != std::string::npos;
  CHECK(said);
}
