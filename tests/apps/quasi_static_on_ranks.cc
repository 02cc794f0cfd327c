// Scenes of kinds quasi_static and structure on several ranks: every file but the summary has the same bytes as on one.
#include "postprocess/files/csv_table.h"
#include "tests/apps/same_on_ranks.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** A specimen of 507 particles, two bricks, pulled until cracks open. */
  std::string pulled(const std::vector<std::string> &changes = {})
  {
    std::vector<std::string> all = {"Loading/Tests=tension", "Solver/Linear solver=iterative",
                                    "Output/Points per snapshot=4", "Specimen/Box size=0.02, 0.014, 0.02",
                                    "Loading/Tension/Stop strain=1.5e-4"};
    all.insert(all.end(), changes.begin(), changes.end());
    return run_of("quasi_static.prm", all);
  }

  /** A notched beam of particles alone, bent until bonds have damage. */
  std::string bent(const std::vector<std::string> &changes = {})
  {
    std::vector<std::string> all = {"Path/Linear solver=iterative", "Path/End=8e-6", "Path/Step=1e-6",
                                    "Output/Points per snapshot=4"};
    all.insert(all.end(), changes.begin(), changes.end());
    return run_of("bending_of_particles.prm", all);
  }

  /** A notched beam of elements with particles around the notch, the first of which become particles. */
  std::string promoted(const std::vector<std::string> &changes = {})
  {
    std::vector<std::string> all = {"Path/Linear solver=iterative", "Path/End=7e-6", "Output/Points per snapshot=4"};
    all.insert(all.end(), changes.begin(), changes.end());
    return run_of("crack_promoted.prm", all);
  }

  nlohmann::json figures_in(const std::filesystem::path &folder)
  {
    return nlohmann::json::parse(content_of(folder / "summary.json"))["figures"];
  }

  /** Refused on two ranks by one message with status 2; nothing is computed and no folder appears. */
  void refused_on_ranks(const std::string &words, const std::string &message)
  {
    const ScratchFolder folder;
    CHECK(shell_in(folder, program_on(2, 1) + words + " -o results") != 0);
    const std::string said = content_of(folder / "said");
    INFO(said);
    CHECK(occurrences("breccia: ", said) == 1);
    CHECK(occurrences(message, said) == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "results"));
  }
} // namespace

TEST_CASE("A quasi-static path of tension has the same results on any number of ranks and threads",
          "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  REQUIRE(shell_in(folder, program_on(0, 1) + pulled() + " -o one") == 0);
  for (const auto &[ranks, threads] : std::vector<std::array<int, 2>>{{0, 2}, {2, 1}, {2, 2}, {3, 1}, {3, 2}})
    {
      const std::string name   = std::to_string(ranks) + "_ranks_" + std::to_string(threads);
      const int         status = shell_in(folder, program_on(ranks, threads) + pulled() + " -o " + name);
      INFO(name << ": " << content_of(folder / "said"));
      REQUIRE(status == 0);
      CHECK(differences(folder / "one", folder / name) == std::vector<std::string>());
      CHECK(figures_in(folder / name) == figures_in(folder / "one"));
    }
}

TEST_CASE("A quasi-static cell has the same results on one rank and on three, by the automatic solver",
          "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder      folder;
  std::vector<std::string> changes = {"Specimen/Body=cell", "Loading/Tension/Stop fraction=0.9"};
  REQUIRE(shell_in(folder, program_on(0, 1) + pulled(changes) + " -o one") == 0);
  changes.push_back("Solver/Linear solver=automatic");
  REQUIRE(shell_in(folder, program_on(3, 1) + pulled(changes) + " -o three") == 0);
  CHECK(differences(folder / "one", folder / "three") == std::vector<std::string>());
}

TEST_CASE("A quasi-static run that was interrupted on three ranks goes on on one, and on five, to the same results",
          "[apps][mpi][ranks][slow][S13]")
{
  if (places::skipped_without_mpirun())
    return;
  goes_on_on_others(pulled());
}

TEST_CASE("A bent beam of particles has the same results on one rank and on three, by the automatic solver",
          "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  REQUIRE(shell_in(folder, program_on(0, 1) + bent() + " -o one") == 0);
  CHECK(postprocess::read_csv_table(folder / "one/series.csv", false, {"control"}).column("mean_damage").back() > 0);
  const int status = shell_in(folder, program_on(3, 1) + bent({"Path/Linear solver=automatic"}) + " -o three");
  INFO(content_of(folder / "said"));
  REQUIRE(status == 0);
  CHECK(differences(folder / "one", folder / "three") == std::vector<std::string>());
  CHECK(figures_in(folder / "one") == figures_in(folder / "three"));
}

TEST_CASE(
  "A bent beam of particles that was interrupted on three ranks goes on on one, and on five, to the same results",
  "[apps][mpi][ranks][slow][S13]")
{
  if (places::skipped_without_mpirun())
    return;
  goes_on_on_others(bent());
}

TEST_CASE("Grips that turn have the same results on one rank and on three, by the automatic solver",
          "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder      folder;
  std::vector<std::string> changes = {"Loading/Lateral motion blocked=true", "Loading/Grips turn=true"};
  REQUIRE(shell_in(folder, program_on(0, 1) + pulled(changes) + " -o one") == 0);
  changes.push_back("Solver/Linear solver=automatic");
  const int status = shell_in(folder, program_on(3, 1) + pulled(changes) + " -o three");
  INFO(content_of(folder / "said"));
  REQUIRE(status == 0);
  CHECK(differences(folder / "one", folder / "three") == std::vector<std::string>());
}

TEST_CASE(
  "A beam that bears its weight and is led by the opening of its notch has the same results on one rank and on two",
  "[apps][mpi][ranks][weight][opening][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  const std::string   words = run_of(
      "bending_with_core.prm", {"Path/Linear solver=iterative", "Output/Points per snapshot=4",
                                "Gravity/Acceleration=0, 0, -300", "Specimen/Density=4000", "Bending test/Length=0.12",
                                "Path/Opening=opening", "Path/Opening step=2e-7", "Path/End opening=1e-6"});
  REQUIRE(shell_in(folder, program_on(0, 1) + words + " -o one") == 0);
  const postprocess::CsvTable series = postprocess::read_csv_table(folder / "one/series.csv", false, {"control"});
  CHECK(series.column("weight").back() == 1);
  const int status = shell_in(folder, program_on(2, 1) + words + " -o two");
  INFO(content_of(folder / "said"));
  REQUIRE(status == 0);
  CHECK(differences(folder / "one", folder / "two") == std::vector<std::string>());
  CHECK(figures_in(folder / "one") == figures_in(folder / "two"));
}

TEST_CASE("A beam whose elements become particles has the same results on one rank and on two, whatever the ties",
          "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  for (const char *ties :
       {"Handshakes/core/Ties=coarse", "Handshakes/core/Ties=strict", "Handshakes/core/Method=constrained"})
    {
      const ScratchFolder folder;
      INFO(ties);
      REQUIRE(shell_in(folder, program_on(0, 1) + promoted({ties}) + " -o one") == 0);
      const postprocess::CsvTable series = postprocess::read_csv_table(folder / "one/series.csv", false, {"control"});
      CHECK(series.column("mean_damage").back() > 0);
      CHECK(series.column("core_promoted").back() > 0);
      const int status =
        shell_in(folder, program_on(2, 1) + promoted({ties, "Path/Linear solver=automatic"}) + " -o two");
      INFO(content_of(folder / "said"));
      REQUIRE(status == 0);
      CHECK(differences(folder / "one", folder / "two") == std::vector<std::string>());
      CHECK(figures_in(folder / "one") == figures_in(folder / "two"));
    }
}

TEST_CASE("A beam with elements that was interrupted on three ranks goes on on one, and on five, to the same results",
          "[apps][mpi][ranks][slow][S13]")
{
  if (places::skipped_without_mpirun())
    return;
  goes_on_on_others(promoted());
}

TEST_CASE("What needs a factor is refused under mpirun in one message", "[apps][mpi][ranks][S14]")
{
  if (places::skipped_without_mpirun())
    return;
  refused_on_ranks(pulled({"Solver/Linear solver=direct"}),
                   "Solver/Linear solver = direct: runs in one process, and mpirun has started 2. Choose automatic or "
                   "iterative, or use --threads.");
  refused_on_ranks(bent({"Path/Linear solver=direct"}),
                   "Path/Linear solver = direct: runs in one process, and mpirun has started 2.");
  refused_on_ranks(run_of("crack_promoted.prm", {"Path/Linear solver=direct"}),
                   "Path/Linear solver = direct: runs in one process, and mpirun has started 2.");
}
