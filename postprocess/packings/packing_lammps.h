#pragma once

#include "dem/model/packing.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace postprocess
{
  /** Files of LAMMPS that hold spheres. */
  enum class LammpsFile
  {
    data, ///< of read_data and write_data, atom style sphere
    dump  ///< of dump custom, text
  };

  /** Which of them a text is, by its beginning; nothing: neither. */
  std::optional<LammpsFile> lammps_file(std::string_view text);
  /** Which of them a file is by its name: .data and .lmp, .dump and .lammpstrj; nothing: neither. */
  std::optional<LammpsFile> lammps_name(const std::filesystem::path &path);

  /**
   * Spheres by their number (id), their types as materials "1", "2", ... where there are several; of a dump the last snapshot. Box edges are a
   * periodic cell where a dump (`pp`) or the first line of a data file (`boundary p p p`) says so, else none. Lengths as they stand.
   * @throws base::InputError naming file and line: another atom style, no radius, points without size, a triclinic box, a box that is periodic along
   * some edges alone, a section that is cut off
   */
  dem::Packing read_packing_lammps(LammpsFile what, const std::string &text, const std::string &origin);

  /** Numbers keep every bit; a free packing gets a box around it. Density 1, which a data file must have. @throws base::InputError for rigid bodies and infinite edges */
  std::string packing_as_lammps(LammpsFile what, const dem::Packing &packing);
} // namespace postprocess
