// Moduli of packings found by several ranks: the same numbers as by one.
#include "tests/apps/program.h"
#include "tests/apps/program_on_ranks.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

using namespace apps_tests;

namespace
{
  nlohmann::json json_at(const std::filesystem::path &file) { return nlohmann::json::parse(content_of(file)); }
} // namespace

TEST_CASE("Moduli over link parameters are the same on one rank and on three", "[apps][mpi][ranks]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  const std::string   words =
    run_of("homogenisation_sweep.prm", {"Homogenisation/Seeds=1", "Homogenisation/Interaction ratios=1.05, 1.5",
                                        "Homogenisation/Shear ratios=0.2", "Homogenisation/Particles=700"});
  for (const int ranks : {0, 3})
    {
      const int status = shell_in(folder, program_on(ranks, 1) + words + " -o " + std::to_string(ranks));
      INFO(content_of(folder / "said"));
      REQUIRE(status == 0);
    }
  CHECK(json_at(folder / "0/summary.json")["figures"] == json_at(folder / "3/summary.json")["figures"]);
  CHECK(content_of(folder / "0/homogenised.csv") == content_of(folder / "3/homogenised.csv"));
}

TEST_CASE("breccia homogenise has the same stiffness on one rank and on three, and says it once", "[apps][mpi][ranks]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  REQUIRE(shell_in(folder, program_on(0, 1) + " pack --count 700 --radius 1e-3 -o packing.txt") == 0);
  const std::string words =
    " homogenise packing.txt --interaction-ratio 1.2 --normal-modulus 25e9 --shear-ratio 0.2 -o ";
  for (const int ranks : {0, 3})
    {
      const int status = shell_in(folder, program_on(ranks, 1) + words + std::to_string(ranks));
      INFO(content_of(folder / "said"));
      REQUIRE(status == 0);
    }
  const std::string said = content_of(folder / "said");
  CHECK(said.find("written to") == said.rfind("written to"));
  CHECK(json_at(folder / "0/homogenised.json")["relaxed"] == json_at(folder / "3/homogenised.json")["relaxed"]);
}
