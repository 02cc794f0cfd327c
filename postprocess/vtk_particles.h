#pragma once

#include "dem/specimen.h"

#include <filesystem>

namespace postprocess
{
  /**
   * Write the particles as points of a VTK XML file (.vtp), atomically.
   *
   * Point data: id (number in the packing, from 0), radius [m], displacement [m], velocity [m/s], angular_velocity
   * [rad/s], damage [-], broken_links, stress [Pa] (symmetric tensor XX YY ZZ XY YZ XZ, tension positive), phase (number
   * of the material, 0 where there is one) and, where there are several, the same as material. Field data: TimeValue [s], which ParaView shows.
   *
   * @throws std::invalid_argument if the columns differ in length; OutputError.
   */
  void write_vtk_particles(const std::filesystem::path &path, const dem::ParticleOutput &particles, double time);
} // namespace postprocess
