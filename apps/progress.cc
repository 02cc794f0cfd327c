#include "apps/progress.h"

#include <fmt/format.h>

#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace apps
{
  namespace
  {
    constexpr std::chrono::milliseconds terminal_interval{200};
    constexpr std::chrono::minutes      log_interval{1};
  } // namespace

  std::string duration_text(const double seconds)
  {
    const auto whole = static_cast<long long>(std::ceil(seconds));
    if (whole < 60)
      return fmt::format("{} s", whole);
    if (whole < 3600)
      return fmt::format("{}:{:02} min", whole / 60, whole % 60);
    return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
  }

  Progress::Progress(std::string what)
    : title(std::move(what))
    , terminal(isatty(STDERR_FILENO) != 0)
    , start(Clock::now())
    , last_shown(start)
  {
  }

  Progress::~Progress() { clear(); }

  void Progress::clear()
  {
    if (terminal)
      fmt::print(stderr, "\r\033[K");
  }

  bool Progress::is_due()
  {
    const auto now = Clock::now();
    if (now - last_shown < (terminal ? Clock::duration(terminal_interval) : Clock::duration(log_interval)))
      return false;
    last_shown = now;
    return true;
  }

  void Progress::update(const double done, const std::string &details)
  {
    if (done_at_start < 0)
      done_at_start = done;
    if (!is_due())
      return;
    const double elapsed = std::chrono::duration<double>(last_shown - start).count();
    const double gained  = done - done_at_start;
    show(fmt::format("{:.0f} %, {}{}", 100 * done, details,
                     gained > 0 ? ", at most " + duration_text(elapsed * (1 - done) / gained) + " left" : ""));
  }

  void Progress::update(const std::string &details)
  {
    if (is_due())
      show(details);
  }

  void Progress::show(const std::string &text)
  {
    fmt::print(stderr, "{}{}: {}{}", terminal ? "\r" : "", title, text, terminal ? "\033[K" : "\n");
    std::fflush(stderr);
  }
} // namespace apps
