#include "postprocess/hdf5/hdf5_output_driver.h"

#include "postprocess/files/errors.h"
#include "postprocess/files/file_descriptor.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace postprocess::hdf5
{
  namespace
  {
    /** HDF5's view of the open file; its own part comes first. */
    struct OpenFile
    {
      H5FD_t        own_part;
      OutputDriver *driver;
      haddr_t       end_of_allocation, end_of_file;
    };

    OpenFile       *as_open(H5FD_t *const file) { return reinterpret_cast<OpenFile *>(file); }
    const OpenFile *as_open(const H5FD_t *const file) { return reinterpret_cast<const OpenFile *>(file); }

    constexpr herr_t  done            = 0;
    constexpr haddr_t largest_address = (haddr_t(1) << 62) - 1;

    H5FD_t *open(const char *, unsigned, const hid_t access_properties, haddr_t)
    {
      const void *const driver = H5Pget_driver_info(access_properties);
      return &(new OpenFile{{}, *static_cast<OutputDriver *const *>(driver), 0, 0})->own_part;
    }

    herr_t close(H5FD_t *const file)
    {
      delete as_open(file);
      return done;
    }

    int compare(const H5FD_t *const a, const H5FD_t *const b)
    {
      return as_open(a)->driver == as_open(b)->driver ? 0 : as_open(a)->driver < as_open(b)->driver ? -1 : 1;
    }

    herr_t query(const H5FD_t *, unsigned long *const features)
    {
      *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
                  H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
      return done;
    }

    haddr_t end_of_allocation(const H5FD_t *const file, H5FD_mem_t) { return as_open(file)->end_of_allocation; }

    herr_t set_end_of_allocation(H5FD_t *const file, H5FD_mem_t, const haddr_t address)
    {
      as_open(file)->end_of_allocation = address;
      return done;
    }

    haddr_t end_of_file(const H5FD_t *const file, H5FD_mem_t) { return as_open(file)->end_of_file; }

    herr_t read(H5FD_t *const file, H5FD_mem_t, hid_t, const haddr_t begin, const std::size_t bytes, void *const to)
    {
      as_open(file)->driver->read(begin, bytes, static_cast<char *>(to));
      return done;
    }

    herr_t
    write(H5FD_t *const file, H5FD_mem_t, hid_t, const haddr_t begin, const std::size_t bytes, const void *const from)
    {
      as_open(file)->driver->write(begin, bytes, static_cast<const char *>(from));
      as_open(file)->end_of_file = std::max(as_open(file)->end_of_file, begin + bytes);
      return done;
    }

    herr_t truncate(H5FD_t *const file, hid_t, hbool_t)
    {
      as_open(file)->end_of_file = as_open(file)->end_of_allocation;
      as_open(file)->driver->set_size(as_open(file)->end_of_file);
      return done;
    }

    /** The driver's number in HDF5, which keeps it to the end of the program. */
    hid_t registered_driver()
    {
      static const hid_t number = [] {
        H5FD_class_t table                           = {};
        table.name                                   = "breccia output";
        table.maxaddr                                = largest_address;
        table.fc_degree                              = H5F_CLOSE_WEAK;
        table.fapl_size                              = sizeof(OutputDriver *);
        table.open                                   = open;
        table.close                                  = close;
        table.cmp                                    = compare;
        table.query                                  = query;
        table.get_eoa                                = end_of_allocation;
        table.set_eoa                                = set_end_of_allocation;
        table.get_eof                                = end_of_file;
        table.read                                   = read;
        table.write                                  = write;
        table.truncate                               = truncate;
        constexpr H5FD_mem_t metadata_and_raw_data[] = H5FD_FLMAP_DICHOTOMY;
        std::copy(std::begin(metadata_and_raw_data), std::end(metadata_and_raw_data), table.fl_map);
        return H5FDregister(&table);
      }();
      return number;
    }
  } // namespace

  OutputDriver::OutputDriver(const std::filesystem::path &file_)
    : descriptor(::open(file_.c_str(), O_RDWR | O_CLOEXEC))
  {
    if (descriptor < 0)
      throw OutputError(file_.string() + ": cannot be opened for writing: " + system_reason() + ".");
  }

  OutputDriver::~OutputDriver() { ::close(descriptor); }

  void OutputDriver::use_in(const hid_t access_properties)
  {
    OutputDriver *const self = this;
    H5Pset_driver(access_properties, registered_driver(), &self);
  }

  void OutputDriver::abandon()
  {
    if (first_error == 0)
      first_error = ECANCELED;
  }

  void OutputDriver::write(haddr_t begin, std::size_t bytes, const char *from)
  {
    while (first_error == 0 && bytes > 0)
      {
        const ssize_t written = ::pwrite(descriptor, from, bytes, static_cast<off_t>(begin));
        if (written < 0)
          {
            first_error = errno == EINTR ? 0 : errno;
            continue;
          }
        begin += static_cast<haddr_t>(written);
        from += written;
        bytes -= static_cast<std::size_t>(written);
      }
  }

  void OutputDriver::read(haddr_t begin, std::size_t bytes, char *to)
  {
    std::fill(to, to + bytes, '\0'); // what was never written reads as zeros
    while (first_error == 0 && bytes > 0)
      {
        const ssize_t found = ::pread(descriptor, to, bytes, static_cast<off_t>(begin));
        if (found == 0)
          return;
        if (found < 0)
          {
            first_error = errno == EINTR ? 0 : errno;
            continue;
          }
        begin += static_cast<haddr_t>(found);
        to += found;
        bytes -= static_cast<std::size_t>(found);
      }
  }

  void OutputDriver::set_size(const haddr_t bytes)
  {
    if (first_error == 0 && ::ftruncate(descriptor, static_cast<off_t>(bytes)) != 0)
      first_error = errno;
  }
} // namespace postprocess::hdf5
