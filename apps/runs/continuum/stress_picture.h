#pragma once

#include "fem/output/solid_extremes.h"

#include <filesystem>
#include <string>

namespace apps
{
  /**
   * Draw the equivalent stress of von Mises of a solid, the largest of each element, deformed and magnified, with a circle around the
   * largest: all elements in two dimensions; in three a section, in the plane of the direction that moves most and the longest of the
   * others, where most of it is.
   *
   * Every rank calls it; the first one draws. @return what went wrong, "" if nothing.
   */
  template <int dim>
  std::string draw_stress(fem::Solid<dim>             &solid,
                          const fem::Vector           &displacement,
                          const fem::SolidExtremes    &extremes,
                          const std::filesystem::path &file,
                          const std::string           &title);
} // namespace apps
