#include "apps/figures/summary_head.h"

#include "apps/process/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace apps
{
  nlohmann::json summary_head(const RunRequest &request, const std::string &kind)
  {
    return {{"scene", request.scene_file},
            {"requested", {{"kind", kind}, {"overrides", request.overrides}}},
            {"version", version()}};
  }

  nlohmann::json quantity(const double value, const std::string &unit)
  {
    return {{"value", value}, {"unit", unit.empty() ? "-" : unit}};
  }

  std::string warning_lines(const std::vector<std::string> &warnings)
  {
    std::string text;
    for (const std::string &warning : warnings)
      text += fmt::format("warning      {}\n", warning);
    return text;
  }
} // namespace apps
