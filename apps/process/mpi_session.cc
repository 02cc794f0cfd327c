#include "apps/process/mpi_session.h"

#include "apps/process/interrupt.h"
#include "apps/process/rank_meetings.h"
#include "base/errors.h"
#include "base/mpi_alone.h"
#include "base/solver_turns.h"
#include "postprocess/files/errors.h"

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace apps
{
  namespace
  {
    using Session = dealii::Utilities::MPI::MPI_InitFinalize;

    std::unique_ptr<Session> &session()
    {
      static std::unique_ptr<Session> started;
      return started;
    }

    /** The number in the first of the environment's variables that there is. */
    int number_in_environment(const std::array<const char *, 2> &names, const int otherwise)
    {
      for (const char *name : names)
        if (const char *text = std::getenv(name))
          return std::atoi(text);
      return otherwise;
    }

    /** Where MPI may put its files: the environment's folder for temporary ones, or if that is none /tmp. */
    class FolderForMpi
    {
    public:
      FolderForMpi()
      {
        const char *given = std::getenv(variable);
        if (!given || usable(given))
          return;
        if (!usable(otherwise))
          throw base::InputError(std::string(variable) + ": " + given +
                                 " is no folder that can be written to, and neither is " + otherwise +
                                 "; MPI needs one.");
        before = given;
        ::setenv(variable, otherwise, 1);
      }
      ~FolderForMpi()
      {
        if (!before.empty())
          ::setenv(variable, before.c_str(), 1);
      }
      FolderForMpi(const FolderForMpi &)            = delete;
      FolderForMpi &operator=(const FolderForMpi &) = delete;

    private:
      static bool usable(const char *folder)
      {
        std::error_code failed;
        return std::filesystem::is_directory(folder, failed) && ::access(folder, W_OK | X_OK) == 0;
      }

      static constexpr const char *variable = "TMPDIR", *otherwise = "/tmp";
      std::string                  before; ///< empty: it has not been changed
    };

    /** For those that have failed, and for comparing, apart from what others still say to each other. */
    MPI_Comm failures = MPI_COMM_NULL, comparisons = MPI_COMM_NULL;

    /** The first rank does something that the others do not, or each something of its own. */
    bool acts_alone = false;

    struct ActsAlone
    {
      ActsAlone() { acts_alone = true; }
      ~ActsAlone() { acts_alone = false; }
      ActsAlone(const ActsAlone &)            = delete;
      ActsAlone &operator=(const ActsAlone &) = delete;
    };

    /** What a rank is about to say, as others compare it. */
    using Topic = std::array<char, 64>;

    void compare(const std::string &what)
    {
      const auto         ranks = static_cast<std::size_t>(rank_count());
      Topic              mine{};
      std::vector<Topic> all(ranks);
      what.copy(mine.data(), mine.size() - 1);
      MPI_Allgather(mine.data(), static_cast<int>(mine.size()), MPI_CHAR, all.data(), static_cast<int>(mine.size()),
                    MPI_CHAR, comparisons);
      for (std::size_t r = 1; r < ranks; ++r)
        if (all[r] != all[0])
          throw std::logic_error(std::string("ranks: the first is at \"") + all[0].data() + "\" and rank " +
                                 std::to_string(r) + " at \"" + all[r].data() + "\"");
    }

    enum Failure : int
    {
      none,
      input,
      output,
      memory,
      other
    };
  } // namespace

  int launched_ranks() { return number_in_environment({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}, 1); }

  int launched_rank() { return number_in_environment({"OMPI_COMM_WORLD_RANK", "PMI_RANK"}, 0); }

  void start_mpi()
  {
    static char  name[]  = "breccia";
    static char *words[] = {name, nullptr};
    int          count   = 1;
    char       **given   = words;
    if (session())
      return;
    int started = 0;
    MPI_Initialized(&started);
    if (started != 0)
      throw base::InputError(
        "MPI: has been started by another part of this program (mpi4py, say), and finite elements must start it "
        "themselves. Make the first solid before that part is loaded.");
    // Without a launcher, Open MPI searches for an ssh by which it could launch others, and gives up without one.
    if (launched_ranks() == 1)
      ::setenv("OMPI_MCA_plm", "isolated", 0);
    const base::MpiAlone alone;
    const FolderForMpi   folder;
    // PETSc, which deal.II starts too, sets the handlers of signals to the system's own.
    std::array<struct sigaction, stop_signals.size()> handlers;
    for (std::size_t s = 0; s < handlers.size(); ++s)
      sigaction(stop_signals[s], nullptr, &handlers[s]);
    session() = std::make_unique<Session>(count, given, 1);
    base::LoadedOpenBlas().use_one_thread(); // for the solvers of PETSc and Trilinos as well
    if (rank_count() > 1)
      MPI_Comm_dup(MPI_COMM_WORLD, &failures);
    if (rank_count() > 1 && std::getenv("BRECCIA_CHECK_RANKS"))
      MPI_Comm_dup(MPI_COMM_WORLD, &comparisons);
    for (std::size_t s = 0; s < handlers.size(); ++s)
      sigaction(stop_signals[s], &handlers[s], nullptr);
  }

  void finish_mpi() { session().reset(); }

  bool is_first_rank()
  {
    return (session() ? static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) : launched_rank()) ==
           0;
  }

  bool speaks_of_failure()
  {
    if (session() || launched_rank() == 0)
      return is_first_rank();
    constexpr timespec head_start{2, 0};
    return ::nanosleep(&head_start, nullptr) == 0; // not if a signal has come: the launcher ends this one too
  }

  int rank_count() { return session() ? static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)) : 1; }

  void meet(const char *what, const std::size_t size)
  {
    if (acts_alone && rank_count() > 1)
      throw std::logic_error(std::string("ranks: one says \"") + what + "\" alone, and the others wait for it");
    if (comparisons != MPI_COMM_NULL)
      compare(std::string(what) + ", " + std::to_string(size));
  }

  void take_from_first_rank(std::string &text)
  {
    meet("take a text from the first rank");
    if (rank_count() > 1)
      text = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, text);
  }

  namespace
  {
    /** How an action ended, and what it said. */
    using Outcome = std::pair<int, std::string>;

    /** Do something that meets no other rank. */
    Outcome outcome_of(const std::function<void()> &action)
    {
      try
        {
          const ActsAlone alone;
          action();
        }
      catch (const base::InputError &error)
        {
          return {Failure::input, error.what()};
        }
      catch (const postprocess::OutputError &error)
        {
          return {Failure::output, error.what()};
        }
      catch (const std::bad_alloc &)
        {
          return {Failure::memory, ""};
        }
      catch (const std::exception &error)
        {
          return {Failure::other, error.what()};
        }
      return {Failure::none, ""};
    }

    /** Let all ranks throw what one of them has caught. */
    void throw_on_all(Outcome outcome, const unsigned int rank)
    {
      if (rank_count() > 1)
        outcome = {dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, outcome.first, rank),
                   dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, outcome.second, rank)};
      if (outcome.first == Failure::input)
        throw base::InputError(outcome.second);
      if (outcome.first == Failure::output)
        throw postprocess::OutputError(outcome.second);
      if (outcome.first == Failure::memory)
        throw std::bad_alloc();
      if (outcome.first == Failure::other)
        throw std::runtime_error(outcome.second);
    }
  } // namespace

  void on_first_rank(const std::function<void()> &action)
  {
    meet("on the first rank");
    throw_on_all(is_first_rank() ? outcome_of(action) : Outcome(Failure::none, ""), 0);
  }

  void on_each_rank(const std::function<void(std::size_t)> &action)
  {
    meet("on each rank");
    const auto    rank    = session() ? dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) : 0;
    const Outcome outcome = outcome_of([&] { action(rank); });
    const auto    none    = static_cast<unsigned int>(rank_count());
    const auto    failed  = outcome.first == Failure::none ? none : rank;
    const auto    first   = rank_count() > 1 ? dealii::Utilities::MPI::min(failed, MPI_COMM_WORLD) : failed;
    if (first < none)
      throw_on_all(outcome, first);
  }

  bool interrupted_on_any_rank() { return on_any_rank(interrupted()); }

  double largest_of_ranks(const double here)
  {
    meet("largest");
    return rank_count() > 1 ? dealii::Utilities::MPI::max(here, MPI_COMM_WORLD) : here;
  }

  void start_mpi_for_ranks()
  {
    if (launched_ranks() > 1)
      start_mpi();
  }

  int end_of_failed_rank(const int status, const std::function<void()> &say)
  {
    if (rank_count() == 1)
      {
        if (speaks_of_failure())
          say();
        return status;
      }
    MPI_Request others;
    MPI_Ibarrier(failures, &others);
    int            all               = 0;
    constexpr long tenth_of_a_second = 100000000;
    for (int tenths = 0; tenths < 20 && all == 0; ++tenths)
      {
        MPI_Test(&others, &all, MPI_STATUS_IGNORE);
        constexpr timespec wait{0, tenth_of_a_second};
        if (all == 0)
          ::nanosleep(&wait, nullptr);
      }
    if (all == 0 || is_first_rank())
      say();
    if (all == 0)
      MPI_Abort(MPI_COMM_WORLD, status);
    return status;
  }

  bool on_any_rank(const bool here)
  {
    meet("on any rank");
    return rank_count() > 1 ? dealii::Utilities::MPI::max(here ? 1 : 0, MPI_COMM_WORLD) == 1 : here;
  }
} // namespace apps
