#pragma once

#include "apps/figures/lab_report.h"
#include "apps/models/loading.h"
#include "apps/specimens/static_start.h"
#include "base/column.h"
#include "base/state.h"
#include "dem/model/energy.h"
#include "dem/specimen/results.h"

#include <cstdint>

namespace apps
{
  /** What one uniaxial test found and what it took. */
  struct UniaxialResult
  {
    UniaxialLoad       load = UniaxialLoad::tension;
    StaticStart        start;
    LabNotes           notes;                   ///< figures up to now; the crack when the test has ended
    dem::EnergyAccount energy;                  ///< at the end
    double             worst_balance_error = 0; ///< of all samples
    double             time_step           = 0; ///< [s], at the start
    dem::Counts        at_start, at_end;
    std::int64_t       steps            = 0;
    double             link_updates     = 0; ///< sum over the steps of links and contacts
    double             stepping_seconds = 0; ///< wall clock, in steps only
    base::Column       strain, stress;       ///< the curve, tension positive; filled when the test has ended
    base::Column       link_classes;         ///< figures of LinkClasses, likewise
    base::Column       emission;             ///< row of EmissionFigures, likewise
    double fracture_zone_width = 0; ///< [m], likewise; 0: not requested, or nothing is dissipated after the peak

    /** Everything that a resumed run must still know of this test. */
    void visit_state(base::StateVisitor &visitor);
  };
} // namespace apps
