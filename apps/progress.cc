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

  void Progress::update(const double done, const std::string &details)
  {
    const auto now = Clock::now();
    if (done_at_start < 0)
      done_at_start = done;
    if (now - last_shown < (terminal ? Clock::duration(terminal_interval) : Clock::duration(log_interval)))
      return;
    last_shown           = now;
    const double elapsed = std::chrono::duration<double>(now - start).count();
    const double gained  = done - done_at_start;
    const double left    = gained > 0 ? elapsed * (1 - done) / gained : 0;
    fmt::print(stderr, "{}{}: {:.0f} %, {}{}{}", terminal ? "\r" : "", title, 100 * done, details,
               gained > 0 ? ", at most " + duration_text(left) + " left" : "", terminal ? "\033[K" : "\n");
    std::fflush(stderr);
  }
} // namespace apps
