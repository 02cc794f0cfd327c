#pragma once

#include "dem/specimen/results.h"

#include <filesystem>

namespace postprocess
{
  /**
   * Write the particles as points of a VTK XML file (.vtp), atomically.
   *
   * Fields: the kind "particles" of field_files(). Field data: TimeValue [s], which ParaView shows.
   *
   * @throws std::invalid_argument if the columns differ in length; OutputError.
   */
  void write_vtk_particles(const std::filesystem::path &path, const dem::ParticleOutput &particles, double time);
} // namespace postprocess
