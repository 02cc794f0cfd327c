#pragma once

#include "base/length_unit.h"
#include "dem/model/packing.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace postprocess
{
  /** Free text that travels with a packing: generator, seed, packing fraction, version, ... */
  using Metadata = std::map<std::string, std::string>;

  /**
   * Read a packing, HDF5 or text (distinguished by content), and check it: see dem::check_packing().
   *
   * Text: one particle a line, `x y z radius` [m], separated by blanks, tabs or commas. Lines that start with `#` are
   * comments; `# periodic_cell LX LY LZ` gives the edges of a periodic cell. A line of column names (as such or as a
   * comment) may come before the first particle: then x, y, z and radius (r) or diameter (d) may stand in any order, among other
   * columns, which are ignored. Names may carry a unit, `x [mm]`, `x(mm)`, `x_mm`, and a comment may name one for all lengths of the
   * file, `# lengths in mm`: see packing_header.h and stated_unit.h. A named column `material` holds a word per particle, what its
   * material is called; `# materials NAME NAME ...` before the first particle says which there are, and in what order.
   * A named column `clump` holds the number of the rigid body that each is a pebble of, -1: of none; the bodies are, from 0, the lines
   * `# body VOLUME X Y Z IXX IYY IZZ IYZ IXZ IXY` before the first particle: volume [m^3] (of discs area [m^2]), centre [m], inertia
   * over mass [m^2].
   *
   * HDF5: datasets `centre` (N x 3) and `radius` (N) [m], and `periodic_cell` (3) when periodic. With several materials
   * `material` (N, whole numbers from 0) and, unless they have no names, the text `material_names`, between blanks. With
   * rigid bodies `clump` (N, whole numbers, -1: of none) and `bodies` (M x 13: volume, centre, inertia over mass by rows).
   *
   * Files of LAMMPS, data of atom style sphere and dumps of text, are recognised too: see packing_lammps.h.
   *
   * @param unit of the file's lengths; empty: as it says itself, or else metres. One that contradicts the file is refused.
   * @throws base::InputError naming file and line (or dataset): missing file, wrong number of columns, not a number, NaN
   * or infinity, radius <= 0, no particle, coincident particles, a material that has no name or may not be called so, a body that is none, missing or
   * misshapen dataset, truncated file.
   */
  dem::Packing read_packing(const std::filesystem::path &path, const std::optional<base::LengthUnit> &unit = {});

  /** The free text stored with a packing; in text files, the lines `# KEY: VALUE` that write_packing() takes. @throws as read_packing(). */
  Metadata read_packing_metadata(const std::filesystem::path &path, const std::optional<base::LengthUnit> &unit = {});

  /** Whether the file itself says in what unit its lengths are: columns, comments, or the dataset `units`. @throws as read_packing() */
  bool says_length_unit(const std::filesystem::path &path);

  /** Whether metadata may be called so: letters, digits, blanks, _ and -, and no line that has a meaning of its own. */
  bool is_metadata_key(const std::string &key);

  /**
   * Write a packing atomically: HDF5 when the name ends in .h5 or .hdf5, data of LAMMPS in .data and .lmp and a dump
   * in .dump and .lammpstrj, text of YADE in .yade, otherwise text (commas for .csv).
   *
   * Reading it back gives the same bits (in text, materials without names get their numbers as names). LAMMPS numbers types from 1 and knows neither
   * their names nor metadata.
   *
   * @throws OutputError; std::invalid_argument if a key of the metadata is not made of letters, digits, blanks, _ and
   * -, or a value holds a line break.
   */
  void write_packing(const dem::Packing &packing, const std::filesystem::path &path, const Metadata &metadata = {});
} // namespace postprocess
