#pragma once

#include "apps/results/run_request.h"
#include "apps/runs/cell/model.h"
#include "apps/specimens/material_counts.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Reports of a complete run of a periodic cell: for programs, for the eye, for the terminal. */
  struct CellReport
  {
    const RunRequest            &request;
    const CellModel             &model;
    const dem::Packing          &packing;
    const dem::ObservedSpecimen &specimen;
    const dem::CellTest         &test;
    const MaterialCounts        &materials;
    double                       worst_balance_error, wall_seconds;

    /** summary.json: extremes of stress, localisation, how it ended, cost, energy. */
    nlohmann::json summary() const;
    /** curve.png: every stress over the strain that moved most. @return what went wrong, "" if nothing. */
    std::string draw_curve(const std::filesystem::path &file) const;
    std::string text() const;

  private:
    std::string              ended_by() const; ///< "end of the path", or "stress not reached"
    std::string              reason() const;   ///< of the latter
    std::vector<std::string> warnings() const;
  };
} // namespace apps
