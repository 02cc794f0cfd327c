#pragma once

#include "apps/scene/section.h"

#include <CLI/App.hpp>

#include <string>

namespace apps
{
  /** What a number of the command line is. */
  struct NumberOption
  {
    std::string option;   ///< "--radius"
    std::string quantity; ///< by whose usual sizes it is judged: "particle radius"
    std::string unit;
    Range       range;
  };

  /** An option for a number that is questioned as those of scenes are (usual_sizes.h): its unit may be named, --radius "0.5 m". */
  CLI::Option *
  add_number_option(CLI::App &command, const NumberOption &what, double &member, const std::string &meaning);
} // namespace apps
