#pragma once

#include <functional>

namespace apps
{
  /** How many processes mpirun (of Open MPI or MPICH) has started, this one among them; 1 without it. Known before start_mpi(). */
  int launched_ranks();

  /** Which of them this is, from 0. */
  int launched_rank();

  /** Make MPI ready, which finite elements need on one rank too; a second call does nothing. @throws base::InputError where others have started it */
  void start_mpi();

  /** End MPI, if it was started; call it last, outside any handling of exceptions. */
  void finish_mpi();

  /** Whether this process speaks for all: it writes files and messages. True without MPI. */
  bool is_first_rank();

  /**
   * Whether this process is the one to say why it ends. Before start_mpi() what one process finds wrong all of them mostly
   * do, and the launcher ends all when one has: the others give the first a head start of two seconds, and speak only if
   * they are still there then, because it has found nothing.
   */
  bool speaks_of_failure();

  int rank_count();

  /**
   * Do something on the first rank only.
   * @throws what it threw there (base::InputError, postprocess::OutputError, std::bad_alloc, otherwise std::runtime_error), on every rank.
   */
  void on_first_rank(const std::function<void()> &action);

  /** True on every rank if it is on any. */
  bool on_any_rank(bool here);

  /** Whether interrupted() (interrupt.h) is true on any rank. */
  bool interrupted_on_any_rank();

  /** The largest that any rank has. */
  double largest_of_ranks(double here);

  /** Where mpirun has started several processes, make MPI ready. */
  void start_mpi_for_ranks();

  /**
   * End after a failure. Where all ranks fail, this returns on all of them within a moment, and the first is to speak of it; where one does alone,
   * it says so, and the others, which wait for it, are ended. @param say prints the message @return the exit status
   */
  int end_of_failed_rank(int status, const std::function<void()> &say);
} // namespace apps
