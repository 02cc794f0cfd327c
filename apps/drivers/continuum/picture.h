#pragma once

#include "fem/solid/solid.h"

#include <filesystem>
#include <string>

namespace apps
{
  /**
   * Draw the damage of a solid, deformed and magnified: all elements in two dimensions; in three a section, in the plane of the
   * direction that moves most and the longest of the others, where most is damaged.
   *
   * Every rank calls it; the first one draws. Nothing is drawn where no material can be damaged.
   * @return what went wrong, "" if nothing.
   */
  template <int dim>
  std::string draw_damage(fem::Solid<dim>             &solid,
                          const fem::Vector           &displacement,
                          const std::filesystem::path &file,
                          const std::string           &title);
} // namespace apps
