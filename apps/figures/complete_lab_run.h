#pragma once

#include "apps/figures/lab_report.h"
#include "apps/models/tension_beyond_apex.h"
#include "apps/results/run_request.h"

#include <string>
#include <vector>

namespace apps
{
  /** A run of laboratory tests that is complete, as its report needs it. @tparam Test see LabRun */
  template <typename Test>
  struct CompleteLabRun
  {
    const RunRequest                         &request;
    const typename Test::Model               &model;
    const std::vector<typename Test::Result> &results; ///< in the order of the tests, at least one
    const Test                               &test;    ///< the last one
    double                                    wall_seconds;

    /** What casts doubt on the figures of the tests, or on the materials. */
    std::vector<std::string> warnings() const
    {
      std::vector<std::string> found = warnings_of(notes_of(results));
      for (const std::string &doubt : tension_beyond_apex(model.material))
        found.push_back(doubt);
      return found;
    }
  };
} // namespace apps
