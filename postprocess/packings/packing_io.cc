#include "postprocess/packings/packing_io.h"

#include "base/errors.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/numeric_text.h"
#include "postprocess/files/stated_unit.h"
#include "postprocess/hdf5/hdf5_file.h"
#include "postprocess/packings/packing_hdf5.h"
#include "postprocess/packings/packing_lammps.h"
#include "postprocess/packings/packing_text.h"
#include "postprocess/packings/packing_yade.h"

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

    void convert_to_metres(dem::Packing &packing, const base::LengthUnit &unit, const std::string &origin)
    {
      if (!packing.bodies.empty() && unit != base::LengthUnit())
        throw base::InputError(origin +
                               ": has rigid bodies, whose volume and inertia are in metres. Write all of it in m.");
      for (Eigen::Vector3d &centre : packing.centre)
        centre /= unit.in_a_metre;
      for (double &radius : packing.radius)
        radius = unit.metres(radius);
      if (packing.periodic_cell)
        *packing.periodic_cell /= unit.in_a_metre;
    }

    /** The first line of a data file is free, and may say the unit. */
    std::optional<base::LengthUnit> unit_in_title(const std::string &text, const std::string &origin)
    {
      StatedUnit title(origin);
      if (lammps_file(text) == LammpsFile::data)
        title.read(std::string_view(text).substr(0, text.find('\n')), 1, false);
      return title.unit();
    }

    dem::Packing read_lammps(const LammpsFile                       what,
                             const std::string                     &text,
                             const std::string                     &origin,
                             const std::optional<base::LengthUnit> &unit)
    {
      const auto said = unit_in_title(text, origin);
      if (unit && said && *unit != *said)
        throw base::InputError(origin + ": says that lengths are in " + said->symbol +
                               ", and Length unit that they are in " + unit->symbol +
                               ". Leave it out, or correct the file.");
      dem::Packing packing = read_packing_lammps(what, text, origin);
      convert_to_metres(packing, said ? *said : unit.value_or(base::LengthUnit()), origin);
      return packing;
    }

    std::pair<dem::Packing, Metadata> read(const std::filesystem::path           &path,
                                           const std::optional<base::LengthUnit> &unit)
    {
      if (!std::filesystem::exists(path))
        throw base::InputError(path.string() + ": no such file. Give a packing: HDF5 (.h5) or text (x y z radius).");
      if (!hdf5::is_hdf5(path) && !is_named_hdf5(path))
        {
          const std::string text = numeric_text::read_text(path);
          if (const auto foreign = lammps_file(text))
            return {read_lammps(*foreign, text, path.string(), unit), {}};
          return read_packing_text(path, unit);
        }
      auto       found = read_packing_hdf5(path);
      const auto said  = unit_of_packing_hdf5(path);
      if (unit && said && *unit != *said)
        throw base::InputError(path.string() + ": says that lengths are in " + said->symbol +
                               ", and Length unit that they are in " + unit->symbol +
                               ". Leave it out, or correct the file.");
      convert_to_metres(found.first, said ? *said : unit.value_or(base::LengthUnit()), path.string());
      return found;
    }

    void check_metadata(const Metadata &metadata)
    {
      for (const auto &[key, value] : metadata)
        if (!is_metadata_key(key) || value.find_first_of("\r\n") != std::string::npos)
          throw std::invalid_argument("write_packing: metadata \"" + key +
                                      "\": a key is made of letters, digits, blanks, _ " +
                                      "and -, it is not periodic_cell or materials, and its value has no line break");
    }
  } // namespace

  bool is_metadata_key(const std::string &key)
  {
    const auto allowed = [](const unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == ' '; };
    return !key.empty() && key != "periodic_cell" && key != "materials" && std::all_of(key.begin(), key.end(), allowed);
  }

  dem::Packing read_packing(const std::filesystem::path &path, const std::optional<base::LengthUnit> &unit)
  {
    dem::Packing packing = read(path, unit).first;
    dem::check_packing(packing, path.string());
    return packing;
  }

  bool says_length_unit(const std::filesystem::path &path)
  {
    if (hdf5::is_hdf5(path))
      return unit_of_packing_hdf5(path).has_value();
    const std::string text = numeric_text::read_text(path);
    return lammps_file(text) ? unit_in_title(text, path.string()).has_value() : packing_text_says_unit(path);
  }

  Metadata read_packing_metadata(const std::filesystem::path &path, const std::optional<base::LengthUnit> &unit)
  {
    return read(path, unit).second;
  }

  void write_packing(const dem::Packing &packing, const std::filesystem::path &path, const Metadata &metadata)
  {
    check_metadata(metadata);
    if (is_named_hdf5(path))
      write_packing_hdf5(packing, path, metadata);
    else if (const auto foreign = lammps_name(path))
      write_text(path, packing_as_lammps(*foreign, packing));
    else if (is_named_yade(path))
      write_text(path, packing_as_yade(packing, metadata));
    else
      write_text(path, packing_as_text(packing, metadata, path.extension() == ".csv" ? ',' : ' '));
  }
} // namespace postprocess
