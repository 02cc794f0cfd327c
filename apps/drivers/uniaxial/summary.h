#pragma once

#include "apps/drivers/parts/material_counts.h"
#include "apps/drivers/uniaxial/result.h"
#include "apps/scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** What a complete uniaxial run tells: for programs, for the eye, for the terminal. */
  struct UniaxialReport
  {
    const RunRequest                  &request;
    const std::vector<UniaxialResult> &results; ///< in the order of the tests, at least one
    const MaterialCounts              &materials;
    double                             wall_seconds;
    std::string                        not_in_balance; ///< what the energy balance leaves out; empty: nothing

    /** summary.json: figures, cost, energy, and the same for each test. */
    nlohmann::json summary() const;
    /** curve.png. @return what went wrong, "" if nothing. */
    std::string draw_curve(const std::filesystem::path &file) const;
    /** Figures, energy balance, cost and where the results lie. */
    std::string text() const;
  };
} // namespace apps
