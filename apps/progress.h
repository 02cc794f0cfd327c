#pragma once

#include <chrono>
#include <string>

namespace apps
{
  /**
   * Tells how far a long piece of work is: on a terminal one line that updates itself, otherwise one line a minute.
   *
   * Written to the standard error, so that the standard output holds results only.
   */
  class Progress
  {
  public:
    /** @param title what is being done, e.g. "tension". */
    explicit Progress(std::string title);
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
    bool is_due();
    void show(const std::string &text);

    using Clock = std::chrono::steady_clock;
    std::string       title;
    bool              terminal;
    double            done_at_start = -1; ///< a resumed run starts late
    Clock::time_point start, last_shown;
  };

  /** Seconds as "42 s", "3:07 min" or "5:02 h". */
  std::string duration_text(double seconds);
} // namespace apps
