#pragma once

#include "fem/output/solid_snapshot.h"

#include <filesystem>
#include <string>
#include <vector>

namespace postprocess
{
  /**
   * Write a solid as a VTK XML file (.vtu), atomically; single precision.
   *
   * Fields: the kind "solid" of field_files(), with units; a history that only its material knows keeps its own name and unit.
   * @throws OutputError; std::invalid_argument if columns differ in length
   */
  void write_vtk_solid(const std::filesystem::path &path, const fem::SolidSnapshot &solid, double time);

  /**
   * Write the record (.pvtu) of a solid whose parts stand in several files.
   * @param like one of the parts, for the names of the fields  @param pieces files of the parts, relative to the record
   * @throws OutputError
   */
  void write_vtk_solid_record(const std::filesystem::path    &path,
                              const fem::SolidSnapshot       &like,
                              const std::vector<std::string> &pieces);
} // namespace postprocess
