#pragma once

#include "apps/bench/scene_variant.h"

#include <cstdint>

namespace apps
{
  /** One case of a bench of impacts, beside the known answers. */
  struct ImpactMeasurement
  {
    SceneVariant which;
    std::size_t  elements    = 0;
    double       force_error = 0, time_error = 0; ///< relative
    double       made    = 0;                     ///< by the coupling or the contact, over the initial energy
    double       missing = 0;                     ///< in the account of all, likewise
    std::int64_t windows = 0;                     ///< steps, of both sides together
    double       cost    = 0;                     ///< processor time [s]
  };
} // namespace apps
