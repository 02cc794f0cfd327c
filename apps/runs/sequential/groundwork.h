#pragma once

#include "apps/runs/sequential/law_origin.h"
#include "apps/runs/sequential/model.h"
#include "dem/model/packing.h"

#include <string>
#include <vector>

namespace apps
{
  /** What is known before anything runs, see groundwork_of(). */
  struct SequentialGroundwork
  {
    dem::Packing             packing;
    double                   element_size = 0; ///< mean of the mesh [m]
    std::size_t              elements = 0, unknowns = 0;
    std::string              horizontal_unit, vertical_unit; ///< of what the study compares
    LawOrigin                origin;
    std::vector<std::string> doubts; ///< warnings
  };

  /**
   * What is known before anything runs: particles and solid fit each other and the study, and what there is to be doubted.
   * @throws base::InputError where they do not fit
   */
  SequentialGroundwork groundwork_of(const SequentialModel &model);
} // namespace apps
