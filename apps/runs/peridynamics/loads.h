#pragma once

#include "apps/models/region.h"
#include "apps/text/expression.h"
#include "apps/text/vector_formula.h"
#include "base/entry_path.h"
#include "dem/peridynamics/loads.h"
#include "dem/peridynamics/transfer.h"

#include <list>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** Sub-section of "Tractions". */
  struct PeridynamicTraction
  {
    std::string                       name, boundary;
    std::string                       written; ///< the formulas as typed
    std::vector<Expression>           value;   ///< components; one alone: along the normal, or of a rod along x
    Expression                        pressure;
    dem::peridynamics::TractionWeight weight = dem::peridynamics::TractionWeight::paper;
    dem::peridynamics::TractionForm   form   = dem::peridynamics::TractionForm::transfer;

    /** At a load factor, or a time [s]: formulas without t grow with a load factor. [Pa] */
    Eigen::Vector3d at(const dem::peridynamics::BoundaryPoint &point, int dimension, double when, bool quiet) const;
  };

  /** Sub-section of "Displacements". */
  struct PeridynamicSupport
  {
    std::string name, boundary; ///< "": the region
    Region      region;
    Expressions displacement;
  };

  /** The loads of a body, and reports of them. */
  struct PeridynamicLoads
  {
    dem::peridynamics::Loads                                  act;
    std::vector<std::shared_ptr<dem::peridynamics::Transfer>> transfers;
    double first_traction = 0; ///< largest magnitude of the first traction at the load factor 1 [Pa]; 0: there is none
    bool   held           = false; ///< some motion is prescribed
    std::vector<std::string> warnings;
  };

  /** Sections "Tractions" and "Displacements". */
  struct PeridynamicLoadsSection
  {
    std::list<PeridynamicTraction> tractions;
    std::list<PeridynamicSupport>  supports;

    /** @throws base::InputError */
    void check(const base::EntryPath &root, int dimension) const;
    /** @param quiet driven by a load factor, not by time @throws base::InputError for boundaries that the body does not have */
    PeridynamicLoads on(const dem::peridynamics::Bonds &bonds, bool quiet) const;
  };
} // namespace apps
