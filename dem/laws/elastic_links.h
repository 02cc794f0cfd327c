#pragma once

#include "dem/model/materials.h"

namespace dem
{
  /**
   * Links of which nothing but the stiffness matters, for a specimen whose physics have neither damage nor friction: bonds with
   * normal modulus E [Pa], > 0, and shear modulus `shear_ratio` E, > 0 (doc/theory/links.md). @throws base::InputError when a specimen is made of them
   * out of range.
   */
  LinkMaterials elastic_links(double normal_modulus, double shear_ratio);
} // namespace dem
