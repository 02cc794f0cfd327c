#pragma once

#include "base/column.h"
#include "base/state.h"
#include "dem/specimen/observation.h"

#include <optional>

namespace apps
{
  /**
   * How a specimen strains sideways while it is loaded along an axis: mean strains of the particles in its middle half along the axis, by
   * least squares of displacement over place. Taken whenever the stress has grown by a tenth.
   */
  class SidewaysStrain
  {
  public:
    /** @param stress in the direction of the load, magnitude [Pa] */
    void note(const dem::ObservedSpecimen &specimen, int axis, double stress);

    /**
     * Poisson's ratio: the slope of the sideways strain over that along the axis, by least squares of all that was taken up to a third of
     * the largest stress, as for the modulus. Nothing where fewer than three were.
     */
    std::optional<double> poisson_ratio(double largest_stress) const;

    void visit_state(base::StateVisitor &visitor) { visitor.column("sideways/notes", notes); }

  private:
    static constexpr std::size_t note_length = 3;

    base::Column notes; ///< records: stress [Pa], strain along the axis, mean of those across it
  };
} // namespace apps
