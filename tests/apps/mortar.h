#pragma once

#include "dem/laws/cpm.h"

namespace apps_tests
{
  /** The mortar between aggregates. */
  inline dem::CpmParameters mortar()
  {
    dem::CpmParameters p;
    p.normal_modulus       = 25e9;
    p.shear_ratio          = 0.2;
    p.limit_elastic_strain = 1e-4;
    p.relative_ductility   = 30;
    p.cohesion             = 3e6;
    p.friction_coefficient = 0.8;
    return p;
  }
} // namespace apps_tests
