#pragma once

#include "apps/results/run_request.h"
#include "apps/runs/structure/structure.h"
#include "apps/specimens/link_classes.h"
#include "postprocess/files/csv_table.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace apps
{
  /** The results of a complete run of kind "structure": summary, figures and lines for the terminal. */
  struct StructureReport
  {
    const RunRequest            &request;
    const StructureModel        &model;
    const Structure             &structure;
    const ParticleMedia         &media;  ///< of the particles, where they are known
    const postprocess::CsvTable &series; ///< complete
    double                       wall_seconds;

    nlohmann::json summary() const;
    std::string    text() const;

  private:
    nlohmann::json figures() const;
    nlohmann::json weight() const; ///< what it did when it was put on
    LinkClasses    classes() const;
    base::Column   class_figures() const; ///< of these, now
    nlohmann::json energy() const;
    nlohmann::json cost() const;
    /** Points of the path that were controlled so. */
    std::size_t points_by(dem::StepControl control) const;
  };
} // namespace apps
