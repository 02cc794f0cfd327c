#include "postprocess/hdf5/hdf5_file.h"

#include "base/errors.h"
#include "postprocess/files/errors.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace postprocess::hdf5
{
  namespace
  {
    /** HDF5 (1.10) keeps what it could not read of a damaged file, and would complain of it in its own words when the program ends. */
    [[maybe_unused]] const herr_t no_last_words = H5dont_atexit();

    /** What HDF5 noted first, where it went wrong. */
    std::string reason()
    {
      std::string       text           = "unknown error of HDF5";
      const H5E_walk2_t keep_innermost = [](const unsigned level, const H5E_error2_t *const error, void *const result) {
        if (level == 0 && error->desc != nullptr)
          *static_cast<std::string *>(result) = error->desc;
        return herr_t(0);
      };
      H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &text);

      return text;
    }

    /**
     * Checksums in all that says where numbers lie: the file format of HDF5 1.10, for the lists of chunks of older ones have none.
     * Where the file system knows no locks, do without: a file is written under a name of its own and never changed afterwards.
     */
    Handle access_properties()
    {
      Handle properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      H5Pset_libver_bounds(properties, H5F_LIBVER_V110, H5F_LIBVER_LATEST);
      H5Pset_file_locking(properties, true, true);
      return properties;
    }

    constexpr hsize_t chunk_values = hsize_t(1) << 17;

    /**
     * Chunks of about 1 MiB, which checksums need; one number or text lies in the header of its array, which has one too. No time
     * stamps, so that equal contents make equal files.
     */
    Handle array_properties(const Shape &shape, const std::size_t value_bytes)
    {
      constexpr std::size_t header_holds = 60000; // bytes; HDF5 sets a limit of 64 KiB for all of it

      Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      H5Pset_obj_track_times(properties, false);
      if (shape.empty() && value_bytes <= header_holds)
        H5Pset_layout(properties, H5D_COMPACT);
      if (shape.empty() || *std::min_element(shape.begin(), shape.end()) == 0)
        return properties;
      Shape   chunk = shape;
      hsize_t row   = 1;
      for (std::size_t d = 1; d < shape.size(); ++d)
        row *= shape[d];
      chunk[0] = std::min(shape[0], std::max<hsize_t>(1, chunk_values / row));
      H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
      H5Pset_fletcher32(properties);
      return properties;
    }

    Handle make_space(const Shape &shape)
    {
      if (shape.empty())
        return {H5Screate(H5S_SCALAR), H5Sclose};
      return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose};
    }
  } // namespace

  herr_t Handle::release()
  {
    const hid_t closing = id;
    id                  = H5I_INVALID_HID;
    return closing >= 0 ? close(closing) : 0;
  }

  QuietErrors::QuietErrors()
  {
    H5Eget_auto2(H5E_DEFAULT, &function, &data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }

  QuietErrors::~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, function, data); }

  OutputFile::OutputFile(const std::filesystem::path &path_)
    : path(path_)
    , target(path_)
    , driver(target.partial())
    , file(H5I_INVALID_HID, H5Fclose)
  {
    const Handle access = access_properties();
    driver.use_in(access);
    const Handle properties(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties, false); // of the root
    file = Handle(H5Fcreate(target.partial().c_str(), H5F_ACC_TRUNC, properties, access), H5Fclose);
    check(file.valid(), "the file");
  }

  OutputFile::~OutputFile()
  {
    driver.abandon();
    file.release();
  }

  void OutputFile::check(const bool succeeded, const std::string &what) const
  {
    if (driver.error() != 0)
      throw OutputError(path.string() + ": cannot be written: " + std::generic_category().message(driver.error()) +
                        ".");
    if (!succeeded)
      throw OutputError(path.string() + ": " + what + " cannot be written: " + reason() + ".");
  }

  void OutputFile::make_groups(const std::string &name)
  {
    const Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties, false);
    for (std::size_t end = name.find('/'); end != std::string::npos; end = name.find('/', end + 1))
      {
        const std::string group = name.substr(0, end);
        if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0)
          continue;
        const Handle made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose);
        check(made.valid(), "\"" + group + "\"");
      }
  }

  Handle OutputFile::make_array(const std::string &name, const hid_t type_in_file, const Shape &shape)
  {
    const Handle space = make_space(shape), properties = array_properties(shape, H5Tget_size(type_in_file));
    make_groups(name);
    Handle array(H5Dcreate2(file, name.c_str(), type_in_file, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
    check(array.valid(), "\"" + name + "\"");
    return array;
  }

  void OutputFile::write_array(const std::string &name, const Type &type, const void *const values, const Shape &shape)
  {
    const Handle array = make_array(name, type.in_file, shape);
    check(H5Dwrite(array, type.in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0, "\"" + name + "\"");
  }

  void
  OutputFile::write_in_parts(const std::string &name, const std::size_t count, const base::StateVisitor::Tell &tell)
  {
    const Handle        array = make_array(name, H5T_IEEE_F64LE, {count}), row = make_space({count});
    std::vector<double> waiting; // for the chunk to be whole: one that is written twice has its checksum made twice
    std::size_t         written = 0;
    const auto          write   = [&] {
      const hsize_t begin = written, length = waiting.size();
      const Handle  part = make_space({length});
      check(H5Sselect_hyperslab(row, H5S_SELECT_SET, &begin, nullptr, &length, nullptr) >= 0 &&
                         H5Dwrite(array, H5T_NATIVE_DOUBLE, part, row, H5P_DEFAULT, waiting.data()) >= 0,
                       "\"" + name + "\"");
      written += waiting.size();
      waiting.clear();
    };
    tell([&](const double *numbers, std::size_t more) {
      if (written + waiting.size() + more > count)
        throw std::logic_error("hdf5: \"" + name + "\" has more numbers than were said");
      while (more > 0)
        {
          const std::size_t taken = std::min<std::size_t>(more, chunk_values - waiting.size());
          waiting.insert(waiting.end(), numbers, numbers + taken);
          numbers += taken;
          more -= taken;
          if (waiting.size() == chunk_values)
            write();
        }
    });
    if (!waiting.empty())
      write();
    if (written != count)
      throw std::logic_error("hdf5: \"" + name + "\" has fewer numbers than were said");
  }

  void OutputFile::write(const std::string &name, const double *const values, const Shape &shape)
  {
    write_array(name, {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE}, values, shape);
  }

  void OutputFile::write(const std::string &name, const std::int32_t *const values, const Shape &shape)
  {
    write_array(name, {H5T_NATIVE_INT32, H5T_STD_I32LE}, values, shape);
  }

  void OutputFile::write(const std::string &name, const std::int64_t *const values, const Shape &shape)
  {
    write_array(name, {H5T_NATIVE_INT64, H5T_STD_I64LE}, values, shape);
  }

  void OutputFile::write_text(const std::string &name, const std::string &text)
  {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, std::max<std::size_t>(text.size(), 1)); // HDF5 has no text of length 0: one zero byte
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, H5T_CSET_UTF8);
    write_array(name, {type, type}, text.c_str(), {});
  }

  void OutputFile::commit()
  {
    check(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0 && file.release() >= 0, "the file");
    target.commit();
  }

  namespace
  {
    void check_exists(const std::filesystem::path &path)
    {
      if (!std::filesystem::exists(path))
        throw base::InputError(path.string() + ": no such file.");
      if (!is_hdf5(path))
        throw base::InputError(path.string() + ": is not an HDF5 file.");
    }
  } // namespace

  InputFile::InputFile(const std::filesystem::path &path_)
    : path(path_)
    , file(H5I_INVALID_HID, H5Fclose)
  {
    check_exists(path);
    const Handle access = access_properties();
    file                = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
    if (!file.valid())
      fail("cannot be opened, it is damaged or was cut short");
  }

  void InputFile::fail(const std::string &what) const
  {
    throw base::InputError(path.string() + ": " + what + ": " + reason() + ".");
  }

  void InputFile::damaged(const std::string &name) const { fail("\"" + name + "\" is damaged"); }

  bool InputFile::linked(const std::string &name) const
  {
    for (std::size_t end = name.find('/');; end = name.find('/', end + 1))
      {
        const htri_t found = H5Lexists(file, name.substr(0, end).c_str(), H5P_DEFAULT);
        if (found < 0)
          damaged(name);
        if (found == 0 || end == std::string::npos)
          return found > 0;
      }
  }

  bool InputFile::has(const std::string &name) const { return linked(name) && open(name).valid(); }

  Handle InputFile::open(const std::string &name) const
  {
    if (!linked(name))
      throw base::InputError(path.string() + ": \"" + name + "\" is missing.");
    Handle array(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!array.valid())
      damaged(name);
    return array;
  }

  Shape InputFile::shape(const std::string &name) const
  {
    const Handle array = open(name);
    const Handle space(H5Dget_space(array), H5Sclose);
    Shape        result(std::max(0, H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, result.data(), nullptr);
    return result;
  }

  void
  InputFile::check_type(const std::string &name, const hid_t array, const hid_t type, const std::string &expected) const
  {
    const Handle stored(H5Dget_type(array), H5Tclose);
    if (H5Tget_class(stored) != H5Tget_class(type) || H5Tget_size(stored) > H5Tget_size(type))
      throw base::InputError(path.string() + ": \"" + name + "\" is of another type: " + expected + " expected.");
  }

  void InputFile::read_array(const std::string &name,
                             const hid_t        type,
                             const std::string &expected,
                             void *const        values) const
  {
    const Handle array = open(name);
    check_type(name, array, type, expected);
    if (H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
      damaged(name);
  }

  void InputFile::read_parts(const std::string                                    &name,
                             const hid_t                                           array,
                             const hid_t                                           type,
                             const std::function<void(const char *, std::size_t)> &part) const
  {
    const Handle      space(H5Dget_space(array), H5Sclose);
    const hsize_t     all = static_cast<hsize_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space)));
    std::vector<char> numbers;
    const bool        row = H5Sget_simple_extent_ndims(space) == 1;
    for (hsize_t begin = 0; begin < all;)
      {
        const hsize_t length = row ? std::min(all - begin, chunk_values) : all;
        numbers.resize(H5Tget_size(type) * length);
        const Handle here = make_space({length});
        if ((row && H5Sselect_hyperslab(space, H5S_SELECT_SET, &begin, nullptr, &length, nullptr) < 0) ||
            H5Dread(array, type, here, space, H5P_DEFAULT, numbers.data()) < 0)
          damaged(name);
        part(numbers.data(), length);
        begin += length;
      }
  }

  void InputFile::read_in_parts(const std::string &name, const base::StateVisitor::Take &take) const
  {
    const Handle array = open(name);
    check_type(name, array, H5T_NATIVE_DOUBLE, "real numbers");
    read_parts(name, array, H5T_NATIVE_DOUBLE, [&](const char *const numbers, const std::size_t count) {
      take(reinterpret_cast<const double *>(numbers), count);
    });
  }

  void InputFile::read(const std::string &name, double *const values) const
  {
    read_array(name, H5T_NATIVE_DOUBLE, "real numbers", values);
  }

  void InputFile::read(const std::string &name, std::int32_t *const values) const
  {
    read_array(name, H5T_NATIVE_INT32, "whole numbers of 32 bits", values);
  }

  void InputFile::read(const std::string &name, std::int64_t *const values) const
  {
    read_array(name, H5T_NATIVE_INT64, "whole numbers", values);
  }

  void InputFile::read_bytes(const std::string &name, const std::function<void(std::string_view)> &take) const
  {
    const Handle array = open(name);
    const Handle type(H5Dget_type(array), H5Tclose);
    if (H5Tget_class(type) != H5T_INTEGER && H5Tget_class(type) != H5T_FLOAT)
      throw base::InputError(path.string() + ": \"" + name + "\" is of another type: numbers expected.");
    read_parts(name, array, type, [&](const char *const numbers, const std::size_t count) {
      take({numbers, count * H5Tget_size(type)});
    });
  }

  std::string InputFile::read_text(const std::string &name) const
  {
    const Handle array = open(name);
    const Handle type(H5Dget_type(array), H5Tclose);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || !shape(name).empty())
      throw base::InputError(path.string() + ": \"" + name +
                             "\" is of another type: one text of fixed length expected.");
    std::string text(H5Tget_size(type), '\0');
    if (H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
      damaged(name);
    text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
    return text;
  }

  std::vector<std::string> InputFile::names(const std::string &group) const
  {
    struct Search
    {
      std::string              prefix;
      std::vector<std::string> found;
    } search{group == "/" ? "" : group + "/", {}};

    if (group != "/" && !linked(group))
      return {};
    const Handle start(H5Gopen2(file, group.c_str(), H5P_DEFAULT), H5Gclose);
    if (!start.valid())
      damaged(group);
    const H5L_iterate_t add = [](const hid_t from, const char *const name, const H5L_info_t *, void *const data) {
      auto        &result = *static_cast<Search *>(data);
      const Handle object(H5Oopen(from, name, H5P_DEFAULT), H5Oclose);
      if (!object.valid())
        return herr_t(-1);
      if (H5Iget_type(object) == H5I_DATASET)
        result.found.push_back(result.prefix + name);
      return herr_t(0);
    };
    if (H5Lvisit(start, H5_INDEX_NAME, H5_ITER_INC, add, &search) < 0)
      fail("the list of contents is damaged");
    std::sort(search.found.begin(), search.found.end());
    return search.found;
  }

  bool is_hdf5(const std::filesystem::path &path)
  {
    constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
    char                       begin[signature.size()];
    std::ifstream              file(path, std::ios::binary);
    return file.read(begin, sizeof(begin)) && std::string_view(begin, sizeof(begin)) == signature;
  }
} // namespace postprocess::hdf5
