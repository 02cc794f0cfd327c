#pragma once

#include "base/state.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/hdf5/hdf5_output_driver.h"

#include <hdf5.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/** The part of HDF5 that Breccia uses: files of named arrays of doubles and integers, and texts. */
namespace postprocess::hdf5
{
  /** An HDF5 identifier with the function that closes it. */
  class Handle
  {
  public:
    using Close = herr_t (*)(hid_t);
    Handle(const hid_t id_, const Close close_)
      : id(id_)
      , close(close_)
    {
    }
    ~Handle() { release(); }
    Handle(Handle &&other) noexcept
      : id(other.id)
      , close(other.close)
    {
      other.id = H5I_INVALID_HID;
    }
    Handle &operator=(Handle &&other) noexcept
    {
      std::swap(id, other.id);
      std::swap(close, other.close);
      return *this;
    }

           operator hid_t() const { return id; }
    bool   valid() const { return id >= 0; }
    herr_t release(); ///< close now; negative if HDF5 could not

  private:
    hid_t id;
    Close close;
  };

  /** While it lives, HDF5 does not print its errors: they are turned into ours. */
  class QuietErrors
  {
  public:
    QuietErrors();
    ~QuietErrors();
    QuietErrors(const QuietErrors &)            = delete;
    QuietErrors &operator=(const QuietErrors &) = delete;

  private:
    H5E_auto2_t function = nullptr;
    void       *data     = nullptr;
  };

  using Shape = std::vector<hsize_t>; ///< empty: one number

  /**
   * A new file that replaces its destination when commit() is called, and otherwise leaves it as it was.
   *
   * Everything carries a checksum: arrays that of Fletcher, what else there is that of HDF5's own headers. Names may contain `/`: groups are made as needed. Every failure is an
   * OutputError.
   */
  class OutputFile
  {
  public:
    explicit OutputFile(const std::filesystem::path &path);
    ~OutputFile();

    void write(const std::string &name, const double *values, const Shape &shape);
    void write(const std::string &name, const std::int32_t *values, const Shape &shape);
    void write(const std::string &name, const std::int64_t *values, const Shape &shape);
    /**
     * A row of numbers that come one part after the other: the bytes are those of the row written at once.
     *
     * @param tell hands parts to what it is given, in order, `count` numbers in all; what that throws, it lets through
     * @throws std::logic_error for more or fewer numbers
     */
    void write_in_parts(const std::string &name, std::size_t count, const base::StateVisitor::Tell &tell);
    void write_text(const std::string &name, const std::string &text);
    void commit();

  private:
    struct Type
    {
      hid_t in_memory, in_file;
    };
    void   make_groups(const std::string &name); ///< that the name lies in
    Handle make_array(const std::string &name, hid_t type_in_file, const Shape &shape);
    void   write_array(const std::string &name, const Type &type, const void *values, const Shape &shape);
    void   check(bool succeeded, const std::string &what) const; ///< @throws OutputError unless all went well

    QuietErrors           quiet;
    std::filesystem::path path;
    AtomicFile            target;
    OutputDriver          driver;
    Handle                file;
  };

  /** An existing file. What is missing, of another type, or damaged, is a base::InputError that names file and item. */
  class InputFile
  {
  public:
    explicit InputFile(const std::filesystem::path &path);

    bool  has(const std::string &name) const; ///< is there an array or text of this name; a damaged one is not missing
    Shape shape(const std::string &name) const;
    std::string read_text(const std::string &name) const;

    /** Read into `values`, which has room for all of shape(name). */
    void read(const std::string &name, double *values) const;
    void read(const std::string &name, std::int32_t *values) const;
    void read(const std::string &name, std::int64_t *values) const;

    /** Numbers of a row, one part after the other. */
    void read_in_parts(const std::string &name, const base::StateVisitor::Take &take) const;

    /** The bytes of an array as they lie in the file, one part after the other. */
    void read_bytes(const std::string &name, const std::function<void(std::string_view)> &take) const;

    /** Full names of all arrays and texts below a group, sorted; none if there is no such group. */
    std::vector<std::string> names(const std::string &group = "/") const;

  private:
    bool   linked(const std::string &name) const; ///< does the file list such a name
    Handle open(const std::string &name) const;
    void   read_array(const std::string &name, hid_t type, const std::string &expected, void *values) const;
    /** Part by part what an array holds, as numbers of a type in memory. @param part of it, with their number */
    void read_parts(const std::string                                    &name,
                    hid_t                                                 array,
                    hid_t                                                 type,
                    const std::function<void(const char *, std::size_t)> &part) const;
    /** @throws base::InputError unless the numbers of an array fit into a type */
    void              check_type(const std::string &name, hid_t array, hid_t type, const std::string &expected) const;
    [[noreturn]] void damaged(const std::string &name) const;
    [[noreturn]] void fail(const std::string &what) const;

    QuietErrors           quiet;
    std::filesystem::path path;
    Handle                file;
  };

  /** Does the file begin as HDF5 files do? False also when it cannot be read. */
  bool is_hdf5(const std::filesystem::path &path);
} // namespace postprocess::hdf5
