#pragma once

#include <string>

namespace apps
{
  /** A figure that could not be drawn costs the user a line, not the run. @param problem "" if there was none */
  void warn_of_missing(const std::string &what, const std::string &problem);

  /** What a user should know, and may have meant so: a line on the terminal, of the first rank. */
  void give_note(const std::string &text);
} // namespace apps
