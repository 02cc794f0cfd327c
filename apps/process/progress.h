#pragma once

#include <chrono>
#include <string>

namespace apps
{
  /**
   * Shows how far a long piece of work is: on a terminal one line that updates itself, otherwise one line a minute.
   *
   * Work that says nothing for long (a factorisation, the search for links) is spoken for by a thread of its own, so that
   * the lines come in any case. One piece of work may be part of another: the innermost is shown. Written to the standard
   * error, so that the standard output holds results only.
   */
  class Progress
  {
  public:
    using Clock = std::chrono::steady_clock;

    enum class Shown
    {
      everywhere,
      in_logs ///< not on a terminal: work whose parts report more, or that prints
    };

    /** @param title what is being done, e.g. "tension". @param log_interval from line to line, if not on a terminal. */
    explicit Progress(std::string     title,
                      Shown           shown        = Shown::everywhere,
                      Clock::duration log_interval = std::chrono::minutes(1));
    ~Progress();
    Progress(const Progress &)            = delete;
    Progress &operator=(const Progress &) = delete;

    /**
     * @param done part of the work done, in [0, 1].
     * @param details e.g. the rate, shown behind the part.
     * The time left is an upper bound when the work may end early.
     */
    void update(double done, const std::string &details);

    /** The same for work whose end is not known: no part, no time left. */
    void update(const std::string &details);

    /** Take the updating line away, before something else is written. */
    void clear();

  private:
    friend class ProgressBoard;

    bool        is_due() const;
    void        report(double done, const std::string &details);
    std::string how_far() const; ///< what was reported last
    std::string news() const;    ///< the same with the time left
    void        show(const std::string &text);
    void        speak_up(); ///< nothing was shown for long

    std::string       title;
    bool              terminal;
    Clock::duration   interval;
    double            done_at_start = -1; ///< a resumed run starts late
    double            last_done     = -1; ///< < 0: its end is not known, or nothing was reported
    std::string       last_details;
    bool              cleared = true;                   ///< nothing stands on the terminal
    bool              silent;                           ///< never speaks
    Clock::time_point start, last_shown, last_reported; ///< reported may be shown later
  };

  /** As long as this object lives, work that is begun in its thread prints nothing: a run without a terminal. */
  class SilentWork
  {
  public:
    SilentWork();
    ~SilentWork();
    SilentWork(const SilentWork &)            = delete;
    SilentWork &operator=(const SilentWork &) = delete;
  };

  /** Seconds as "42 s", "3:07 min" or "5:02 h". */
  std::string duration_text(double seconds);
} // namespace apps
