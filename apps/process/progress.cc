#include "apps/process/progress.h"

#include "apps/process/mpi_session.h"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <thread>
#include <vector>

namespace apps
{
  namespace
  {
    constexpr std::chrono::milliseconds terminal_interval{200};
    constexpr std::chrono::seconds      terminal_silence{2}; ///< after which a line on a terminal shows the time anew
    thread_local int                    silences = 0;
  } // namespace

  SilentWork::SilentWork() { ++silences; }
  SilentWork::~SilentWork() { --silences; }

  /** All work under way, innermost last, and the thread that speaks for work that is silent. */
  class ProgressBoard
  {
  public:
    /** Kept for ever, as the thread is. */
    static ProgressBoard &only()
    {
      static auto *const board = new ProgressBoard;
      return *board;
    }

    void add(Progress *work)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      under_way.push_back(work);
      if (!started)
        start();
    }

    void remove(Progress *work)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      under_way.erase(std::remove(under_way.begin(), under_way.end(), work), under_way.end());
    }

    std::mutex mutex;

  private:
    /** Signals are for the thread that works. */
    void start()
    {
      started = true;
      sigset_t all, before;
      sigfillset(&all);
      pthread_sigmask(SIG_SETMASK, &all, &before);
      std::thread([this] { watch(); }).detach();
      pthread_sigmask(SIG_SETMASK, &before, nullptr);
    }

    [[noreturn]] void watch()
    {
      for (;;)
        {
          std::this_thread::sleep_for(terminal_interval);
          const std::lock_guard<std::mutex> lock(mutex);
          if (!under_way.empty())
            under_way.back()->speak_up();
        }
    }

    std::vector<Progress *> under_way;
    bool                    started = false;
  };

  std::string duration_text(const double seconds)
  {
    const auto whole = static_cast<long long>(std::ceil(seconds));
    if (whole < 60)
      return fmt::format("{} s", whole);
    if (whole < 3600)
      return fmt::format("{}:{:02} min", whole / 60, whole % 60);
    return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
  }

  Progress::Progress(std::string what, const Shown shown, const Clock::duration log_interval)
    : title(std::move(what))
    , terminal(isatty(STDERR_FILENO) != 0)
    , interval(terminal ? Clock::duration(terminal_interval) : log_interval)
    , silent(silences > 0 || !is_first_rank() || (terminal && shown == Shown::in_logs))
    , start(Clock::now())
    , last_shown(start)
    , last_reported(start)
  {
    if (!silent)
      ProgressBoard::only().add(this);
  }

  Progress::~Progress()
  {
    ProgressBoard::only().remove(this);
    clear();
  }

  void Progress::clear()
  {
    const std::lock_guard<std::mutex> lock(ProgressBoard::only().mutex);
    if (terminal && !cleared)
      fmt::print(stderr, "\r\033[K");
    cleared    = true;
    last_shown = terminal ? Clock::now() : last_shown;
  }

  bool Progress::is_due() const { return !silent && Clock::now() - last_shown >= interval; }

  void Progress::report(const double done, const std::string &details)
  {
    last_done     = done;
    last_details  = details;
    last_reported = Clock::now();
    if (is_due())
      show(news());
  }

  void Progress::update(const double done, const std::string &details)
  {
    const std::lock_guard<std::mutex> lock(ProgressBoard::only().mutex);
    if (done_at_start < 0)
      done_at_start = done;
    report(done, details);
  }

  void Progress::update(const std::string &details)
  {
    const std::lock_guard<std::mutex> lock(ProgressBoard::only().mutex);
    report(-1, details);
  }

  std::string Progress::how_far() const
  {
    if (last_done < 0)
      return last_details;
    return fmt::format("{:.0f} %{}{}", 100 * last_done, last_details.empty() ? "" : ", ", last_details);
  }

  std::string Progress::news() const
  {
    const double gained = last_done - done_at_start;
    if (last_done < 0 || gained <= 0)
      return how_far();
    const double elapsed = std::chrono::duration<double>(last_reported - start).count();
    const double since   = std::chrono::duration<double>(Clock::now() - last_reported).count();
    return how_far() + ", at most " + duration_text(std::max(0.0, elapsed * (1 - last_done) / gained - since)) +
           " left";
  }

  void Progress::speak_up()
  {
    const auto now = Clock::now();
    if (silent || now - last_shown < (terminal ? Clock::duration(terminal_silence) : interval))
      return;
    if (last_reported > last_shown) // too early for the last line, and the next one may take long
      return show(news());
    // An estimate of long ago would be stale.
    const std::string so_far = duration_text(std::chrono::duration<double>(now - start).count()) + " so far";
    show(last_reported == start ? so_far : how_far() + "; " + so_far);
  }

  void Progress::show(const std::string &text)
  {
    last_shown = Clock::now();
    cleared    = false;
    fmt::print(stderr, "{}{}: {}{}", terminal ? "\r" : "", title, text, terminal ? "\033[K" : "\n");
    std::fflush(stderr);
  }
} // namespace apps
