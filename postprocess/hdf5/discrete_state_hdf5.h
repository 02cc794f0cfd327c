#pragma once

#include "dem/observation/state_columns.h"
#include "postprocess/hdf5/hdf5_file.h"

#include <filesystem>
#include <vector>

namespace postprocess
{
  /** A file that is written column by column, as write_discrete_state() writes a whole state. */
  class DiscreteStateFile
  {
  public:
    /** @param time [s] @throws OutputError, as all that follows */
    DiscreteStateFile(const std::filesystem::path &path, int dimension, double time);

    void write(dem::StateColumn column, const std::vector<double> &numbers);
    /** After all columns: an existing file is replaced only now. */
    void commit() { file.commit(); }

  private:
    hdf5::OutputFile file;
  };

  /**
   * Write a discrete state as HDF5 (format 1): `dimension`, `time`, `particles/{reference, position, radius, volume, stress, held}`
   * (stress: N x 6 in the order xx yy zz yz zx xy), `links/{ends, direction, strength_damage, contact}`.
   * @throws OutputError; an existing file is replaced only when everything is written.
   */
  void write_discrete_state(const dem::DiscreteState &state, const std::filesystem::path &path);

  /** Read it back and check it. @throws base::InputError naming file and item. */
  dem::DiscreteState read_discrete_state(const std::filesystem::path &path);
} // namespace postprocess
