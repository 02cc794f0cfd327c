#pragma once

#include "apps/figures/complete_lab_run.h"
#include "apps/runs/uniaxial/lab_test.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace apps
{
  /** Reports of a complete uniaxial run: for programs, for the eye, for the terminal. */
  struct UniaxialReport : CompleteLabRun<UniaxialLabTest>
  {
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
