#pragma once

#include "apps/figures/complete_lab_run.h"
#include "apps/runs/quasi_static/lab_test.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace apps
{
  /** Reports of a complete quasi-static run: for programs, for the eye, for the terminal. */
  struct QuasiStaticReport : CompleteLabRun<QuasiStaticLabTest>
  {
    /** summary.json: figures, cost, energy, and the same for each test. */
    nlohmann::json summary() const;
    /** curve.png. @return what went wrong, "" if nothing. */
    std::string draw_curve(const std::filesystem::path &file) const;
    std::string text() const;
  };
} // namespace apps
