#include "postprocess/packings/packing_lammps.h"

#include "base/errors.h"
#include "postprocess/files/numeric_text.h"

#include <algorithm>
#include <array>
#include <vector>

namespace postprocess
{
  using namespace numeric_text;

  namespace
  {
    struct BoxAround
    {
      std::array<double, 3> low{}, high{};
    };

    std::string shortest(const double value)
    {
      std::string text;
      append(text, value);
      return text;
    }

    BoxAround box_around(const dem::Packing &packing)
    {
      BoxAround box;
      for (int d = 0; d < 3; ++d)
        {
          const auto k = static_cast<std::size_t>(d);
          box.low[k]   = packing.periodic_cell ? 0 : packing.centre[0][d] - packing.radius[0];
          box.high[k]  = packing.periodic_cell ? (*packing.periodic_cell)[d] : packing.centre[0][d] + packing.radius[0];
          for (std::size_t i = 0; !packing.periodic_cell && i < packing.size(); ++i)
            {
              box.low[k]  = std::min(box.low[k], packing.centre[i][d] - packing.radius[i]);
              box.high[k] = std::max(box.high[k], packing.centre[i][d] + packing.radius[i]);
            }
        }
      return box;
    }

    std::int32_t type_of(const dem::Packing &packing, const std::size_t i)
    {
      return packing.material.empty() ? 1 : packing.material[i] + 1;
    }

    std::string place_text(const Eigen::Vector3d &x)
    {
      return shortest(x[0]) + " " + shortest(x[1]) + " " + shortest(x[2]);
    }

    std::string data_text(const dem::Packing &packing, const BoxAround &box)
    {
      auto types = std::max<std::int32_t>(1, static_cast<std::int32_t>(packing.material_names.size()));
      for (std::size_t i = 0; i < packing.size(); ++i)
        types = std::max(types, type_of(packing, i));
      std::string text = std::string("Spheres of Breccia, lengths in m, boundary ") +
                         (packing.periodic_cell ? "p p p" : "f f f") + "\n\n" + std::to_string(packing.size()) +
                         " atoms\n" + std::to_string(types) + " atom types\n\n";
      for (std::size_t d = 0; d < 3; ++d)
        {
          const std::string axis(1, static_cast<char>('x' + d));
          text += shortest(box.low[d]) + " " + shortest(box.high[d]) + " " + axis + "lo " + axis + "hi\n";
        }
      text += "\nAtoms # sphere\n\n"; // id type diameter density x y z
      for (std::size_t i = 0; i < packing.size(); ++i)
        text += std::to_string(i + 1) + " " + std::to_string(type_of(packing, i)) + " " +
                shortest(2 * packing.radius[i]) + " 1 " + place_text(packing.centre[i]) + "\n";
      return text;
    }

    std::string dump_text(const dem::Packing &packing, const BoxAround &box)
    {
      std::string text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + std::to_string(packing.size()) +
                         "\nITEM: BOX BOUNDS" + (packing.periodic_cell ? " pp pp pp\n" : " ff ff ff\n");
      for (std::size_t d = 0; d < 3; ++d)
        text += shortest(box.low[d]) + " " + shortest(box.high[d]) + "\n";
      text += "ITEM: ATOMS id type x y z radius\n";
      for (std::size_t i = 0; i < packing.size(); ++i)
        text += std::to_string(i + 1) + " " + std::to_string(type_of(packing, i)) + " " +
                place_text(packing.centre[i]) + " " + shortest(packing.radius[i]) + "\n";
      return text;
    }
  } // namespace

  std::optional<LammpsFile> lammps_file(const std::string_view text)
  {
    if (text.rfind("ITEM:", 0) == 0)
      return LammpsFile::dump;
    Lines lines(text);
    lines.next(); // a title
    std::vector<std::string_view> fields;
    for (int n = 0; n < 30 && lines.next(); ++n)
      {
        split(lines.text().substr(0, std::min(lines.text().find('#'), lines.text().size())), fields);
        if (fields.size() == 2 && fields[1] == "atoms" && number(fields[0]))
          return LammpsFile::data;
      }
    return std::nullopt;
  }

  std::optional<LammpsFile> lammps_name(const std::filesystem::path &path)
  {
    const std::string extension = path.extension().string();
    if (extension == ".data" || extension == ".lmp")
      return LammpsFile::data;
    if (extension == ".dump" || extension == ".lammpstrj")
      return LammpsFile::dump;
    return std::nullopt;
  }

  std::string packing_as_lammps(const LammpsFile what, const dem::Packing &packing)
  {
    if (!packing.bodies.empty())
      throw base::InputError("a packing with rigid bodies has no place in a file of LAMMPS; write text or HDF5.");
    if (packing.periodic_cell && !packing.periodic_cell->allFinite())
      throw base::InputError(
        "a packing that is periodic along some edges alone has no place in a file of LAMMPS; write "
        "text or HDF5.");
    const BoxAround box = box_around(packing);
    return what == LammpsFile::data ? data_text(packing, box) : dump_text(packing, box);
  }
} // namespace postprocess
