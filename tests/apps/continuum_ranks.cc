#include "postprocess/files/csv_table.h"
#include "tests/apps/continuum_scenes.h"
#include "tests/apps/program_on_ranks.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  const std::string &mpirun = places::mpirun();

  /**
   * A shell command in the folder, "RUN" standing for the program on two ranks and "NOTED RUN" for one that notes its
   * processes; what it says lands in the file "said".
   */
  int shell(const ScratchFolder &folder, std::string command)
  {
    const bool        noted   = command.find("NOTED RUN") != std::string::npos;
    const std::string program = (noted ? noting_its_process : "") + places::program() + " run x.prm";
    command = replaced(command, noted ? "NOTED RUN" : "RUN", mpirun + " --oversubscribe -np 2 " + program);
    return std::system(("cd " + folder.path().string() +
                        " && export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1 && { " +
                        command + "; } > said 2>&1")
                         .c_str());
  }
} // namespace

TEST_CASE("Two ranks under mpirun give the displacement of one, and PVTU files", "[apps][mpi]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  folder.file("x.prm", impact_scene());
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "one"}).status == 0);
  const int status = shell(folder, "RUN -o two");
  INFO(content_of(folder / "said"));
  REQUIRE(status == 0);
  const nlohmann::json one = summary_in(folder / "one"), two = summary_in(folder / "two");
  CHECK(two["cost"]["ranks"] == 2);
  for (const char *name : {"peak_reaction_left_x", "final_displacement_free_end_x"})
    CHECK(two["figures"][name]["value"].get<double>() ==
          Approx(one["figures"][name]["value"].get<double>()).epsilon(1e-9)); // sums in another order
  CHECK(std::filesystem::exists(folder / "two/solid/solid_000004.pvtu"));
  CHECK_THAT(content_of(folder / "two/solid.pvd"), Contains("solid/solid_000004.pvtu"));
  CHECK(std::count_if(std::filesystem::directory_iterator(folder / "two"), std::filesystem::directory_iterator(),
                      [](const auto &) { return true; }) == 6);
}

TEST_CASE("Two ranks follow a softening beam past its peak as one does", "[apps][mpi][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  folder.file("x.prm", concrete_beam_scene());
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "one"}).status == 0);
  for (const std::string solver : {"direct", "iterative"})
    {
      const int status = shell(folder, "RUN -o " + solver + " -s 'Control/Linear solver=" + solver + "'");
      INFO(content_of(folder / "said"));
      REQUIRE(status == 0);
      const postprocess::CsvTable one = postprocess::read_csv_table(folder / "one/series.csv"),
                                  two = postprocess::read_csv_table(folder / solver / "series.csv");
      REQUIRE(two.rows() == one.rows());
      const auto   load = one.column("reaction_load_y");
      const double peak = *std::min_element(load.begin(), load.end());
      CHECK(std::fabs(load.back()) < 0.9 * std::fabs(peak));
      for (std::size_t row = 0; row < one.rows(); ++row)
        // Newton stops at 1e-8 of the forces; what it leaves grows where the tangent is soft.
        CHECK(two.column("reaction_load_y")[row] == Approx(load[row]).margin(1e-6 * std::fabs(peak)));
    }
}

TEST_CASE("A run on two ranks that is interrupted past the peak goes on to the same bits", "[apps][mpi][slow][S13]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  folder.file("x.prm", replaced(concrete_beam_scene(), "subsection Output",
                                "subsection Output\n  set Checkpoint interval = 0.001"));
  const std::string slowly = " -s 'Control/First step=5e-7'"; // long enough to be caught
  REQUIRE(shell(folder, "RUN -o whole" + slowly) == 0);
  shell(folder, "NOTED RUN -o results" + slowly +
                  " & while kill -0 $! && { [ ! -e results/running/checkpoint.h5 ] || "
                  "[ ! -e results/running/solid/solid_000002.pvtu ]; }; do sleep 0.01; done; " +
                  interrupt_noted + "; wait $!");
  INFO(content_of(folder / "said"));
  REQUIRE_FALSE(std::filesystem::exists(folder / "results/summary.json"));
  CHECK_THAT(content_of(folder / "said"), Contains("interrupted in equilibrium, state saved"));
  const int resumed = shell(folder, "RUN -o results --resume" + slowly);
  INFO(content_of(folder / "said"));
  REQUIRE(resumed == 0);
  CHECK(content_of(folder / "results/series.csv") == content_of(folder / "whole/series.csv"));
  CHECK(listing_of(folder / "results/solid") == listing_of(folder / "whole/solid"));
}

TEST_CASE("A scene that does not share its work is refused under mpirun in one message", "[apps][mpi][S14]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  folder.file("x.prm", content_of(places::sources() + "/apps/scenes/peridynamic_bar.prm"));
  CHECK(shell(folder, "RUN -o results || [ $? = 2 ] && [ ! -e results ]") == 0);
  const std::string said = content_of(folder / "said");
  INFO(said);
  const std::string refusal = "x.prm: Kind = peridynamics: runs in one process, and mpirun has started 2.";
  const auto        place   = said.find(refusal);
  CHECK(place != std::string::npos);
  CHECK(said.find(refusal, place + 1) == std::string::npos);
}

TEST_CASE("Interrupted under mpirun, a run says how to go on under mpirun, and does", "[apps][mpi][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  // Ten seconds: mpirun hands a signal on up to two seconds late, and the run must not be over by then.
  std::string scene = replaced(impact_scene(), "set End time           = 1.9e-4", "set End time = 0.3");
  folder.file("x.prm", replaced(scene, "subsection Output", "subsection Output\n  set Checkpoint interval = 0.01"));
  const int status =
    shell(folder, "RUN -o two & "
                  "for i in $(seq 3000); do test -e two/running/checkpoint.h5 && break; sleep 0.02; done; "
                  "kill -TERM $!; wait $!");
  INFO(content_of(folder / "said"));
  CHECK(status != 0);
  CHECK_THAT(content_of(folder / "said"),
             Contains("Go on with: mpirun -n 2 breccia run two/running/scene.prm --resume"));
  REQUIRE_FALSE(std::filesystem::exists(folder / "two/summary.json"));
  REQUIRE(shell(folder, "RUN -o two --resume") == 0);
  CHECK(std::filesystem::exists(folder / "two/summary.json"));
}
