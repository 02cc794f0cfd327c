#pragma once

#include "apps/figures/fracture_zone.h"
#include "base/column.h"
#include "base/state.h"
#include "fem/solid/solid.h"

namespace apps
{
  /**
   * Where a solid has dissipated energy since its start: from state to state the work of the mean stress of each point less what the point
   * stores more, of second order in the step.
   */
  template <int dim>
  class DissipatedPlaces
  {
  public:
    /** Take a new state. All ranks together, and all get the same. */
    void update(fem::Solid<dim> &solid, const fem::Vector &displacement);

    /** From now on it counts from this state. */
    void start_at(fem::Solid<dim> &solid, const fem::Vector &displacement);

    const SpreadAmount &so_far() const { return sum; }

    void visit_state(base::StateVisitor &visitor);

  private:
    base::Column
      points; ///< of this rank in the last state: strain (6), stress (6) [Pa], stored [J/m^3]; none: all at rest
    SpreadAmount sum;
  };
} // namespace apps
