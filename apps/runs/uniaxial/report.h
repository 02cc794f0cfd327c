#pragma once

#include "apps/results/run_request.h"
#include "apps/runs/uniaxial/lab_test.h"

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
    const UniaxialModel               &model;
    const std::vector<UniaxialResult> &results; ///< in the order of the tests, at least one
    const UniaxialLabTest             &test;    ///< the last one
    double                             wall_seconds;

    /** summary.json: figures, cost, energy, and the same for each test. */
    nlohmann::json summary() const;
    /** curve.png. @return what went wrong, "" if nothing. */
    std::string draw_curve(const std::filesystem::path &file) const;
    /** Figures, energy balance, cost and where the results lie. */
    std::string text() const;

  private:
    std::string not_in_balance() const; ///< see left_out_of_balance()
  };
} // namespace apps
