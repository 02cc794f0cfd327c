#pragma once

#include "dem/laboratory/test_figures.h"
#include "postprocess/pictures/plot.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace apps
{
  /** Results of others in the same test; a run is reported beside them, and does not depend on them. 0: nothing is known. */
  struct PublishedFigures
  {
    double strength = 0; ///< in the measure of the test [Pa]
    double modulus  = 0; ///< [Pa]
    double poisson  = 0; ///< ratio of Poisson [-]

    bool given() const { return strength > 0 || modulus > 0 || poisson > 0; }

    /** Each that is given, with its unit, and what was found over it; null where that is not determined. */
    nlohmann::json json(const dem::TestFigures &found) const;
    /** A line for the terminal; empty where nothing is given. */
    std::string text(const dem::TestFigures &found) const;
    /**
     * The modulus as a line from the origin to the strength, and the strength as one from there on.
     * @param largest_strain where the picture ends [-] @param largest_stress likewise, where no strength is given [Pa]
     * @return nothing where neither modulus nor strength is given
     */
    std::optional<postprocess::StressStrainCurve> curve(double largest_strain, double largest_stress) const;
  };
} // namespace apps
