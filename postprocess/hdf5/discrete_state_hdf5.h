#pragma once

#include "dem/observation/discrete_state.h"

#include <filesystem>

namespace postprocess
{
  /**
   * Write a discrete state as HDF5 (format 1): `dimension`, `time`, `particles/{reference, position, radius, volume, stress, held}`
   * (stress: N x 6 in the order xx yy zz yz zx xy), `links/{ends, direction, strength_damage, contact}`.
   * @throws OutputError; an existing file is replaced only when everything is written.
   */
  void write_discrete_state(const dem::DiscreteState &state, const std::filesystem::path &path);

  /** Read it back and check it. @throws base::InputError naming file and item. */
  dem::DiscreteState read_discrete_state(const std::filesystem::path &path);
} // namespace postprocess
