// Runs of particles on ranks that end early: a number that is none, a full disk, a signal to mpirun.
#include "tests/apps/program.h"
#include "tests/apps/same_on_ranks.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <string>
#include <vector>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** A cube of concrete of 768 particles, three bricks, pulled. */
  std::string pulled_concrete(const std::vector<std::string> &more = {})
  {
    std::vector<std::string> changes = {"Specimen/Box size=0.02, 0.02, 0.02", "Loading/Tests=tension"};
    changes.insert(changes.end(), more.begin(), more.end());
    return run_of("concrete_uniaxial.prm", changes);
  }

  /** The same cube at rest, and beside it a ball that nothing joins, which a force pushes beyond all numbers. */
  const char *const pushed_ball = R"(
set Kind = particles
subsection Specimen
  set Source            = generator
  set Box size          = 0.02, 0.02, 0.02
  set Density           = 4800
  set Interaction ratio = 1.5
  subsection Generator
    set Particle radius = 0.001
  end
end
subsection More particles
  subsection ball
    set Centre = 0.05, 0.05, 0.05
    set Radius = 0.001
  end
end
subsection Material
  set Law = CPM
  subsection CPM
    set Normal modulus       = 25e9
    set Shear ratio          = 0.2
    set Limit elastic strain = 1e-4
    set Relative ductility   = 30
    set Cohesion             = 3e6
    set Friction coefficient = 0.8
  end
end
subsection Physics
  set Contacts = false
end
subsection Forces
  subsection ball
    set Force z = t < 1e-5 ? 0 : 1e308
  end
end
subsection Time
  set End time = 1e-3
end
subsection Output
  set Snapshots = 2
  set Pieces    = per rank
end
)";

  /** Whether the first snapshot of particles in a piece per rank shows one, by its number, in a rank's piece. */
  bool is_of_rank(const ScratchFolder &folder, const int rank, const int particle)
  {
    const vtkNew<vtkXMLPolyDataReader> reader;
    const std::string                  piece = folder.path().string() +
                              "/results/running/particles_particles/particles_particles_000000." +
                              std::to_string(rank) + ".vtp";
    REQUIRE(reader->CanReadFile(piece.c_str()) == 1);
    reader->SetFileName(piece.c_str());
    reader->Update();
    vtkDataArray *const numbers = reader->GetOutput()->GetPointData()->GetArray("id");
    for (vtkIdType i = 0; i < numbers->GetNumberOfTuples(); ++i)
      if (static_cast<int>(numbers->GetTuple1(i)) == particle)
        return true;
    return false;
  }

  /** Shell words that let a rank write no more than half of a file of results/running into any: its disk is full. */
  std::string no_room_for(const int rank, const std::string &file)
  {
    return "prlimit --pid $(cat process." + std::to_string(rank) + ") --fsize=$(( $(stat -c %s results/running/" +
           file + ") / 2 ))";
  }
} // namespace

TEST_CASE("Where a number of another rank than the first is none, all ranks are gone in a moment with one message",
          "[apps][mpi][ranks]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  folder.file("x.prm", pushed_ball);
  const Ending ending = ending_on_three(folder, " run x.prm");
  INFO(ending.said);
  CHECK(ending.status == 1);
  CHECK(ending.seconds < gone_within);
  constexpr int ball = 769;
  CHECK(occurrences("the computation broke down: ", ending.said) == 1);
  CHECK(occurrences("particle " + std::to_string(ball) + " no longer has a finite velocity", ending.said) == 1);
  CHECK(occurrences("breccia: ", ending.said) == 2); // the note about its faces, and this
  CHECK_FALSE(is_of_rank(folder, 0, ball));
  CHECK(is_of_rank(folder, 1, ball) != is_of_rank(folder, 2, ball));
  CHECK_FALSE(std::filesystem::exists(folder / "results/summary.json"));
}

TEST_CASE("Where one rank's disk is full in the middle of its piece, all ranks are gone in a moment with one message",
          "[apps][mpi][ranks][slow][S14]")
{
  if (places::skipped_without_mpirun())
    return;
  are_gone_where_one_cannot_write(
    pulled_concrete({"Output/Pieces=per rank"}), "tension_links/tension_links_000000.pvtp",
    no_room_for(1, "tension_links/tension_links_000000.1.vtp"), ".1.vtp: cannot be written");
}

TEST_CASE(
  "Where the first rank's disk is full in the middle of a file, all ranks are gone in a moment with one message",
  "[apps][mpi][ranks][slow][S14]")
{
  if (places::skipped_without_mpirun())
    return;
  are_gone_where_one_cannot_write(pulled_concrete(), "tension_links/tension_links_000000.vtp",
                                  no_room_for(0, "tension_links/tension_links_000000.vtp"), ".vtp: cannot be written");
}

namespace
{
  /** Ranks stand still until mpirun, their parent, gets a signal, which it may hand on late: the run could be over by then. */
  std::string signal_to_mpirun(const std::string &signal)
  {
    return until_written("tension_links/tension_links_000001.vtp") +
           "ls results/running > before; kill -STOP $(cat process.*); "
           "kill -" +
           signal + " $(cut -d' ' -f4 /proc/$(cat process.0)/stat);";
  }

  /** Three ranks that are told to end leave a checkpoint as one process does, from which one and two go on. @param told shell words */
  void leave_a_checkpoint(const std::string &told)
  {
    if (places::skipped_without_mpirun())
      return;
    const ScratchFolder folder;
    const std::string   words = pulled_concrete({"Output/Snapshots=4"});
    REQUIRE(shell_in(folder, program_on(0, 1) + words + " -o whole") == 0);
    const Ending ending = ending_on_three(folder, words, told);
    INFO(ending.said);
    CHECK(ending.status != 0);
    CHECK(ending.seconds < gone_within);
    CHECK_THAT(content_of(folder / "before"), !Contains("checkpoint.h5"));
    CHECK(std::filesystem::exists(folder / "results/running/checkpoint.h5"));
    CHECK_FALSE(std::filesystem::exists(folder / "results/summary.json"));
    CHECK(occurrences("interrupted in tension, state saved. Go on with: mpirun -n 3 breccia run "
                      "results/running/scene.prm --resume",
                      ending.said) == 1);
    goes_on(folder, words, 0, 1);
    goes_on(folder, words, 2, 1);
  }
} // namespace

TEST_CASE("Where mpirun is told to end, particles leave a checkpoint as one process does, from which one and two go on",
          "[apps][mpi][ranks][slow][S13]")
{
  leave_a_checkpoint(signal_to_mpirun("TERM"));
}

TEST_CASE("Ranks that take longer than mpirun's second to end leave a checkpoint where mpirun is sent SIGUSR1",
          "[apps][mpi][ranks][slow][S13]")
{
  leave_a_checkpoint(signal_to_mpirun("USR1") + " sleep 2; kill -CONT $(cat process.*);");
}
