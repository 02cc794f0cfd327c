#include "postprocess/files/stated_unit.h"

#include "postprocess/files/numeric_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace postprocess
{
  using namespace numeric_text;

  namespace
  {
    struct CommentWord
    {
      std::string text; ///< in small letters, without brackets
      bool        in_brackets = false;
    };

    std::vector<CommentWord> comment_words(const std::string_view comment)
    {
      std::string plain(comment);
      for (char &c : plain)
        c = c == ':' || c == ';' || c == '=' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      std::vector<std::string_view> fields;
      split(plain, fields);
      std::vector<CommentWord> words;
      for (std::string_view field : fields)
        {
          const std::size_t open = field.find_first_of("[(");
          if (open != std::string_view::npos && open > 0) // "x[mm]"
            {
              words.push_back({std::string(field.substr(0, open)), false});
              field.remove_prefix(open);
            }
          const std::size_t first = field.find_first_not_of("[("), last = field.find_last_not_of(")].");
          if (first != std::string_view::npos && last != std::string_view::npos && last >= first)
            words.push_back({std::string(field.substr(first, last - first + 1)), first > 0});
        }
      return words;
    }

    bool speaks_of_lengths(const std::vector<CommentWord> &words)
    {
      static constexpr std::array<std::string_view, 19> of_lengths = {
        "length",   "lengths",    "unit",    "units",  "distances", "coordinates", "dimensions",
        "all",      "everything", "values",  "data",   "radius",    "radii",       "x",
        "diameter", "diameters",  "centres", "places", "positions"};
      return std::any_of(words.begin(), words.end(), [](const CommentWord &word) {
        return std::find(of_lengths.begin(), of_lengths.end(), word.text) != of_lengths.end();
      });
    }

    struct UnitMentioned
    {
      base::LengthUnit unit;
      bool             clearly = false;
    };

    std::vector<UnitMentioned> units_in(const std::string_view comment, const bool names_columns)
    {
      const std::vector<CommentWord> words      = comment_words(comment);
      const bool                     of_lengths = speaks_of_lengths(words);
      std::vector<UnitMentioned>     found;
      for (std::size_t i = 0; i < words.size(); ++i)
        {
          const auto        unit   = base::length_unit(words[i].text);
          const std::string before = i > 0 ? words[i - 1].text : "";
          if (!unit || number(before) || (names_columns && words[i].in_brackets))
            continue;
          // A lone "m" may stand for anything.
          const bool lone_letter = words[i].text.size() == 1;
          if (lone_letter && !(words[i].in_brackets || before == "in" || before == "unit" || before == "units"))
            continue;
          if (!lone_letter || of_lengths)
            found.push_back({*unit, of_lengths});
        }
      return found;
    }
  } // namespace

  void StatedUnit::read(const std::string_view comment, const std::size_t line, const bool names_columns)
  {
    for (const UnitMentioned &mentioned : units_in(comment, names_columns))
      if (!mentioned.clearly)
        {
          if (mentioned.unit != base::LengthUnit()) // metres are what is taken anyway
            {
              doubted    = mentioned.unit;
              doubted_in = line;
            }
        }
      else if (said && *said != mentioned.unit)
        refuse(origin, line,
               std::string("says that lengths are in ") + mentioned.unit.symbol + ", and line " +
                 std::to_string(said_in) + " that they are in " + said->symbol + ". Keep one of the two.");
      else
        {
          said    = mentioned.unit;
          said_in = line;
        }
  }

  void StatedUnit::require_no_doubt() const
  {
    if (said || !doubted)
      return;
    const std::string symbol = doubted->symbol;
    refuse(origin, doubted_in,
           "this comment names the unit " + symbol +
             ", and nothing says whether the lengths of the file are in it. Add \"# lengths in " + symbol +
             "\", or \"# lengths in m\".");
  }

  bool states_unit(const std::string_view comment)
  {
    const auto units = units_in(comment, false);
    return std::any_of(units.begin(), units.end(), [](const UnitMentioned &unit) { return unit.clearly; });
  }
} // namespace postprocess
