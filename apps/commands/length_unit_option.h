#pragma once

#include "base/length_unit.h"

#include <CLI/App.hpp>

#include <optional>

namespace apps
{
  /** Option --length-unit of a packing that a command reads; empty: as the file says itself, or else metres. */
  void add_length_unit(CLI::App &command, std::optional<base::LengthUnit> &unit);
} // namespace apps
