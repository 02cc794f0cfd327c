#pragma once

#include "dem/peridynamics/equilibrium.h"
#include "dem/peridynamics/relaxation.h"
#include "dem/peridynamics/transfer.h"

#include <cstdint>
#include <string>

namespace apps
{
  /** A plate of 1 m x 0.5 m under uniform tractions, as a bench of peridynamics varies it. */
  struct PeridynamicPlate
  {
    std::string                       study, name;       ///< "delta", "B, paper, calibrated"
    int                               cells       = 100; ///< along its length
    double                            ratio       = 3.015;
    dem::peridynamics::Volumes        volumes     = dem::peridynamics::Volumes::full;
    dem::peridynamics::Layout         layout      = dem::peridynamics::Layout::cell_centred;
    dem::peridynamics::Calibration    calibration = dem::peridynamics::Calibration::none;
    dem::peridynamics::TractionWeight weight      = dem::peridynamics::TractionWeight::paper;
    dem::peridynamics::TractionForm   form        = dem::peridynamics::TractionForm::transfer;
    bool                              corrected   = false; ///< at its surface
  };

  /** How far off it is, beside the continuum, and what it costs; not a number where there is no equilibrium. */
  struct PeridynamicErrors
  {
    double tension_across = 0,
           tension_along  = 0; ///< largest on the centre lines over the largest exact displacement [-]
    double      shear     = 0; ///< the same under pure shear, the worse of u_x on x = 0 and u_y on y = 0
    double      seconds   = 0; ///< of both solutions
    std::size_t bonds     = 0;
  };

  PeridynamicErrors errors_of(const PeridynamicPlate &plate);

  /** Steps of a relaxation until residuals are below 1e-3 and 1e-6. */
  struct PeridynamicSteps
  {
    std::string  load;
    bool         gershgorin = true;
    std::int64_t coarse = 0, fine = 0;
  };

  /** Of the pulled plate, or bent by its sides or its edges: load "tension", "bending (a)" or "bending (b)". */
  PeridynamicSteps steps_of(const std::string &load, bool gershgorin, int cells);

  /** Bond updates of bonds that may break, in a square or a cube of so many nodes along an edge. */
  struct PeridynamicRate
  {
    int         dimension;
    std::size_t bonds;
    double      per_second; ///< in all threads
  };
  PeridynamicRate rate_of(int dimension, int nodes);
} // namespace apps
