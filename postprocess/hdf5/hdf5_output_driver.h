#pragma once

#include <hdf5.h>

#include <filesystem>

namespace postprocess::hdf5
{
  /**
   * How HDF5 writes a new file, so that a full disk is survived.
   *
   * HDF5 (1.10) cannot close a file whose blocks it could not write: the file stays open inside the library, which then
   * crashes when the program ends. This driver never fails towards HDF5: it keeps the system's first error for us,
   * writes nothing from then on, and lets HDF5 close in peace. What stands in the file is then worthless.
   */
  class OutputDriver
  {
  public:
    /** @param file_ a file that exists and is empty. @throws OutputError. */
    explicit OutputDriver(const std::filesystem::path &file_);
    ~OutputDriver();
    OutputDriver(const OutputDriver &)            = delete;
    OutputDriver &operator=(const OutputDriver &) = delete;

    /** Let files be created with these access properties through this driver, which must outlive them. */
    void use_in(hid_t access_properties);

    int  error() const { return first_error; } ///< errno of the first failure; 0 while all is well
    void abandon();                            ///< write nothing from now on

    // What HDF5 calls, by way of the table in the source.
    void write(haddr_t begin, std::size_t bytes, const char *from);
    void read(haddr_t begin, std::size_t bytes, char *to);
    void set_size(haddr_t bytes);

  private:
    int descriptor, first_error = 0;
  };
} // namespace postprocess::hdf5
