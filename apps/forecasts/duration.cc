#include "apps/forecasts/duration.h"

#include "apps/process/progress.h"

#include <fmt/format.h>

#include <regex>

namespace apps
{
  double seconds_per_unit(const std::function<std::int64_t(std::int64_t)> &work)
  {
    constexpr double enough = 0.5;
    work(1); // the first one makes room for what the others use again
    const base::Stopwatch watch;
    std::int64_t          units = 0;
    for (std::int64_t batch = 1; watch.seconds() < enough; batch *= 2)
      {
        const std::int64_t done = work(batch);
        units += done;
        if (done < batch)
          break;
      }
    return units > 0 ? watch.seconds() / static_cast<double>(units) : 0.0;
  }

  double seconds_per_step(const dem::ObservedSpecimen &body, const std::function<void(std::int64_t)> &advance)
  {
    return seconds_per_unit([&](const std::int64_t count) {
      const std::int64_t before = body.steps();
      advance(count);
      return body.steps() - before;
    });
  }

  std::optional<double> duration_in(const std::string &forecast)
  {
    static const std::regex line("  duration [^\n]*"), time("([0-9]+)(:([0-9]+))? (s|min|h)\\b");
    std::smatch             found;
    if (!std::regex_search(forecast, found, line))
      return std::nullopt;
    const std::string     said = found.str();
    std::optional<double> seconds;
    for (std::sregex_iterator each(said.begin(), said.end(), time), end; each != end; ++each)
      if (!seconds || said.find("roughly") == std::string::npos) // a guess stands first, a limit last
        {
          const double unit = (*each)[4] == "h" ? 3600 : (*each)[4] == "min" ? 60 : 1;
          seconds           = unit * (std::stod((*each)[1]) + ((*each)[3].matched ? std::stod((*each)[3]) / 60 : 0));
        }
    return seconds;
  }

  std::string duration_line(const double expected, const double at_most)
  {
    return fmt::format("  duration     roughly {}{}, on this machine as it is now\n", duration_text(expected),
                       at_most > 0 ? ", at most " + duration_text(at_most) : "");
  }
} // namespace apps
