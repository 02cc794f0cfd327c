#pragma once

#include "base/state.h"
#include "fem/solid/solid.h"

#include <cstdint>
#include <vector>

namespace apps
{
  /** Detects that a solid softens everywhere: from state to state its force falls while the damage of all its points grows. */
  template <int dim>
  class SofteningWatch
  {
  public:
    /** Take a new state. All ranks together. @param force that the solid bears, in magnitude [N] */
    void update(fem::Solid<dim> &solid, double force);

    /** It has done so in the last ten states. Elastic points do not count; neither does what is damaged through and through. */
    bool softens_everywhere() const { return in_a_row >= enough; }

    /** @param solid with the histories of the last state */
    void visit_state(base::StateVisitor &visitor, fem::Solid<dim> &solid);

  private:
    static constexpr std::int64_t enough = 10;

    std::vector<double> damage; ///< of this rank's points in the last state
    double              last_force = 0;
    std::int64_t        in_a_row   = 0;
  };
} // namespace apps
