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

    const std::vector<UniaxialLoad> &loads() const { return loading.tests; } ///< of the tests, in their order
    double                           longest_without_checkpoint() const { return output.checkpoint_interval; } ///< [s]
    dem::Packing                     packing() const; ///< of all tests. @throws as make_packing()
  };
} // namespace apps
