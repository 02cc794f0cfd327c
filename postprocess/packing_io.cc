#include "postprocess/packing_io.h"

#include "base/errors.h"
#include "postprocess/atomic_file.h"
#include "postprocess/hdf5_file.h"
#include "postprocess/packing_hdf5.h"
#include "postprocess/packing_text.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace postprocess
{
  namespace
  {
    bool is_named_hdf5(const std::filesystem::path &path)
    {
      return path.extension() == ".h5" || path.extension() == ".hdf5";
    }

    std::pair<dem::Packing, Metadata> read(const std::filesystem::path &path)
    {
      if (!std::filesystem::exists(path))
        throw base::InputError(path.string() + ": no such file. Give a packing: HDF5 (.h5) or text (x y z radius).");
      return hdf5::is_hdf5(path) || is_named_hdf5(path) ? read_packing_hdf5(path) : read_packing_text(path);
    }

    void check_metadata(const Metadata &metadata)
    {
      const auto allowed = [](const unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == ' '; };
      for (const auto &[key, value] : metadata)
        if (key.empty() || key == "periodic_cell" || key == "materials" ||
            !std::all_of(key.begin(), key.end(), allowed) || value.find_first_of("\r\n") != std::string::npos)
          throw std::invalid_argument("write_packing: metadata \"" + key +
                                      "\": a key is made of letters, digits, blanks, _ " +
                                      "and -, it is not periodic_cell or materials, and its value has no line break");
    }
  } // namespace

  dem::Packing read_packing(const std::filesystem::path &path)
  {
    dem::Packing packing = read(path).first;
    dem::check_packing(packing, path.string());
    return packing;
  }

  Metadata read_packing_metadata(const std::filesystem::path &path) { return read(path).second; }

  void write_packing(const dem::Packing &packing, const std::filesystem::path &path, const Metadata &metadata)
  {
    check_metadata(metadata);
    if (is_named_hdf5(path))
      write_packing_hdf5(packing, path, metadata);
    else
      write_text(path, packing_as_text(packing, metadata, path.extension() == ".csv" ? ',' : ' '));
  }
} // namespace postprocess
