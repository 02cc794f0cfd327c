#pragma once

#include "dem/model/packing.h"

#include <cstddef>

namespace dem
{
  /** Pairs of particles that bonds over a gap would join. */
  struct ContactAreas
  {
    std::size_t pairs = 0;
    double      half_area =
      0; ///< sum of (smaller radius * thickness); what Ortiz-Cahun et al. (2023) print as area; in space half of area [m^2]
    double area = 0; ///< sum of the joints' sections, 2 r t, in space pi r^2 [m^2]
  };

  /** Of pairs whose gap is below this [m]; pebbles of one body are none. @param thickness of discs [m] */
  ContactAreas contact_areas(const Packing &packing, double gap, int dimension, double thickness);
} // namespace dem
