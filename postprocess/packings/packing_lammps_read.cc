#include "base/errors.h"
#include "postprocess/files/numeric_text.h"
#include "postprocess/packings/packing_lammps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace postprocess
{
  using namespace numeric_text;

  namespace
  {
    using Fields = std::vector<std::string_view>;

    /** A sphere as its line has it. */
    struct Sphere
    {
      double          id = 0, type = 1, radius = 0;
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
    };

    struct LammpsBox
    {
      std::array<double, 3> low{}, high{};
      std::array<bool, 3>   periodic{};
    };

    /** Line by line, without what follows a #, which may name the style of a section. */
    class LammpsReader
    {
    public:
      LammpsReader(const std::string &text, std::string origin_)
        : lines(text)
        , origin(std::move(origin_))
      {
      }

      /** The next line that holds something. */
      bool next()
      {
        while (lines.next())
          {
            const std::string_view line = lines.text();
            const std::size_t      mark = std::min(line.find('#'), line.size());
            split(line.substr(0, mark), fields);
            comment = trimmed(line.substr(std::min(mark + 1, line.size())));
            if (!fields.empty())
              return true;
          }
        return false;
      }

      void need(const std::string &what)
      {
        if (!next())
          throw base::InputError(origin + ": ends where " + what + " should stand.");
      }

      double number_at(const std::size_t column) const
      {
        if (column >= fields.size())
          refuse_line("found " + std::to_string(fields.size()) + " columns, expected more.");
        return finite_number(fields[column], origin, lines.number());
      }

      std::size_t count_at(const std::size_t column) const
      {
        const double value = number_at(column);
        if (!(value >= 1 && value <= 1e12) || value != static_cast<double>(static_cast<std::size_t>(value)))
          refuse_line(std::string(fields[column]) + ": expected a number of atoms, at least 1.");
        return static_cast<std::size_t>(value);
      }

      /** A type of atoms, up to the last one that there is; 0: the file does not say which that is. */
      double type_at(const std::size_t column, const std::size_t last) const
      {
        const double most  = last > 0 ? static_cast<double>(last) : most_types;
        const double value = number_at(column);
        if (!(value >= 1 && value <= most) || value != std::floor(value))
          refuse_line("type " + std::string(fields[column]) + ": expected a whole number from 1 to " +
                      std::to_string(static_cast<long>(most)) + ".");
        return value;
      }

      static constexpr double most_types = 1e5; ///< each is kept, whether there are atoms of it or not

      [[noreturn]] void refuse_line(const std::string &message) const { refuse(origin, lines.number(), message); }

      Lines            lines;
      std::string      origin;
      Fields           fields;
      std::string_view comment;
    };

    /** @param types that there are, whether of any sphere or not; 0: the file does not say */
    dem::Packing packing_of(std::vector<Sphere>             spheres,
                            const std::optional<LammpsBox> &box,
                            std::size_t                     types,
                            const LammpsReader             &reader)
    {
      std::stable_sort(spheres.begin(), spheres.end(), [](const Sphere &a, const Sphere &b) { return a.id < b.id; });
      dem::Packing packing;
      for (const Sphere &sphere : spheres)
        types = std::max(types, static_cast<std::size_t>(sphere.type));
      for (const Sphere &sphere : spheres)
        {
          if (!(sphere.radius > 0))
            throw base::InputError(reader.origin + ": atom " + std::to_string(static_cast<long>(sphere.id)) +
                                   " has no size; spheres have.");
          packing.centre.push_back(sphere.place);
          packing.radius.push_back(sphere.radius);
          if (types > 1)
            packing.material.push_back(static_cast<std::int32_t>(sphere.type) - 1);
        }
      for (std::size_t type = 1; types > 1 && type <= types; ++type)
        packing.material_names.push_back(std::to_string(type));
      const auto periodic = box ? std::count(box->periodic.begin(), box->periodic.end(), true) : 0;
      if (periodic == 0)
        return packing;
      if (periodic < 3)
        throw base::InputError(reader.origin + ": is periodic along " + std::to_string(periodic) +
                               " of three edges; a packing is along all or none.");
      packing.periodic_cell.emplace();
      for (int d = 0; d < 3; ++d)
        {
          (*packing.periodic_cell)[d] = box->high[d] - box->low[d];
          if (box->low[d] != 0)
            for (Eigen::Vector3d &place : packing.centre)
              place[d] -= box->low[d];
        }
      return packing;
    }

    // --- data ---

    bool is_section(const Fields &fields)
    {
      return std::isupper(static_cast<unsigned char>(fields.front().front())) != 0;
    }

    Sphere sphere_of_data(const LammpsReader &reader, const std::size_t types)
    {
      Sphere sphere; // atom-ID atom-type diameter density x y z, and images of the box perhaps
      sphere.id     = reader.number_at(0);
      sphere.type   = reader.type_at(1, types);
      sphere.radius = 0.5 * reader.number_at(2);
      for (int d = 0; d < 3; ++d)
        sphere.place[d] = reader.number_at(4 + static_cast<std::size_t>(d));
      if (reader.fields.size() != 7 && reader.fields.size() != 10)
        reader.refuse_line("found " + std::to_string(reader.fields.size()) +
                           " columns; atom style sphere has 7 (id type diameter density x y z), or 10 with images.");
      return sphere;
    }

    dem::Packing read_data(const std::string &text, const std::string &origin)
    {
      LammpsReader reader(text, origin);
      const auto   first = std::string_view(text).substr(0, text.find('\n'));
      LammpsBox    box;
      box.periodic.fill(first.find("boundary p p p") != std::string_view::npos);
      reader.lines.next(); // a title
      std::size_t atoms = 0, types = 0;
      while (reader.next() && !(is_section(reader.fields) && reader.fields.front() == "Atoms"))
        if (const Fields &f = reader.fields; f.size() == 2 && f[1] == "atoms")
          atoms = reader.count_at(0);
        else if (f.size() == 3 && f[1] == "atom" && f[2] == "types")
          types = static_cast<std::size_t>(reader.type_at(0, 0));
        else if (f.size() == 4 && f[3].size() == 3 && f[3].substr(1) == "hi" && f[2].substr(1) == "lo")
          {
            const std::size_t d = static_cast<std::size_t>(f[3][0] - 'x');
            if (d > 2)
              reader.refuse_line("expected xlo xhi, ylo yhi or zlo zhi.");
            box.low[d]  = reader.number_at(0);
            box.high[d] = reader.number_at(1);
          }
        else if (f.size() == 6 && f[3] == "xy")
          reader.refuse_line("the box is triclinic; only boxes of right angles are taken.");
      if (reader.fields.empty() || reader.fields.front() != "Atoms")
        throw base::InputError(origin + ": has no section Atoms.");
      if (!reader.comment.empty() && reader.comment != "sphere")
        reader.refuse_line("atom style " + std::string(reader.comment) + ": spheres are of style sphere.");
      std::vector<Sphere> spheres;
      for (std::size_t i = 0; i < atoms; ++i)
        {
          reader.need("atom " + std::to_string(i + 1) + " of " + std::to_string(atoms));
          spheres.push_back(sphere_of_data(reader, types));
        }
      return packing_of(std::move(spheres), box, types, reader);
    }

    // --- dump ---

    /** Columns of a dump by name. */
    class DumpColumns
    {
    public:
      explicit DumpColumns(const LammpsReader &reader)
      {
        for (std::size_t k = 2; k < reader.fields.size(); ++k) // after ITEM: ATOMS
          place[std::string(reader.fields[k])] = k - 2;
        const bool sized = has("radius") || has("diameter");
        for (int d = 0; d < 3; ++d)
          if (!has(axis(d)) || !sized)
            reader.refuse_line(
              "columns must be x y z (or xu yu zu) and radius (or diameter), in any order, among others.");
      }

      Sphere sphere(const LammpsReader &reader, const std::size_t row) const
      {
        if (reader.fields.size() != place.size())
          reader.refuse_line("found " + std::to_string(reader.fields.size()) + " columns, expected " +
                             std::to_string(place.size()) + ".");
        Sphere sphere;
        sphere.id   = has("id") ? reader.number_at(place.at("id")) : static_cast<double>(row);
        sphere.type = has("type") ? reader.type_at(place.at("type"), 0) : 1;
        sphere.radius =
          has("radius") ? reader.number_at(place.at("radius")) : 0.5 * reader.number_at(place.at("diameter"));
        for (int d = 0; d < 3; ++d)
          sphere.place[d] = reader.number_at(place.at(axis(d)));
        return sphere;
      }

    private:
      bool        has(const std::string &name) const { return place.count(name) > 0; }
      std::string axis(const int d) const
      {
        const std::string wrapped(1, static_cast<char>('x' + d));
        return has(wrapped) ? wrapped : wrapped + "u";
      }

      std::map<std::string, std::size_t> place;
    };

    LammpsBox box_of_dump(LammpsReader &reader)
    {
      LammpsBox box;
      if (reader.fields.size() >= 4 && reader.fields[3] == "xy")
        reader.refuse_line("the box is triclinic; only boxes of right angles are taken.");
      for (std::size_t d = 0; d < 3; ++d)
        box.periodic[d] = reader.fields.size() == 6 && reader.fields[3 + d] == "pp";
      for (std::size_t d = 0; d < 3; ++d)
        {
          reader.need("the bounds of the box");
          box.low[d]  = reader.number_at(0);
          box.high[d] = reader.number_at(1);
        }
      return box;
    }

    dem::Packing read_dump(const std::string &text, const std::string &origin)
    {
      LammpsReader             reader(text, origin);
      std::vector<Sphere>      spheres;
      std::optional<LammpsBox> box;
      std::size_t              atoms = 0;
      while (reader.next())
        {
          if (reader.fields.size() < 2 || reader.fields[0] != "ITEM:")
            reader.refuse_line("expected a line ITEM: of a dump.");
          const std::string item(reader.fields[1]);
          if (item == "BOX")
            box = box_of_dump(reader);
          else if (item == "ATOMS")
            {
              const DumpColumns columns(reader);
              spheres.clear(); // a later snapshot counts
              for (std::size_t i = 0; i < atoms; ++i)
                {
                  reader.need("atom " + std::to_string(i + 1) + " of " + std::to_string(atoms));
                  spheres.push_back(columns.sphere(reader, i + 1));
                }
            }
          else
            {
              reader.need("what belongs to ITEM: " + item);
              if (item == "NUMBER")
                atoms = reader.count_at(0);
            }
        }
      if (spheres.empty())
        throw base::InputError(origin + ": holds no snapshot with atoms.");
      return packing_of(std::move(spheres), box, 0, reader);
    }
  } // namespace

  dem::Packing read_packing_lammps(const LammpsFile what, const std::string &text, const std::string &origin)
  {
    return what == LammpsFile::data ? read_data(text, origin) : read_dump(text, origin);
  }
} // namespace postprocess
