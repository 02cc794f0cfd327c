#pragma once

#include "apps/drivers/parts/duration.h"
#include "apps/process/progress.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace apps
{
  /**
   * Seconds of writing once what a run writes again and again; 0 where there is no folder for a trial.
   * @param write into a folder that is thrown away
   */
  template <typename Write>
  double seconds_to_write(const Write &write)
  {
    namespace fs        = std::filesystem;
    std::string pattern = (fs::temp_directory_path() / "breccia-forecast-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
      return 0;
    struct Folder
    {
      fs::path place;
      ~Folder()
      {
        std::error_code ignored;
        fs::remove_all(place, ignored);
      }
    } const folder{pattern};
    const Stopwatch watch;
    write(folder.place);
    return watch.seconds();
  }

  /** The line of a duration; the longest one where a stop condition may end the run at any time. */
  inline std::string stoppable_duration_line(const double seconds, const bool may_stop)
  {
    return may_stop ? fmt::format("  duration     at most {}, on this machine as it is now\n", duration_text(seconds)) :
                      duration_line(seconds);
  }
} // namespace apps
