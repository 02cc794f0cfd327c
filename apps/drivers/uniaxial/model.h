#pragma once

#include "apps/scene/gravity_section.h"
#include "apps/scene/loading_section.h"
#include "apps/scene/material_section.h"
#include "apps/scene/output_section.h"
#include "apps/scene/specimen_section.h"
#include "dem/specimen/specimen.h"

namespace apps
{
  /** Everything that a uniaxial run computes from. */
  struct UniaxialModel
  {
    SpecimenSection         source;
    dem::SpecimenParameters specimen;
    MaterialSection         material;
    GravitySection          gravity;
    UniaxialLoadingSection  loading;
    OutputSection           output;
  };
} // namespace apps
