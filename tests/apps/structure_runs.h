#pragma once

#include "tests/apps/interrupted_runs.h"
#include "tests/apps/scene_runs.h"

#include <algorithm>

/** Of structures driven along their equilibria. */
namespace apps_tests
{
  inline double peak_load(const Results &results, const char *reaction = "reaction_load_z")
  {
    const auto &load = results.series.column(reaction);
    return -*std::min_element(load.begin(), load.end());
  }

  /** All that a resumed run has to leave as one that was never interrupted does. */
  inline std::string kept_of_structure(const std::filesystem::path &results)
  {
    return listing_of(results / "solid") + listing_of(results / "particles") + listing_of(results / "links") +
           content_of(results / "series.csv") + content_of(results / "structure.pvd");
  }
} // namespace apps_tests
