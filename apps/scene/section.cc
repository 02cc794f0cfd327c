#include "apps/scene/section.h"

#include "apps/scene/usual_sizes.h"
#include "apps/text/same_name.h"
#include "apps/text/time_table.h"
#include "apps/text/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

namespace apps
{
  namespace
  {
    std::string joined(const std::vector<std::string> &words)
    {
      std::string all;
      for (const std::string &word : words)
        all += (all.empty() ? "" : ", ") + word;
      return all;
    }

    std::string expected(const std::string &what, const std::string &allowed)
    {
      return "expected " + what + (allowed.empty() ? "" : " " + allowed);
    }

    std::string vector_text(const std::array<double, 3> &value)
    {
      return fmt::format("{}, {}, {}", value[0], value[1], value[2]);
    }
    /**
     * What a number of a unit can be at all, zero apart: generous, and such that products and squares of all of them can be
     * computed. Whoever writes 1e308 has made a mistake, and would be answered with infinity.
     */
    struct Magnitudes
    {
      const char *unit;
      double      least, most;

      bool contain(const double value) const
      {
        return value == 0 || std::isinf(value) || (std::abs(value) >= least && std::abs(value) <= most);
      }
      std::string text() const { return fmt::format(", of a size from {:g} to {:g}", least, most); }
    };

    const Magnitudes *magnitudes_of(const std::string &unit)
    {
      static const std::array<Magnitudes, 8> known = {{{"m", 1e-12, 1e9},
                                                       {"Pa", 1e-9, 1e18},
                                                       {"kg/m^3", 1e-9, 1e15},
                                                       {"1/s", 1e-20, 1e9},
                                                       {"m/s", 1e-20, 3e8},
                                                       {"m/s^2", 1e-20, 1e12},
                                                       {"s", 1e-15, 1e15},
                                                       {"", 1e-30, 1e30}}};
      return std::find_if(known.begin(), known.end() - 1, [&](const Magnitudes &m) { return unit == m.unit; });
    }

    /** A text without the unit behind it, and whether one was written: "25e9 Pa". */
    struct WithoutUnit
    {
      std::string text;
      bool        unit_named = false;
    };

    WithoutUnit without_unit(const std::string &text, const std::string &unit)
    {
      const std::string ending = " " + unit;
      if (unit.empty() || text.size() <= ending.size() ||
          text.compare(text.size() - ending.size(), ending.size(), ending) != 0)
        return {text, false};
      return {trimmed(text.substr(0, text.size() - ending.size())), true};
    }

    /** "inf" is a number where the range says so, for what has no limit. */
    std::optional<double> number_or_infinity(const std::string &text)
    {
      return same_name(trimmed(text), "inf") ? std::numeric_limits<double>::infinity() : number_in(text);
    }
  } // namespace

  bool Range::contains(const double value) const
  {
    return (std::isfinite(value) || value == upper) && value >= lower && (upper_open ? value < upper : value <= upper);
  }

  std::string Range::text() const
  {
    constexpr double largest  = std::numeric_limits<double>::max();
    constexpr double smallest = std::numeric_limits<double>::min();
    const bool       no_lower = lower == -largest, no_upper = upper >= largest;
    if (no_lower && no_upper)
      return "";
    if (no_upper)
      return (lower == smallest ? "> 0" : fmt::format(">= {}", lower)) + (upper > largest ? ", or inf" : "");
    if (no_lower)
      return fmt::format("{} {}", upper_open ? "<" : "<=", upper);
    return fmt::format("in {}{}, {}{}", lower == smallest ? "(" : "[", lower == smallest ? 0.0 : lower, upper,
                       upper_open ? ")" : "]");
  }

  Section::Section(std::string section_name, std::string section_meaning)
    : own_name(std::move(section_name))
    , own_meaning(std::move(section_meaning))
  {
  }

  Entry &Section::add(const std::string &entry, const std::string &type, const Need need, const std::string &initial)
  {
    own_entries.push_back(std::make_unique<Entry>());
    Entry &added   = *own_entries.back();
    added.name     = entry;
    added.type     = type;
    added.required = need == Need::required;
    added.value    = added.required ? "" : initial;
    return added;
  }

  Entry &Section::number(
    const std::string &entry, double &member, const std::string &unit, const Range &range, const Need need)
  {
    Entry &added  = add(entry, "number", need, fmt::format("{}", member));
    added.unit    = unit;
    added.allowed = range.text();
    added.store   = [&member, range, unit, entry](const std::string &text, const Place &) -> std::string {
      const WithoutUnit written = without_unit(text, unit);
      const auto        number  = number_or_infinity(written.text);
      if (!number || !range.contains(*number))
        return expected("a number", range.text());
      if (const Magnitudes *limits = magnitudes_of(unit); !limits->contain(*number))
        return expected("a number", range.text()) + limits->text();
      const std::string question = written.unit_named ? "" : question_about(entry, unit, *number, written.text);
      if (question.empty())
        member = *number;
      return question;
    };
    return added;
  }

  Entry &Section::integer(
    const std::string &entry, std::int64_t &member, const std::string &unit, const Range &range, const Need need)
  {
    Entry &added  = add(entry, "whole number", need, fmt::format("{}", member));
    added.unit    = unit;
    added.allowed = range.text();
    added.store   = [&member, range](const std::string &text, const Place &) -> std::string {
      const auto value = integer_in(text);
      if (!value || !range.contains(static_cast<double>(*value)))
        return expected("a whole number", range.text());
      member = *value;
      return "";
    };
    return added;
  }

  Entry &Section::flag(const std::string &entry, bool &member)
  {
    Entry &added  = add(entry, "switch", Need::optional, member ? "true" : "false");
    added.allowed = "one of: true, false";
    added.store   = [&member](const std::string &text, const Place &) -> std::string {
      if (!same_name(text, "true") && !same_name(text, "false"))
        return "expected true or false";
      member = same_name(text, "true");
      return "";
    };
    return added;
  }

  Entry &Section::vector(const std::string     &entry,
                         std::array<double, 3> &member,
                         const std::string     &unit,
                         const Range           &range,
                         const Need             need)
  {
    Entry &added  = add(entry, "three numbers", need, vector_text(member));
    added.unit    = unit;
    added.allowed = range.text().empty() ? "" : "each " + range.text();
    added.store   = [&member, range, unit, entry](const std::string &text, const Place &) -> std::string {
      const WithoutUnit              written = without_unit(text, unit);
      const std::vector<std::string> parts   = comma_separated(written.text);
      std::array<double, 3>          values{};
      bool                           valid = parts.size() == 3;
      for (std::size_t i = 0; valid && i < 3; ++i)
        {
          const auto value = number_in(parts[i]);
          valid            = value && range.contains(*value);
          values[i]        = value.value_or(0.0);
        }
      if (!valid)
        return expected("three numbers \"x, y, z\"", range.text().empty() ? "" : "each " + range.text());
      const Magnitudes *limits = magnitudes_of(unit);
      if (!std::all_of(values.begin(), values.end(), [&](const double value) { return limits->contain(value); }))
        return expected("three numbers \"x, y, z\"", limits->text());
      for (const double value : values)
        if (const std::string question = written.unit_named ? "" : question_about(entry, unit, value, written.text);
            !question.empty())
          return question;
      member = values;
      return "";
    };
    return added;
  }

  Entry &Section::file(const std::string &entry, std::string &member, const Need need)
  {
    Entry &added = add(entry, "file", need, "");
    added.store  = [&member](const std::string &text, const Place &from) -> std::string {
      if (text.empty())
        return "expected the name of a file";
      // A name in a scene is meant from the scene's folder, one on the command line from where the user stands.
      const std::filesystem::path base = std::filesystem::path(from.file).parent_path();
      member                           = (base / text).string();
      return "";
    };
    return added;
  }

  Entry &Section::text(const std::string &entry, std::string &member, const Need need)
  {
    Entry &added = add(entry, "text", need, member);
    added.store  = [&member](const std::string &text, const Place &) -> std::string {
      member = text;
      return "";
    };
    return added;
  }

  namespace
  {
    /** @return what is wrong with it, "" if nothing */
    std::string store_table(
      const TableName &named, const Place &from, const std::string &entry, const std::string &unit, Expression &member)
    {
      const std::filesystem::path file = std::filesystem::path(from.file).parent_path() / named.file;
      if (!std::filesystem::is_regular_file(file))
        return "expected a table of time and value: there is no file " +
               std::filesystem::absolute(file).lexically_normal().string();
      const auto        table = std::make_shared<const TimeTable>(file.string(), named.column, unit);
      const std::string question =
        table->unit_named() ? "" : question_about(entry, unit, table->largest(), fmt::format("{:g}", table->largest()));
      if (!question.empty())
        return question + ", in the table behind the name of its column, in brackets";
      member = Expression(table);
      return "";
    }

    /** Scenes in motion end within a second, and those in equilibrium have theirs from 0 to 1. */
    double largest_in_a_second(const Expression &formula)
    {
      double largest = 0;
      for (const double t : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.25, 0.5, 0.75, 1.0})
        largest = std::max(largest, std::abs(formula(0, 0, 0, t)));
      return largest;
    }
  } // namespace

  Entry &Section::expression(const std::string &entry, Expression &member, const std::string &unit)
  {
    Entry &added  = add(entry, "formula", Need::optional, "");
    added.unit    = unit;
    added.allowed = "in x, y, z [m] and t [s], or table FILE.csv, or empty";
    added.store   = [&member, unit, entry, name = path_of(entry)](const std::string &whole,
                                                                const Place       &from) -> std::string {
      if (const auto named = table_in(whole))
        return store_table(*named, from, entry, unit, member);
      const WithoutUnit  written = without_unit(whole, unit);
      const std::string &text    = written.text;
      if (text.empty())
        {
          member = Expression();
          return "";
        }
      const std::string wrong = Expression::fault(text);
      if (!wrong.empty())
        return "expected a formula in x, y, z and t: " + wrong;
      const Expression formula(text, from.text() + ": " + name);
      if (!formula.varies_in_space())
        try
          {
            const std::string question = formula.varies_in_time() ?
                                             question_about_growing(entry, unit, largest_in_a_second(formula), text) :
                                             question_about(entry, unit, formula(0, 0, 0, 0), text);
            if (!written.unit_named && !question.empty())
              return question;
          }
        catch (const base::NumericalError &)
          {
            if (!formula.varies_in_time()) // else it may be one within the time of the scene
              return "expected a formula in x, y, z and t: its value is not a finite number";
          }
      member = formula;
      return "";
    };
    return added;
  }

  Entry &Section::add_choice(const std::string               &entry,
                             const std::vector<std::string>  &words,
                             const std::size_t                initial,
                             std::function<void(std::size_t)> assign,
                             const Need                       need)
  {
    Entry &added  = add(entry, "word", need, initial < words.size() ? words[initial] : "");
    added.allowed = "one of: " + joined(words);
    added.store   = [words, assign = std::move(assign)](const std::string &text, const Place &) -> std::string {
      const auto found = std::find_if(words.begin(), words.end(), [&](const auto &w) { return same_name(w, text); });
      if (found == words.end())
        return "expected one of: " + joined(words);
      assign(static_cast<std::size_t>(found - words.begin()));
      return "";
    };
    return added;
  }

  Entry &Section::add_choices(const std::string                                    &entry,
                              const std::vector<std::string>                       &words,
                              const std::string                                    &initial,
                              std::function<void(const std::vector<std::size_t> &)> assign,
                              const Need                                            need)
  {
    Entry &added  = add(entry, "list of words", need, initial);
    added.allowed = "at least one of: " + joined(words);
    added.store   = [words, assign = std::move(assign)](const std::string &text, const Place &) -> std::string {
      std::vector<std::size_t> positions;
      for (const std::string &word : comma_separated(text))
        {
          const auto found =
            std::find_if(words.begin(), words.end(), [&](const auto &w) { return same_name(w, word); });
          const auto position = static_cast<std::size_t>(found - words.begin());
          if (found == words.end() || std::count(positions.begin(), positions.end(), position) > 0)
            return "expected words separated by commas, of: " + joined(words) + "; each at most once";
          positions.push_back(position);
        }
      if (positions.empty())
        return "expected at least one of: " + joined(words);
      assign(positions);
      return "";
    };
    return added;
  }

  Section &Section::section(const std::string &subsection, const std::string &subsection_meaning)
  {
    subsections.push_back(std::make_unique<Section>(subsection, subsection_meaning));
    subsections.back()->parent = this;
    return *subsections.back();
  }

  void Section::named_sections(const std::string &name, std::function<void(Section &)> declare)
  {
    placeholder   = name;
    declare_named = std::move(declare);
  }

  Section *Section::open_section(const std::string &subsection, const Place &from)
  {
    Section *known = find_section(subsection);
    if (known || !declare_named)
      return known;
    Section &opened  = section(subsection, own_meaning);
    opened.opened_at = from;
    declare_named(opened);
    return &opened;
  }

  void Section::open_placeholders()
  {
    if (declare_named)
      open_section(placeholder, {});
    for (const auto &subsection : subsections)
      subsection->open_placeholders();
  }

  void Section::only_if(std::function<bool()> condition, std::string condition_in_words)
  {
    holds              = std::move(condition);
    words_of_condition = std::move(condition_in_words);
  }

  std::string Section::path() const
  {
    if (!parent || parent->path().empty())
      return own_name;
    return parent->path() + "/" + own_name;
  }

  std::string Section::path_of(const std::string &entry) const { return path().empty() ? entry : path() + "/" + entry; }

  bool Section::needed() const { return (!parent || parent->needed()) && (!holds || holds()); }

  Entry *Section::find_entry(const std::string &entry) const
  {
    for (const auto &candidate : own_entries)
      if (same_name(candidate->name, entry))
        return candidate.get();
    return nullptr;
  }

  Section *Section::find_section(const std::string &subsection) const
  {
    for (const auto &candidate : subsections)
      if (candidate->own_name == subsection || (!declare_named && same_name(candidate->own_name, subsection)))
        return candidate.get();
    return nullptr;
  }

  std::vector<std::string> Section::entry_names() const
  {
    std::vector<std::string> names;
    for (const auto &entry : own_entries)
      names.push_back(entry->name);
    return names;
  }

  std::vector<std::string> Section::section_names() const
  {
    std::vector<std::string> names;
    for (const auto &subsection : subsections)
      names.push_back(subsection->own_name);
    return names;
  }

  void Section::refuse(const std::string &entry, const std::string &rule) const
  {
    const Entry      *refused = find_entry(entry);
    const std::string where   = refused && refused->set ? refused->place.text() + ": " : "";
    const std::string value   = refused ? " = " + refused->value : "";
    throw base::InputError(where + path_of(entry) + value + ": " + rule);
  }
} // namespace apps
