#pragma once

#include "dem/laws/cpm.h"

namespace apps
{
  /** The links of apps/scenes/concrete_uniaxial.prm, for benches of what does not depend on a scene. */
  inline dem::CpmParameters concrete_links()
  {
    dem::CpmParameters links;
    links.normal_modulus       = 25e9;
    links.shear_ratio          = 0.2;
    links.limit_elastic_strain = 1e-4;
    links.relative_ductility   = 30;
    links.cohesion             = 3e6;
    links.friction_coefficient = 0.8;
    return links;
  }
} // namespace apps
