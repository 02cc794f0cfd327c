#include "apps/commands/part_option.h"

#include <CLI/Error.hpp>

#include <cstdio>

namespace apps
{
  void add_part(CLI::App &command, int &part, int &parts, const std::string &meaning)
  {
    const auto read = [&part, &parts](const std::string &text) {
      int end = 0;
      if (std::sscanf(text.c_str(), "%d/%d%n", &part, &parts, &end) != 2 || end != static_cast<int>(text.size()) ||
          part < 1 || part > parts)
        throw CLI::ValidationError("--part", text + ": a part of a whole is wanted, \"3/40\".");
    };
    command.add_option_function<std::string>("--part", read, meaning)->type_name("3/40");
  }
} // namespace apps
