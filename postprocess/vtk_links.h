#pragma once

#include "dem/specimen.h"

#include <filesystem>

namespace postprocess
{
  /**
   * Write the links as lines between the present particle positions, in a VTK XML file (.vtp), atomically.
   *
   * Cell data: normal_force, shear_force [N], normal_stress, shear_stress [Pa], normal_strain, damage [-], kind (0
   * cohesive, 1 contact, 2 broken), broken (0 or 1) and, where there are several materials, material_pair: the number of the pair
   * that the link joins (0-0: 0, 1-0: 1, 1-1: 2, 2-0: 3, ...). The points are all particles in the packing's order (id, radius
   * [m] and displacement [m] as point data), also when there is no link at all.
   *
   * @throws std::invalid_argument if columns differ in length or a link ends at no particle; OutputError.
   */
  void write_vtk_links(const std::filesystem::path &path,
                       const dem::LinkOutput       &links,
                       const dem::ParticleOutput   &particles,
                       double                       time);
} // namespace postprocess
