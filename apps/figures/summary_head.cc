#include "apps/figures/summary_head.h"

#include "apps/process/version.h"

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
} // namespace apps
