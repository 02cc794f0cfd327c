#pragma once

#include "dem/specimen/results.h"

#include <filesystem>

namespace dem
{
  class ObservedSpecimen;
}

namespace apps
{
  /**
   * Write the discrete state of a specimen (postprocess/hdf5/discrete_state_hdf5.h), which the first rank does column by column. All ranks call this.
   * @throws postprocess::OutputError on all of them
   */
  void write_state(const dem::ObservedSpecimen &specimen, const std::filesystem::path &file);
} // namespace apps
