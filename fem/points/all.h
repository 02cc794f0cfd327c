#pragma once

#include "fem/materials/anisotropic_elastic.h"
#include "fem/materials/damage_plastic/concrete.h"
#include "fem/materials/isotropic_elastic.h"

#include <tuple>

namespace fem
{
  /// The materials that a scene can name; scenes, help, point-test, pictures and tests of all of them go through this list.
  using Materials = std::tuple<IsotropicElastic, AnisotropicElastic, DamagePlasticConcrete>;
}
