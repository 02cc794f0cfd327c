#pragma once

#include "apps/results/run_request.h"
#include "apps/specimens/material_counts.h"
#include "apps/specimens/static_start.h"
#include "dem/specimen/observation.h"
#include "postprocess/files/csv_table.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace apps
{
  /** The report of a complete motion, of particles alone or with a solid. */
  struct MotionReport
  {
    const RunRequest            &request;
    std::string                  kind; ///< of the scene
    std::string                  ended_by;
    double                       end_time; ///< [s]
    const MaterialCounts        &materials;
    const StaticStart           &start;
    const postprocess::CsvTable &series;         ///< complete
    const std::string           &not_in_balance; ///< see left_out_of_balance()
    const dem::ObservedSpecimen &specimen;       ///< as it is at the end
    std::vector<std::string>     notes    = {};  ///< what else a user should know, one sentence each
    std::vector<std::string>     warnings = {};  ///< what else a user should doubt, likewise

    /** @param energy its terms by name, to which the balance is added */
    nlohmann::json summary(const nlohmann::json &figures, nlohmann::json energy, nlohmann::json cost) const;
    /** Lines for the terminal: what ended the run, its start, the balance of its energy. */
    std::string text() const;

  private:
    std::vector<std::string> doubts() const; ///< what is large that laws take for small, and the warnings
    double                   balance_error() const;
  };
} // namespace apps
