#include "postprocess/packings/packing_text.h"

#include "base/errors.h"
#include "postprocess/files/numeric_text.h"
#include "postprocess/files/stated_unit.h"
#include "postprocess/packings/packing_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

namespace postprocess
{
  using namespace numeric_text;

  namespace
  {
    constexpr std::size_t body_numbers = 10; // volume, centre, inertia

    /** A comment above or among the particles. */
    struct CommentLine
    {
      std::string_view text;
      std::size_t      number = 0;
      bool             plain  = true; ///< not one of the lines that have a meaning of their own
    };

    /** Reads a text line by line; its members are what it has understood so far. */
    class PackingParser
    {
    public:
      /** @param text must outlive the parser @param requested unit that the reader expects; empty: as the file says */
      PackingParser(const std::string                     &origin_,
                    const std::string_view                 text,
                    const std::optional<base::LengthUnit> &requested_)
        : origin(origin_)
        , lines(text)
        , requested(requested_)
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
              use_header(packing_column_names(line), lines.number());
            else
              read_particle(line);
          }
        if (packing.size() == 0)
          throw base::InputError(origin + ": holds no particle. Give lines of x y z radius [m].");
        refuse_diameters_in_prose();
        convert_to_metres();
        if (layout.material)
          packing.material_names.resize(numbers.size());
        for (const auto &[name, value] : numbers)
          if (layout.material)
            packing.material_names[static_cast<std::size_t>(value)] = name;
        return {std::move(packing), std::move(metadata)};
      }

      /** Once the text is parsed. */
      bool says_unit() const
      {
        return layout.unit[0].has_value() ||
               std::any_of(comments.begin(), comments.end(), [](const auto &one) { return states_unit(one.text); });
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
        comments.push_back({line, lines.number(), false});
        if (!fields.empty() && (fields[0] == "periodic_cell" || fields[0] == "periodic_cell:"))
          read_periodic_cell();
        else if (packing.size() == 0 && !fields.empty() && fields[0] == "body" && fields.size() == 1 + body_numbers)
          read_body();
        else if (packing.size() == 0 && !fields.empty() && (fields[0] == "materials" || fields[0] == "materials:"))
          {
            announced.assign(fields.begin() + 1, fields.end());
            announced_in = lines.number();
          }
        else
          {
            comments.back().plain = true;
            // What is said of the unit is used up with the reading: the packing is in metres from now on.
            if (const std::size_t colon = line.find(':'); colon != std::string_view::npos && !states_unit(line))
              if (const std::string key(trimmed(line.substr(0, colon))); is_metadata_key(key))
                metadata[key] = trimmed(line.substr(colon + 1));
          }
      }

      void read_periodic_cell()
      {
        const bool with_unit = fields.size() == 5;
        if (with_unit)
          {
            const auto bare = fields[4].substr(0, fields[4].find_last_not_of(")]") + 1);
            cell_unit       = base::length_unit(bare.substr(std::min(bare.size(), bare.find_first_not_of("[("))));
          }
        if (fields.size() != 4 && !cell_unit)
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

      /** The line "# materials" is only read where there is a column to name: elsewhere it may be prose. */
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
        if (layout.numbers_materials && !announced.empty())
          return number_of_announced(field);
        const std::string name(field);
        if (const auto known = numbers.find(name); known != numbers.end())
          return known->second;
        if (!announced.empty())
          refuse_line("material \"" + name + "\" is not in the line \"# materials\".");
        if (!dem::is_material_name(name))
          refuse_line("material \"" + name + "\": " + dem::material_name_rule() + ".");
        return numbers.emplace(name, numbers.size()).first->second;
      }

      /** YADE has numbers in the rows; what they are called our line "# materials" says. */
      std::int32_t number_of_announced(const std::string_view field) const
      {
        const double value = finite_number(field, origin, lines.number());
        if (!(value >= 0 && value < static_cast<double>(announced.size())) || value != std::floor(value))
          refuse_line("material " + std::string(field) + ": the line \"# materials\" names " +
                      std::to_string(announced.size()) + ", numbered from 0.");
        return static_cast<std::int32_t>(value);
      }

      void use_header(const std::vector<ColumnName> &names, const std::size_t line)
      {
        layout    = packing_columns(names, origin, line);
        header_in = line;
      }

      /** The last comment that names the columns, if any, is their header; one that seems to must be understood. */
      void look_for_header_in_comments(const std::size_t columns)
      {
        std::optional<std::size_t> in_doubt;
        for (const CommentLine &comment : comments)
          if (const CommentedNames found = names_in_comment(comment.text, columns); !comment.plain)
            continue;
          else if (!found.names.empty())
            use_header(found.names, comment.number);
          else if (found.in_doubt)
            in_doubt = comment.number;
        if (layout.named)
          return;
        if (!in_doubt && !comments.empty() && comments.back().plain && !states_unit(comments.back().text) &&
            looks_like_names(comments.back().text, columns))
          in_doubt = comments.back().number;
        if (in_doubt)
          refuse(
            origin, *in_doubt,
            "seems to name the " + std::to_string(columns) +
              " columns below, and not each of x, y, z and radius (or diameter) once. Name them so, e.g. \"# x y z "
              "radius\", or reword the comment.");
      }

      /** Comments may stand below the rows, too. */
      void refuse_diameters_in_prose() const
      {
        if (layout.named)
          return;
        for (const CommentLine &comment : comments)
          if (comment.plain && speaks_of_diameters(comment.text))
            refuse(origin, comment.number,
                   "speaks of diameters, and the fourth column is taken for the radius. Say what it is above the rows: "
                   "\"# x y z diameter\", or \"# x y z radius\".");
      }

      void read_particle(const std::string_view line)
      {
        split(line, fields);
        if (packing.size() == 0 && !layout.named)
          look_for_header_in_comments(fields.size());
        if (fields.size() != layout.count)
          refuse_line("found " + std::to_string(fields.size()) + " columns, expected " + std::to_string(layout.count) +
                      (layout.named ? " as in the header." : ": x y z radius."));
        Eigen::Vector3d centre;
        for (int d = 0; d < 3; ++d)
          centre[d] = finite_number(fields[layout.place[d]], origin, lines.number());
        packing.centre.push_back(centre);
        packing.radius.push_back(positive(layout.diameter ? "diameter" : "radius", fields[layout.place[3]]));
        if (layout.material)
          packing.material.push_back(material_in(fields[*layout.material]));
        if (layout.clump)
          packing.clump.push_back(clump_in(fields[*layout.clump]));
      }

      double positive(const std::string &what, const std::string_view field) const
      {
        const double value = finite_number(field, origin, lines.number());
        if (!(value > 0))
          refuse_line(what + " = " + std::string(field) + ": must be above 0.");
        return value;
      }

      /** The one that the file states, or else the one that the reader expects. Both are the same, or one is wrong. */
      std::optional<base::LengthUnit> unit_of_file() const
      {
        StatedUnit stated(origin);
        for (const CommentLine &comment : comments)
          if (comment.plain)
            stated.read(comment.text, comment.number, comment.number == header_in);
        const bool columns_say =
          std::all_of(layout.unit.begin(), layout.unit.end(), [](const auto &unit) { return unit.has_value(); });
        if (!requested && !columns_say)
          stated.require_no_doubt();
        if (requested && stated.unit() && *requested != *stated.unit())
          refuse(origin, stated.line(),
                 std::string("says that lengths are in ") + stated.unit()->symbol +
                   ", and Length unit that they are in " + requested->symbol + ". Leave it out, or correct the file.");
        return stated.unit() ? stated.unit() : requested;
      }

      base::LengthUnit unit_of(const std::size_t quantity, const std::optional<base::LengthUnit> &of_file) const
      {
        const std::optional<base::LengthUnit> &own = layout.unit[quantity];
        if (own && of_file && *own != *of_file)
          refuse(origin, header_in,
                 std::string("a column is in [") + own->symbol + "], and lengths of the file are said to be in " +
                   of_file->symbol + ". Keep one of the two.");
        const bool some = std::any_of(layout.unit.begin(), layout.unit.end(),
                                      [](const auto &unit) { return unit && *unit != base::LengthUnit(); });
        if (!own && !of_file && some)
          refuse(origin, header_in,
                 "some of the columns x, y, z and radius (or diameter) have a unit and others none: name it for each.");
        return own ? *own : of_file.value_or(base::LengthUnit());
      }

      void convert_to_metres()
      {
        const std::optional<base::LengthUnit> of_file = unit_of_file();
        const base::LengthUnit                places = unit_of(0, of_file), sizes = unit_of(3, of_file);
        if (unit_of(1, of_file) != places || unit_of(2, of_file) != places)
          refuse(origin, header_in, "x, y and z are not in one unit.");
        if (!packing.bodies.empty() && places != base::LengthUnit())
          throw base::InputError(origin + ": the lines \"# body\" are in m, and the places of particles in " +
                                 places.symbol + ". Write both in m.");
        for (Eigen::Vector3d &centre : packing.centre)
          centre /= places.in_a_metre;
        for (double &size : packing.radius)
          size = sizes.metres(layout.diameter ? 0.5 * size : size);
        if (packing.periodic_cell)
          *packing.periodic_cell /= cell_unit.value_or(places).in_a_metre;
      }

      [[noreturn]] void refuse_line(const std::string &message) const { refuse(origin, lines.number(), message); }

      std::string                         origin;
      Lines                               lines;
      std::optional<base::LengthUnit>     requested, cell_unit;
      PackingColumns                      layout;
      std::vector<std::string_view>       fields;
      std::vector<CommentLine>            comments;
      std::size_t                         header_in = 0;    ///< number of its line
      std::map<std::string, std::int32_t> numbers;          ///< of materials
      std::vector<std::string>            announced;        ///< materials of the line "# materials"
      std::size_t                         announced_in = 0; ///< its number
      dem::Packing                        packing;
      Metadata                            metadata;
    };
  } // namespace

  std::pair<dem::Packing, Metadata> read_packing_text(const std::filesystem::path           &path,
                                                      const std::optional<base::LengthUnit> &unit)
  {
    const std::string text = read_text(path);
    return PackingParser(path.string(), text, unit).parse();
  }

  bool packing_text_says_unit(const std::filesystem::path &path)
  {
    const std::string text = read_text(path);
    PackingParser     parser(path.string(), text, {});
    parser.parse();
    return parser.says_unit();
  }
} // namespace postprocess
