#pragma once

#include "dem/laws/linear_contact.h"
#include "dem/specimen/specimen.h"

/** Loose grains under their weight. */
namespace grains
{
  inline dem::LinearContactParameters rough()
  {
    dem::LinearContactParameters grains;
    grains.effective_modulus    = 1e8;
    grains.stiffness_ratio      = 1.5;
    grains.friction_coefficient = 0.5;
    return grains;
  }

  inline dem::SpecimenParameters falling()
  {
    dem::SpecimenParameters parameters;
    parameters.density           = 2600;
    parameters.interaction_ratio = 1;
    parameters.damping           = 0.2;
    parameters.gravity           = {0, 0, -9.81};
    return parameters;
  }
} // namespace grains
