#pragma once

#include "apps/figures/lab_report.h"
#include "apps/figures/motion_report.h"
#include "apps/results/run_request.h"
#include "apps/runs/coupled/body.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace apps
{
  /** The results of a complete run of kind "coupled": summary, figures and lines for the terminal. */
  struct CoupledReport
  {
    const RunRequest            &request;
    const CoupledModel          &model;
    CoupledBody                 &body;
    const MaterialCounts        &materials;
    const StaticStart           &start;
    const postprocess::CsvTable &series; ///< complete
    double                       wall_seconds;
    std::string                  not_in_balance; ///< see left_out_of_balance()

    nlohmann::json summary() const;
    /** Figures, what ended the run, energy balance and cost; and a warning where nothing ever touched. */
    std::string text() const;

  private:
    MotionReport             common() const;
    LabNotes                 notes() const; ///< @pre there is a laboratory test
    std::vector<std::string> warnings() const;
    nlohmann::json           figures() const;
    nlohmann::json           energy() const;
    nlohmann::json           cost() const;
  };
} // namespace apps
