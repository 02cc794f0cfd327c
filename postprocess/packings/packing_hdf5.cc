#include "postprocess/packings/packing_hdf5.h"

#include "base/errors.h"
#include "postprocess/hdf5/hdf5_file.h"

#include <sstream>
#include <vector>

namespace postprocess
{
  namespace
  {
    static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double), "centres are stored row by row without gaps");

    constexpr std::int64_t packing_version = 1;
    constexpr hsize_t      body_record     = 13; // volume, centre, inertia by rows

    std::string as_text(const hdf5::Shape &shape)
    {
      std::string text;
      for (const hsize_t n : shape)
        text += (text.empty() ? "" : " x ") + std::to_string(n);
      return text.empty() ? "one number" : text;
    }

    void check_shapes(const hdf5::InputFile &file, const std::string &origin)
    {
      const hdf5::Shape centre = file.shape("centre"), radius = file.shape("radius");
      if (centre.size() != 2 || centre[1] != 3)
        throw base::InputError(origin + ": \"centre\" has the shape " + as_text(centre) + ", expected N x 3.");
      if (radius.size() != 1 || radius[0] != centre[0])
        throw base::InputError(origin + ": \"radius\" has the shape " + as_text(radius) + ", expected " +
                               std::to_string(centre[0]) + ", as many as centres.");
      if (file.has("material") && file.shape("material") != hdf5::Shape{centre[0]})
        throw base::InputError(origin + ": \"material\" has the shape " + as_text(file.shape("material")) +
                               ", expected " + std::to_string(centre[0]) + ", as many as centres.");
      if (file.has("clump") && file.shape("clump") != hdf5::Shape{centre[0]})
        throw base::InputError(origin + ": \"clump\" has the shape " + as_text(file.shape("clump")) + ", expected " +
                               std::to_string(centre[0]) + ", as many as centres.");
      if (file.has("bodies") && (file.shape("bodies").size() != 2 || file.shape("bodies")[1] != body_record))
        throw base::InputError(origin + ": \"bodies\" has the shape " + as_text(file.shape("bodies")) +
                               ", expected N x 13: volume, centre, inertia by rows.");
      if (file.has("periodic_cell") && file.shape("periodic_cell") != hdf5::Shape{3})
        throw base::InputError(origin + ": \"periodic_cell\" has the shape " + as_text(file.shape("periodic_cell")) +
                               ", expected 3 edge lengths.");
    }

    std::int32_t narrowed(const std::int64_t number, const char *dataset, const std::string &origin)
    {
      if (number != static_cast<std::int32_t>(number))
        throw base::InputError(origin + ": \"" + dataset + "\" holds " + std::to_string(number) +
                               ", expected whole numbers from 0.");
      return static_cast<std::int32_t>(number);
    }

    void check_version(const hdf5::InputFile &file, const std::string &origin)
    {
      std::int64_t version = packing_version; // files of other programs need not have it
      if (file.has("format_version"))
        file.read("format_version", &version);
      if (version != packing_version)
        throw base::InputError(origin + ": packing format " + std::to_string(version) + ", this program reads format " +
                               std::to_string(packing_version) + ".");
    }
  } // namespace

  namespace
  {
    void read_bodies(const hdf5::InputFile &file, dem::Packing &packing, const std::string &origin)
    {
      std::vector<std::int64_t> numbers(packing.size());
      file.read("clump", numbers.data());
      for (const std::int64_t number : numbers)
        packing.clump.push_back(narrowed(number, "clump", origin));
      if (!file.has("bodies"))
        return;
      std::vector<double> table(body_record * file.shape("bodies")[0]);
      file.read("bodies", table.data());
      for (std::size_t at = 0; at < table.size(); at += body_record)
        packing.bodies.push_back({table[at], Eigen::Vector3d(&table[at + 1]), Eigen::Matrix3d(&table[at + 4])});
    }

    void write_bodies(hdf5::OutputFile &file, const dem::Packing &packing)
    {
      file.write("clump", packing.clump.data(), {packing.clump.size()});
      std::vector<double> table;
      for (const dem::PackedBody &body : packing.bodies)
        {
          table.push_back(body.volume);
          table.insert(table.end(), body.centre.data(), body.centre.data() + 3);
          table.insert(table.end(), body.inertia.data(), body.inertia.data() + 9); // symmetric: rows are columns
        }
      if (!table.empty())
        file.write("bodies", table.data(), {packing.bodies.size(), body_record});
    }
  } // namespace

  std::pair<dem::Packing, Metadata> read_packing_hdf5(const std::filesystem::path &path)
  {
    const hdf5::InputFile file(path);
    check_version(file, path.string());
    check_shapes(file, path.string());

    dem::Packing packing;
    packing.centre.resize(file.shape("centre")[0]);
    packing.radius.resize(packing.size());
    if (packing.size() > 0)
      {
        file.read("centre", packing.centre.front().data());
        file.read("radius", packing.radius.data());
      }
    if (file.has("periodic_cell"))
      file.read("periodic_cell", packing.periodic_cell.emplace().data());
    if (file.has("material") && packing.size() > 0)
      {
        std::vector<std::int64_t> numbers(packing.size()); // other programs may have written either width
        file.read("material", numbers.data());
        for (const std::int64_t number : numbers)
          packing.material.push_back(narrowed(number, "material", path.string()));
        if (file.has("material_names"))
          {
            std::istringstream words(file.read_text("material_names"));
            for (std::string name; words >> name;)
              packing.material_names.push_back(name);
          }
      }

    if (file.has("clump") && packing.size() > 0)
      read_bodies(file, packing, path.string());

    Metadata          metadata;
    const std::string folder = "metadata/";
    for (const std::string &name : file.names("metadata"))
      metadata[name.substr(folder.size())] = file.read_text(name);
    return {std::move(packing), std::move(metadata)};
  }

  std::optional<base::LengthUnit> unit_of_packing_hdf5(const std::filesystem::path &path)
  {
    const hdf5::InputFile file(path);
    if (!file.has("units"))
      return std::nullopt;
    const std::string text = file.read_text("units");
    const auto        unit = base::length_unit(text);
    if (!unit)
      throw base::InputError(path.string() + ": \"units\" is \"" + text + "\": lengths may be in " +
                             base::length_unit_names() + ".");
    return unit;
  }

  void write_packing_hdf5(const dem::Packing &packing, const std::filesystem::path &path, const Metadata &metadata)
  {
    hdf5::OutputFile file(path);
    file.write_text("format", "breccia packing");
    file.write("format_version", &packing_version, {});
    file.write_text("units", "m");
    file.write("centre", packing.size() > 0 ? packing.centre.front().data() : nullptr, {packing.size(), 3});
    file.write("radius", packing.radius.data(), {packing.radius.size()});
    if (packing.periodic_cell)
      file.write("periodic_cell", packing.periodic_cell->data(), {3});
    if (!packing.material.empty())
      {
        file.write("material", packing.material.data(), {packing.material.size()});
        std::string names;
        for (const std::string &name : packing.material_names)
          names += (names.empty() ? "" : " ") + name;
        if (!names.empty())
          file.write_text("material_names", names);
      }
    if (!packing.clump.empty())
      write_bodies(file, packing);
    for (const auto &[key, value] : metadata)
      file.write_text("metadata/" + key, value);
    file.commit();
  }
} // namespace postprocess
