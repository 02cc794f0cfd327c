#include "apps/runs/particles/damped_fall.h"

#include <fmt/format.h>

#include <cmath>

namespace apps
{
  std::string damped_fall_line(const ParticlesModel &model)
  {
    const double damping   = model.time.damping_at(0);
    const bool   may_fall  = !model.bonded() || model.more.loose(model.physics.dimension) > 0;
    const bool   is_damped = damping > 0 || model.time.damping_in_time.given();
    if (!may_fall || !is_damped || model.gravity.vector().isZero(0))
      return "";
    if (model.time.damping_in_time.given())
      return "  damping      it is local: at Time/Damping in time = D what falls freely falls at (1 - D) of the "
             "acceleration\n";
    return fmt::format("  damping      Time/Damping = {0} is local: what falls freely falls at {1:.3g} of the "
                       "acceleration, for {2:.3g} of the time. 0: as in air\n",
                       damping, 1 - damping, 1 / std::sqrt(1 - damping));
  }
} // namespace apps
