#pragma once

#include <string>

namespace apps_tests
{
  /** A coarse notched beam of damage-plastic concrete, past its peak in about a second. */
  std::string concrete_beam_scene();

  /** A short elastic bar that hits a wall: explicit, in about a second. */
  std::string impact_scene();

  /**
   * A box in space, held at one end and pulled along x at the other.
   * @param box entries of Mesh/Box @param solid entries of Materials/solid @param displacement formula [m]
   */
  std::string pulled_box(const std::string &box, const std::string &solid, const std::string &displacement);

  /** A plane scene on the mesh "two.msh": held at its boundary "left", pulled at "right". */
  std::string two_squares_scene();

  /** Gmsh mesh of two squares, of the groups "stone" and "mortar". */
  std::string two_squares_mesh();
} // namespace apps_tests
