#include "apps/commands/length_unit_option.h"

#include <CLI/Error.hpp>

#include <functional>
#include <string>

namespace apps
{
  void add_length_unit(CLI::App &command, std::optional<base::LengthUnit> &unit)
  {
    const auto take = [&unit](const std::string &name) {
      unit = base::length_unit(name);
      if (!unit)
        throw CLI::ValidationError("--length-unit", name + ": expected one of " + base::length_unit_names());
    };
    command
      .add_option_function("--length-unit", std::function<void(const std::string &)>(take),
                           "Of the lengths in the packing's file: " + base::length_unit_names() +
                             "; default: as it says itself, or m")
      ->type_name("UNIT");
  }
} // namespace apps
