#pragma once

#include "apps/figures/motion_report.h"
#include "apps/results/run_request.h"
#include "apps/runs/particles/body.h"
#include "dem/laboratory/lab_test.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace apps
{
  /** Reports of a complete run of kind "particles": for programs, for the eye, for the terminal. */
  struct ParticlesReport
  {
    const RunRequest            &request;
    const ParticlesModel        &model;
    const ParticlesBody         &body;
    const MaterialCounts        &materials;
    const StaticStart           &start;
    const postprocess::CsvTable &series; ///< complete
    double                       wall_seconds;
    std::string                  not_in_balance;   ///< see left_out_of_balance()
    const dem::LabTest          *slower = nullptr; ///< the test's loading at half the speed; nullptr: there was none
    const coupling::PreciceExchange *exchange = nullptr; ///< with other programs; nullptr: there was none

    nlohmann::json summary() const;
    /** Last value of every probe, what ended the run, energy balance and cost. */
    std::string text() const;

  private:
    const dem::ObservedSpecimen &specimen() const { return body.specimen(); }
    MotionReport                 common() const;
    nlohmann::json               figures() const;
  };
} // namespace apps
