#include "postprocess/packing_text.h"

#include "base/errors.h"
#include "postprocess/numeric_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>

namespace postprocess
{
  using namespace numeric_text;

  namespace
  {
    constexpr std::size_t quantities   = 4;  // x, y, z, radius
    constexpr std::size_t body_numbers = 10; // volume, centre, inertia

    /** Where x, y, z and radius stand in a row. */
    struct RowLayout
    {
      std::array<std::size_t, quantities> place = {0, 1, 2, 3};
      std::optional<std::size_t>          material, clump;
      std::size_t                         columns = quantities;
      bool                                named   = false; ///< taken from a header
    };

    std::string lower_case(std::string name)
    {
      std::transform(name.begin(), name.end(), name.begin(), [](const unsigned char c) { return std::tolower(c); });
      return name;
    }

    bool names_quantity(const ColumnName &column, const std::size_t quantity)
    {
      static constexpr std::array<std::string_view, quantities> letters = {"x", "y", "z", "r"};
      const std::string                                         name    = lower_case(column.name);
      return name == letters[quantity] || (quantity == 3 && name == "radius");
    }

    bool names_all_quantities(const std::vector<ColumnName> &names)
    {
      for (std::size_t quantity = 0; quantity < quantities; ++quantity)
        if (std::none_of(names.begin(), names.end(), [&](const auto &name) { return names_quantity(name, quantity); }))
          return false;
      return true;
    }

    /** Reads a text line by line; its members are what it has understood so far. */
    class PackingParser
    {
    public:
      PackingParser(const std::string &origin_, const std::string_view text)
        : origin(origin_)
        , lines(text)
      {
      }

      std::pair<dem::Packing, Metadata> parse()
      {
        while (lines.next())
          {
            const std::string_view line = trimmed(lines.text());
            if (line.empty())
              continue;
            if (line[0] == '#')
              read_comment(trimmed(line.substr(1)));
            else if (packing.size() == 0 && !layout.named && is_header(line))
              use_header(column_names(line));
            else
              read_particle(line);
          }
        if (packing.size() == 0)
          throw base::InputError(origin + ": holds no particle. Give lines of x y z radius [m].");
        if (layout.material)
          packing.material_names.resize(numbers.size());
        for (const auto &[name, value] : numbers)
          if (layout.material)
            packing.material_names[static_cast<std::size_t>(value)] = name;
        return {std::move(packing), std::move(metadata)};
      }

    private:
      static bool is_header(const std::string_view line)
      {
        const bool is_number =
          number(line.substr(0, line.find_first_of(" \t,"))).has_value(); // nan is one, and refused
        return std::isalpha(static_cast<unsigned char>(line[0])) && !is_number;
      }

      void read_comment(const std::string_view line)
      {
        split(line, fields);
        if (!fields.empty() && (fields[0] == "periodic_cell" || fields[0] == "periodic_cell:"))
          read_periodic_cell();
        else if (packing.size() == 0 && !fields.empty() && fields[0] == "body" && fields.size() == 1 + body_numbers)
          read_body();
        else if (packing.size() == 0 && !fields.empty() && (fields[0] == "materials" || fields[0] == "materials:"))
          {
            announced.assign(fields.begin() + 1, fields.end());
            announced_in = lines.number();
          }
        else if (const auto names = column_names(line); packing.size() == 0 && names_all_quantities(names))
          commented_names = names;
        else if (const std::size_t colon = line.find(':'); colon != std::string_view::npos)
          metadata[std::string(trimmed(line.substr(0, colon)))] = trimmed(line.substr(colon + 1));
      }

      void read_periodic_cell()
      {
        if (fields.size() != 4)
          refuse_line("periodic_cell has " + std::to_string(fields.size() - 1) +
                      " edge lengths, expected 3: LX LY LZ [m].");
        if (packing.periodic_cell)
          refuse_line("periodic_cell is there a second time.");
        packing.periodic_cell.emplace();
        for (int d = 0; d < 3; ++d)
          (*packing.periodic_cell)[d] = positive("periodic_cell edge", fields[d + 1]);
      }

      /** volume, centre, inertia xx yy zz yz xz xy */
      void read_body()
      {
        std::array<double, body_numbers> n;
        for (std::size_t i = 0; i < body_numbers; ++i)
          n[i] = finite_number(fields[i + 1], origin, lines.number());
        dem::PackedBody &body = packing.bodies.emplace_back();
        body.volume           = n[0];
        body.centre           = {n[1], n[2], n[3]};
        body.inertia << n[4], n[9], n[8], n[9], n[5], n[7], n[8], n[7], n[6];
      }

      std::int32_t clump_in(const std::string_view field) const
      {
        const double value = finite_number(field, origin, lines.number());
        if (value != static_cast<std::int32_t>(value) || value < -1)
          refuse_line("clump = " + std::string(field) + ": expected the number of a line \"# body\", from 0, or -1.");
        return static_cast<std::int32_t>(value);
      }

      /** The line "# materials" is only looked at where there is a column to name: elsewhere it may be prose. */
      void number_materials()
      {
        for (const std::string &name : announced)
          {
            if (!dem::is_material_name(name))
              refuse(origin, announced_in, "material \"" + name + "\": " + dem::material_name_rule() + ".");
            if (!numbers.emplace(name, numbers.size()).second)
              refuse(origin, announced_in, "the material \"" + name + "\" is named twice.");
          }
      }

      /** Number of a material, in the order of the line that names them, or else of first appearance. */
      std::int32_t material_in(const std::string_view field)
      {
        if (numbers.empty())
          number_materials();
        const std::string name(field);
        if (const auto known = numbers.find(name); known != numbers.end())
          return known->second;
        if (!announced.empty())
          refuse_line("material \"" + name + "\" is not in the line \"# materials\".");
        if (!dem::is_material_name(name))
          refuse_line("material \"" + name + "\": " + dem::material_name_rule() + ".");
        return numbers.emplace(name, numbers.size()).first->second;
      }

      void use_header(const std::vector<ColumnName> &names)
      {
        for (std::size_t quantity = 0; quantity < quantities; ++quantity)
          {
            const auto is_wanted = [&](const ColumnName &name) { return names_quantity(name, quantity); };
            if (std::count_if(names.begin(), names.end(), is_wanted) != 1)
              refuse_line("the header must name each of the columns x, y, z and radius once.");
            const auto found       = std::find_if(names.begin(), names.end(), is_wanted);
            layout.place[quantity] = found - names.begin();
            if (!found->unit.empty() && found->unit != "m")
              refuse_line("the column " + found->name + " is in [" + found->unit + "]: lengths must be in [m].");
          }
        for (std::size_t i = 0; i < names.size(); ++i)
          if (lower_case(names[i].name) == "material")
            {
              if (layout.material)
                refuse_line("the header names the column material twice.");
              layout.material = i;
            }
        for (std::size_t i = 0; i < names.size(); ++i)
          if (lower_case(names[i].name) == "clump")
            layout.clump = i;
        layout.columns = names.size();
        layout.named   = true;
      }

      void read_particle(const std::string_view line)
      {
        split(line, fields);
        // A comment with the four names was the header if it has as many names as there are columns; otherwise it was
        // prose.
        if (packing.size() == 0 && !layout.named && commented_names.size() == fields.size())
          use_header(commented_names);
        if (fields.size() != layout.columns)
          refuse_line("found " + std::to_string(fields.size()) + " columns, expected " +
                      std::to_string(layout.columns) + (layout.named ? " as in the header." : ": x y z radius."));
        Eigen::Vector3d centre;
        for (int d = 0; d < 3; ++d)
          centre[d] = finite_number(fields[layout.place[d]], origin, lines.number());
        packing.centre.push_back(centre);
        packing.radius.push_back(positive("radius", fields[layout.place[3]]));
        if (layout.material)
          packing.material.push_back(material_in(fields[*layout.material]));
        if (layout.clump)
          packing.clump.push_back(clump_in(fields[*layout.clump]));
      }

      double positive(const std::string &what, const std::string_view field) const
      {
        const double value = finite_number(field, origin, lines.number());
        if (!(value > 0))
          refuse_line(what + " = " + std::string(field) + " m: must be above 0.");
        return value;
      }

      [[noreturn]] void refuse_line(const std::string &message) const { refuse(origin, lines.number(), message); }

      std::string                         origin;
      Lines                               lines;
      RowLayout                           layout;
      std::vector<std::string_view>       fields;
      std::vector<ColumnName>             commented_names;
      std::map<std::string, std::int32_t> numbers;          ///< of materials
      std::vector<std::string>            announced;        ///< materials of the line "# materials"
      std::size_t                         announced_in = 0; ///< its number
      dem::Packing                        packing;
      Metadata                            metadata;
    };
  } // namespace

  std::pair<dem::Packing, Metadata> read_packing_text(const std::filesystem::path &path)
  {
    const std::string text = read_text(path);
    return PackingParser(path.string(), text).parse();
  }

  namespace
  {
    /** What its materials are called; those without a name by their number. Empty: there is one material. */
    std::vector<std::string> names_of_materials(const dem::Packing &packing)
    {
      std::vector<std::string> names;
      if (packing.material.empty())
        return names;
      names = packing.material_names;
      for (const std::int32_t number : packing.material)
        while (static_cast<std::int32_t>(names.size()) <= number)
          names.push_back(std::to_string(names.size()));
      return names;
    }
  } // namespace

  std::string packing_as_text(const dem::Packing &packing, const Metadata &metadata, const char separator)
  {
    std::string text = "# breccia packing: lengths in m\n";
    for (const auto &[key, value] : metadata)
      text += "# " + key + ": " + value + "\n";

    const auto append_row = [&](const std::string &begin, const std::vector<double> &values, const char between,
                                const std::string &last = "") {
      text += begin;
      for (std::size_t i = 0; i < values.size(); ++i)
        {
          if (i > 0)
            text += between;
          append(text, values[i]);
        }
      if (!last.empty())
        (text += between) += last;
      text += '\n';
    };
    if (packing.periodic_cell)
      append_row("# periodic_cell ",
                 {packing.periodic_cell->x(), packing.periodic_cell->y(), packing.periodic_cell->z()}, ' ');
    const std::vector<std::string> materials = names_of_materials(packing);
    if (!materials.empty())
      {
        text += "# materials";
        for (const std::string &name : materials)
          text += " " + name;
        text += '\n';
      }
    for (const dem::PackedBody &body : packing.bodies)
      {
        const Eigen::Matrix3d &I = body.inertia;
        append_row("# body ",
                   {body.volume, body.centre.x(), body.centre.y(), body.centre.z(), I(0, 0), I(1, 1), I(2, 2), I(1, 2),
                    I(0, 2), I(0, 1)},
                   ' ');
      }
    for (const char *const name : {"x", "y", "z"})
      (text += name) += separator;
    text += "radius";
    if (!materials.empty())
      (text += separator) += "material";
    if (!packing.clump.empty())
      (text += separator) += "clump";
    text += '\n';
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        std::string last = materials.empty() ? "" : materials.at(static_cast<std::size_t>(packing.material[i]));
        if (!packing.clump.empty())
          (last.empty() ? last : last += separator) += std::to_string(packing.clump[i]);
        append_row("", {packing.centre[i].x(), packing.centre[i].y(), packing.centre[i].z(), packing.radius[i]},
                   separator, last);
      }
    return text;
  }
} // namespace postprocess
