#include "postprocess/packings/packing_header.h"

#include <algorithm>
#include <cctype>

namespace postprocess
{
  using namespace numeric_text;

  namespace
  {
    using Names = std::vector<ColumnName>;

    std::string lower_case(std::string_view text)
    {
      std::string lower(text);
      std::transform(lower.begin(), lower.end(), lower.begin(), [](const unsigned char c) { return std::tolower(c); });
      return lower;
    }

    bool is_one_of(const std::string_view name, const std::initializer_list<std::string_view> words)
    {
      const std::string lower = lower_case(name);
      return std::find(words.begin(), words.end(), lower) != words.end();
    }

    bool is_radius(const ColumnName &column) { return is_one_of(column.name, {"r", "radius", "rad"}); }
    bool is_diameter(const ColumnName &column) { return is_one_of(column.name, {"d", "diameter", "diam"}); }
    bool is_coordinate(const ColumnName &column, const std::size_t direction)
    {
      static constexpr std::array<std::string_view, 3> letters = {"x", "y", "z"};
      std::string                                      name    = lower_case(column.name);
      for (const std::string_view before :
           {"pos_", "pos-", "pos.", "position_", "position-"}) // as tables of PFC have it
        if (name.rfind(before, 0) == 0)
          name.erase(0, before.size());
      return name == letters.at(direction);
    }

    bool is_quantity(const ColumnName &column)
    {
      return is_radius(column) || is_diameter(column) || is_coordinate(column, 0) || is_coordinate(column, 1) ||
             is_coordinate(column, 2);
    }

    template <typename Is>
    std::size_t how_many(const Names &names, const Is &is)
    {
      return static_cast<std::size_t>(std::count_if(names.begin(), names.end(), is));
    }

    bool names_places(const Names &names)
    {
      for (std::size_t d = 0; d < 3; ++d)
        if (how_many(names, [d](const ColumnName &name) { return is_coordinate(name, d); }) != 1)
          return false;
      return true;
    }

    bool names_all_quantities(const Names &names)
    {
      return names_places(names) && (how_many(names, is_radius) == 1 || how_many(names, is_diameter) == 1);
    }

    /** "x_mm": a unit that is a part of the name. */
    ColumnName with_unit_taken_out(ColumnName column)
    {
      const std::size_t line = column.name.rfind('_');
      if (!column.unit.empty() || line == std::string::npos)
        return column;
      ColumnName parted{column.name.substr(0, line), column.name.substr(line + 1)};
      return is_quantity(parted) && base::length_unit(parted.unit) ? parted : column;
    }

    /** A sentence without its punctuation; brackets stay where they hold a unit. */
    std::string without_punctuation(std::string text)
    {
      for (std::size_t at = 0; at < text.size(); ++at)
        {
          if (std::string_view(",:;=|").find(text[at]) != std::string_view::npos)
            text[at] = ' ';
          if (text[at] != '(')
            continue;
          const std::size_t end = text.find(')', at);
          if (end == std::string::npos ||
              base::length_unit(trimmed(std::string_view(text).substr(at + 1, end - at - 1))))
            continue;
          text[at] = text[end] = ' ';
        }
      return text;
    }

    /** The sentence as names between blanks: "centre (x, y, z)", and "x_y_z_r" as another program writes it. */
    Names words_of(const std::string_view comment)
    {
      Names words;
      for (ColumnName &word : packing_column_names(without_punctuation(std::string(comment))))
        {
          std::string &name = word.name;
          if (!name.empty() && name.back() == '.')
            name.pop_back();
          if (lower_case(name).rfind("x_y_z_", 0) != 0)
            {
              words.push_back(std::move(word));
              continue;
            }
          if (!words.empty() && lower_case(words.back().name) == "format") // "#format x_y_z_r_matId", of YADE
            words.pop_back();
          std::replace(name.begin(), name.end(), '_', ' ');
          for (ColumnName &part : column_names(name))
            words.push_back(std::move(part));
        }
      return words;
    }
  } // namespace

  std::vector<ColumnName> packing_column_names(const std::string_view line)
  {
    Names names;
    for (ColumnName &column : column_names(line))
      names.push_back(with_unit_taken_out(std::move(column)));
    return names;
  }

  PackingColumns packing_columns(const Names &names, const std::string &origin, const std::size_t line)
  {
    PackingColumns columns;
    columns.count = names.size();
    columns.named = true;
    if (!names_all_quantities(names))
      refuse(origin, line, "the header must name each of the columns x, y, z and radius (or diameter) once.");
    columns.diameter = how_many(names, is_radius) == 0;
    for (std::size_t i = 0; i < names.size(); ++i)
      {
        std::size_t quantity = 0;
        while (quantity < 3 && !is_coordinate(names[i], quantity))
          ++quantity;
        if (quantity == 3 && !(columns.diameter ? is_diameter(names[i]) : is_radius(names[i])))
          continue;
        columns.place[quantity] = i;
        columns.unit[quantity]  = base::length_unit(names[i].unit);
        if (!names[i].unit.empty() && !columns.unit[quantity])
          refuse(origin, line,
                 "the column " + names[i].name + " is in [" + names[i].unit + "]: lengths may be in " +
                   base::length_unit_names() + ".");
      }
    for (std::size_t i = 0; i < names.size(); ++i)
      for (const auto &[word, place] : {std::pair{"material", &columns.material},
                                        std::pair{"matid", &columns.material}, // the second as YADE has it
                                        std::pair{"clump", &columns.clump}})
        if (lower_case(names[i].name) == word)
          {
            if (*place)
              refuse(origin, line, std::string("the header names the column ") + word + " twice.");
            *place                    = i;
            columns.numbers_materials = columns.numbers_materials || std::string_view(word) == "matid";
          }
    return columns;
  }

  CommentedNames names_in_comment(const std::string_view comment, const std::size_t columns)
  {
    CommentedNames found;
    if (Names whole = packing_column_names(comment); whole.size() == columns && names_places(whole))
      {
        found.names = std::move(whole);
        return found;
      }
    const Names words = words_of(comment);
    std::size_t ways  = 0;
    for (std::size_t first = 0; first + columns <= words.size(); ++first)
      {
        const auto begin = words.begin() + static_cast<std::ptrdiff_t>(first);
        Names      part(begin, begin + static_cast<std::ptrdiff_t>(columns));
        if (!names_all_quantities(part))
          continue;
        found.names = std::move(part);
        ++ways;
      }
    if (ways == 1)
      return found;
    found.names.clear();
    for (std::size_t first = 0; first + 3 <= words.size(); ++first)
      {
        const auto begin = words.begin() + static_cast<std::ptrdiff_t>(first);
        found.in_doubt   = found.in_doubt || names_places({begin, begin + 3});
      }
    return found;
  }

  bool looks_like_names(const std::string_view comment, const std::size_t columns)
  {
    const Names words = packing_column_names(comment);
    return words.size() == columns && comment.find(':') == std::string_view::npos &&
           std::none_of(words.begin(), words.end(), [](const ColumnName &word) {
             return number(word.name) || is_one_of(word.name, {"in", "of", "the", "by", "a", "and", "with", "for",
                                                               "from", "to", "at", "are", "is", "all", "no"});
           });
  }

  bool speaks_of_diameters(const std::string_view comment)
  {
    const Names words = words_of(comment);
    return std::any_of(words.begin(), words.end(), [](const ColumnName &word) {
      return is_one_of(word.name, {"diameter", "diameters"});
    });
  }
} // namespace postprocess
