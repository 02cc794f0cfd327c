#pragma once

#include "fem/materials/element_extent.h"

namespace fem
{
  /// Smallest extent of an element over all directions, over those in its plane for a plane element [m].
  double least_extent(const ElementExtent &element);
}
