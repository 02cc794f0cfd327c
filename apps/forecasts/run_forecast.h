#pragma once

#include "apps/forecasts/duration.h"
#include "apps/process/progress.h"
#include "postprocess/files/errors.h"
#include "postprocess/files/scratch_folder.h"

#include <fmt/format.h>

#include <string>

namespace apps
{
  /**
   * Seconds of writing once what a run writes again and again; 0 where it cannot be tried.
   * @param write into a folder that is thrown away
   */
  template <typename Write>
  double seconds_to_write(const Write &write)
  try
    {
      const postprocess::ScratchFolder folder("forecast");
      return seconds_of([&] { write(folder.path()); });
    }
  catch (const postprocess::OutputError &)
    {
      return 0;
    }

  /** Seconds of doing once what a run does again and again. */
  template <typename Work>
  double seconds_of(const Work &work)
  {
    const base::Stopwatch watch;
    work();
    return watch.seconds();
  }

  /**
   * The line of a duration that a stop condition may cut short.
   * @param whole    without one [s]
   * @param earliest from when on one is requested [s]; 0: at any time; `whole`: there is none
   */
  inline std::string stoppable_duration_line(const double whole, const double earliest)
  {
    if (earliest >= whole)
      return duration_line(whole);
    return fmt::format("  duration     {}, on this machine as it is now\n",
                       earliest > 0 ? "from " + duration_text(earliest) + " to " + duration_text(whole) :
                                      "at most " + duration_text(whole));
  }
} // namespace apps
