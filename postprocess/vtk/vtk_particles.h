#pragma once

#include "dem/specimen/rank_output.h"

#include <filesystem>
#include <string>
#include <vector>

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

  /** The same of those that one of several ranks has: a piece. */
  void write_vtk_particles(const std::filesystem::path &path, const dem::RankOutput &shown, double time);

  /**
   * Write the record (.pvtp) of the pieces, atomically.
   * @param like what one of the ranks shows, for the names of the fields  @param pieces files, relative to the record  @throws OutputError
   */
  void write_vtk_particles_record(const std::filesystem::path    &path,
                                  const dem::RankOutput          &like,
                                  const std::vector<std::string> &pieces);
} // namespace postprocess
