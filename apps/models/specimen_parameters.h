#pragma once

#include "apps/models/specimen.h"
#include "apps/models/time.h"
#include "dem/specimen/specimen.h"

namespace apps
{
  /** What every specimen takes from these sections, without weight and loose particles. */
  dem::SpecimenParameters
  specimen_parameters(const SpecimenSection &source, const dem::Physics &physics, const TimeSection &time);
} // namespace apps
