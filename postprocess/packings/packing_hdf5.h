#pragma once

#include "postprocess/packings/packing_io.h"

#include <optional>
#include <utility>

namespace postprocess
{
  /** The HDF5 format of read_packing(); all but the checks of dem::check_packing(). @throws base::InputError. */
  std::pair<dem::Packing, Metadata> read_packing_hdf5(const std::filesystem::path &path);

  /** The unit of its lengths, where it says one. @throws base::InputError if that is no unit of length */
  std::optional<base::LengthUnit> unit_of_packing_hdf5(const std::filesystem::path &path);

  /** Metadata as for write_packing(). @throws OutputError. */
  void write_packing_hdf5(const dem::Packing &packing, const std::filesystem::path &path, const Metadata &metadata);
} // namespace postprocess
