#pragma once

#include "apps/scene/specimen_section.h"
#include "dem/packing/packing.h"

namespace apps
{
  /** The particles that a scene asks for: generated or read, repeated and cropped to its box. @throws dem::InputError. */
  dem::Packing make_packing(const SpecimenSection &specimen);

  /** Solid volume over the volume of the periodic cell, or of the box that encloses the spheres. */
  double packing_fraction(const dem::Packing &packing);
} // namespace apps
