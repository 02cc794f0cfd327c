#pragma once

#include <filesystem>

namespace dem
{
  class ObservedSpecimen;
}

namespace postprocess
{
  /**
   * Write the surfaces of a specimen as facets of a VTK file (.vtp) for ParaView, with the fields "walls" of field_files(). Unbounded
   * planes are left out. @throws OutputError.
   */
  void write_vtk_walls(const std::filesystem::path &path, const dem::ObservedSpecimen &specimen, double time);
} // namespace postprocess
