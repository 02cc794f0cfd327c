#pragma once

#include <array>
#include <csignal>
#include <functional>
#include <string>

namespace apps
{
  /**
   * What asks the program to stop. Open MPI's launcher hands SIGUSR1 on and waits for its processes; after SIGINT and SIGTERM it kills them
   * within a second.
   */
  constexpr std::array<int, 3> stop_signals = {SIGINT, SIGTERM, SIGUSR1};

  /**
   * From here on the first of each of stop_signals raises the flag below, and a second one ends the program at once.
   *
   * Long work polls the flag often, saves its state and returns. Work that cannot poll (a
   * factorisation, a large file) is left within four seconds all the same: a thread of its own then says the last words and
   * ends the program with exit_interrupted. Files that appear complete or not at all make that safe. A second call does
   * nothing.
   */
  void catch_interrupts();

  /** The program, or the run of this thread, shall stop: save what is worth saving and leave. */
  bool interrupted();

  /** As long as this object lives, interrupted() is also true in its thread where the given function says so: a run's own stop. */
  class StopsToo
  {
  public:
    /** @param stop must outlive it; empty: nothing is changed */
    explicit StopsToo(const std::function<bool()> &stop);
    ~StopsToo();
    StopsToo(const StopsToo &)            = delete;
    StopsToo &operator=(const StopsToo &) = delete;

  private:
    const std::function<bool()> *before;
  };

  /**
   * What the program says when it has to leave in the middle of work that cannot be stopped: what is saved, and how to go
   * on. "" for nothing but the interruption, e.g. on all ranks but the first.
   */
  void set_last_words(const std::string &words);

  /** As long as this object lives, an interrupt is being answered (the state is saved): the program is not left before. */
  class AnsweringInterrupt
  {
  public:
    AnsweringInterrupt();
    ~AnsweringInterrupt();
    AnsweringInterrupt(const AnsweringInterrupt &)            = delete;
    AnsweringInterrupt &operator=(const AnsweringInterrupt &) = delete;
  };
} // namespace apps
