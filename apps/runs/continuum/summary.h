#pragma once

#include "apps/figures/contact_figures.h"
#include "apps/results/run_request.h"
#include "apps/runs/continuum/probe_column.h"
#include "fem/output/solid_extremes.h"
#include "postprocess/files/csv_table.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** How large the model of a continuum run is. */
  struct ContinuumSize
  {
    double elements = 0, unknowns = 0, points = 0;
  };

  /** How the words begin of a run that ended where there was no equilibrium any more. */
  inline const std::string no_equilibrium = "no equilibrium: ";

  /** The words of one that ended because all of the solid softens and little force is left. */
  inline const std::string softened = "softens everywhere";

  /** What a continuum run found and took: for programs, for the eye, for the terminal. */
  struct ContinuumReport
  {
    const RunRequest                 &request;
    const postprocess::CsvTable      &series;
    std::vector<ProbeColumn>          probes        = {}; ///< of the solid, among the columns of the series
    ContinuumSize                     size          = {};
    std::map<std::string, double>     cost          = {};
    std::string                       linear_solver = "";
    double                            wall_seconds  = 0;
    bool                              is_static     = true;
    const ContactFigures             *contact       = nullptr; ///< nullptr: nothing can touch
    ReferencesSection                 references    = {};
    std::vector<std::string>          notes         = {};    ///< of the materials
    std::optional<fem::SolidExtremes> extremes      = {};    ///< of the last state; not reported of solids in motion
    bool                              is_linear     = false; ///< a finer mesh has an answer to come closer to

    /** "end", "stop fraction", "steps at most", softened, no_equilibrium and why, or "end of validity: " and why. */
    std::string ended_by = "";

    std::optional<double> fracture_zone_width = {}; ///< [m]
    std::string           doubt               = ""; ///< about its end, a sentence; "": none

    nlohmann::json summary() const;
    std::string    text() const;

  private:
    nlohmann::json figures() const;
    double         last(const std::string &column) const;

    std::vector<std::string> warnings() const;
  };
} // namespace apps
