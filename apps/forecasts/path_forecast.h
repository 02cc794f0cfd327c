#pragma once

#include "dem/statics/quasi_static_path.h"

namespace apps
{
  /**
   * Of a whole quasi-static path, for the forecast of its duration [s]: its first points, which are elastic, measured; then as many as
   * cracking takes where a step may let a damaging strain grow by the growth step only, with the solutions that each needs.
   */
  double expected_path_seconds(const dem::LoadedNetwork         &loaded,
                               const dem::LinkMaterials         &materials,
                               const dem::QuasiStaticParameters &parameters);
} // namespace apps
