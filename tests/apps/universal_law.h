#pragma once

#include "apps/bench/size_effect_universal.h"

namespace apps_tests
{
  /** Of a concrete with aggregates of 10 mm; every notch counts as deep. */
  inline apps::UniversalLaw universal_law()
  {
    apps::UniversalLaw law;
    law.young          = 30e9;
    law.energy.value   = 40;
    law.zone.value     = 0.012;
    law.strength.value = 3.5e6;
    law.layer.value    = 0.008;
    law.exponent.value = 1.3;
    return law;
  }
} // namespace apps_tests
