#pragma once

#include <string>

namespace apps
{
  /** Where a value was written: a line of a file, or the command line. */
  struct Place
  {
    std::string file;     ///< empty: the command line
    int         line = 0; ///< from 1; 0: the file as a whole

    /** "file:line", "file" or "command line": how every message about the value begins. */
    std::string text() const
    {
      if (file.empty())
        return "command line";
      return line > 0 ? file + ":" + std::to_string(line) : file;
    }
  };
} // namespace apps
