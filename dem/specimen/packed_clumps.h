#pragma once

#include "dem/model/packing.h"

namespace dem
{
  class LinkMaterials;
  class Specimen;

  /**
   * Before the first step: what a packing says of rigid bodies becomes clumps of a specimen made of it, numbered on from those that it has.
   * Their mass is the body's volume (in the plane area times thickness) times the density of the material of their first pebble.
   * @throws base::InputError as Specimen::add_clump(), naming the body
   */
  void add_packed_clumps(Specimen &specimen, const Packing &packing, const LinkMaterials &materials);
} // namespace dem
