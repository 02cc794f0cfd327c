#pragma once

#include "apps/results/run_request.h"
#include "apps/runs/quasi_static/lab_test.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** What a complete quasi-static run tells: for programs, for the eye, for the terminal. */
  struct QuasiStaticReport
  {
    const RunRequest                     &request;
    const QuasiStaticModel               &model;
    const std::vector<QuasiStaticResult> &results; ///< in the order of the tests, at least one
    const QuasiStaticLabTest             &test;    ///< the last one
    double                                wall_seconds;

    /** summary.json: figures, cost, energy, and the same for each test. */
    nlohmann::json summary() const;
    /** curve.png. @return what went wrong, "" if nothing. */
    std::string draw_curve(const std::filesystem::path &file) const;
    std::string text() const;
  };
} // namespace apps
