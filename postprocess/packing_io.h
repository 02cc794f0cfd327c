#pragma once

#include "dem/model/packing.h"

#include <filesystem>
#include <map>
#include <string>

namespace postprocess
{
  /** Free text that travels with a packing: generator, seed, packing fraction, version, ... */
  using Metadata = std::map<std::string, std::string>;

  /**
   * Read a packing, HDF5 or text (told apart by content), and check it: see dem::check_packing().
   *
   * Text: one particle a line, `x y z radius` [m], separated by blanks, tabs or commas. Lines that start with `#` are
   * comments; `# periodic_cell LX LY LZ` gives the edges of a periodic cell. A line of column names (as such or as a
   * comment) may come before the first particle: then x, y, z and radius (or r) may stand in any order, among other
   * columns, which are ignored. A name may carry the unit `[m]`. A named column `material` holds a word per particle, what its
   * material is called; `# materials NAME NAME ...` before the first particle says which there are, and in what order.
   * A named column `clump` holds the number of the rigid body that each is a pebble of, -1: of none; the bodies are, from 0, the lines
   * `# body VOLUME X Y Z IXX IYY IZZ IYZ IXZ IXY` before the first particle: volume [m^3] (of discs area [m^2]), centre [m], inertia
   * over mass [m^2].
   *
   * HDF5: datasets `centre` (N x 3) and `radius` (N) [m], and `periodic_cell` (3) when periodic. With several materials
   * `material` (N, whole numbers from 0) and, unless they have no names, the text `material_names`, between blanks. With
   * rigid bodies `clump` (N, whole numbers, -1: of none) and `bodies` (M x 13: volume, centre, inertia over mass by rows).
   *
   * @throws base::InputError naming file and line (or dataset): missing file, wrong number of columns, not a number, NaN
   * or infinity, radius <= 0, no particle, coincident particles, a material that has no name or may not be called so, a body that is none, missing or
   * misshapen dataset, truncated file.
   */
  dem::Packing read_packing(const std::filesystem::path &path);

  /** The free text stored with a packing; in text files, the lines `# KEY: VALUE`. @throws as read_packing(). */
  Metadata read_packing_metadata(const std::filesystem::path &path);

  /**
   * Write a packing atomically: HDF5 when the name ends in .h5 or .hdf5, otherwise text (commas for .csv).
   *
   * Reading it back gives the same bits, in both formats (in text, materials without names get their numbers as names).
   *
   * @throws OutputError; std::invalid_argument if a key of the metadata is not made of letters, digits, blanks, _ and
   * -, or a value holds a line break.
   */
  void write_packing(const dem::Packing &packing, const std::filesystem::path &path, const Metadata &metadata = {});
} // namespace postprocess
