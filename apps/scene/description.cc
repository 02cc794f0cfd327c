#include "apps/scene/description.h"

#include "apps/text/time_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

namespace apps
{
  namespace
  {
    std::string unit_in_brackets(const Entry &entry) { return entry.unit.empty() ? "" : " [" + entry.unit + "]"; }

    /** "meaning [unit]; > 0; only if ..." */
    std::string remark(const Entry &entry)
    {
      return entry.meaning + unit_in_brackets(entry) + (entry.allowed.empty() ? "" : "; " + entry.allowed) +
             (entry.condition.empty() ? "" : "; only if " + entry.condition);
    }

    std::string margin(const int depth) { return std::string(2 * static_cast<std::size_t>(depth), ' '); }

    void open(const Section &section, const int depth, std::string &text)
    {
      text += "\n" + margin(depth) + "subsection " + section.name() + "\n";
    }

    void describe_in_prm(const Section &section, const Entry *const only, const int depth, std::string &text)
    {
      for (const auto &entry : section.entries())
        {
          if (only && entry.get() != only)
            continue;
          text += margin(depth) + "# " + remark(*entry) + "\n";
          text += margin(depth) + (entry->required ? "# set " + entry->name + " =    (no default)\n" :
                                                     "set " + entry->name + " = " + entry->value + "\n");
        }
      if (only)
        return;
      for (const auto &subsection : section.sections())
        {
          open(*subsection, depth, text);
          text += margin(depth + 1) + "# " + subsection->meaning() +
                  (subsection->condition().empty() ? "" : "; only if " + subsection->condition()) + "\n";
          describe_in_prm(*subsection, nullptr, depth + 1, text);
          text += margin(depth) + "end\n";
        }
    }

    /** "MATERIAL": in the place of a name that the scene chooses. Laws in capitals, as CPM, have a condition. */
    bool is_placeholder(const Section &section)
    {
      return section.condition().empty() &&
             std::none_of(section.name().begin(), section.name().end(),
                          [](const char c) { return std::islower(static_cast<unsigned char>(c)) != 0; });
    }

    /** Every entry a comment: what must be given without a value, all else with its default. @param before "# " below a placeholder */
    void propose(const Section &section, const int depth, const std::string &before, std::string &text)
    {
      for (const auto &entry : section.entries())
        text += margin(depth) + "# " + remark(*entry) + "\n" + margin(depth) + "# set " + entry->name + " = " +
                (entry->required ? "(to be given)" : entry->value) + "\n";
      for (const auto &subsection : section.sections())
        {
          const std::string open_or_not = is_placeholder(*subsection) ? "# " : before;
          text += "\n" + margin(depth) + open_or_not + "subsection " + subsection->name() + "\n" + margin(depth + 1) +
                  "# " + subsection->meaning() +
                  (subsection->condition().empty() ? "" : "; only if " + subsection->condition()) + "\n";
          propose(*subsection, depth + 1, open_or_not, text);
          text += margin(depth) + open_or_not + "end\n";
        }
    }

    std::string escaped(std::string text)
    {
      for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2)
        text.insert(i, "\\");
      return text;
    }

    std::optional<TableName> table_of(const Entry &entry)
    {
      return entry.type == "formula" ? table_in(entry.value) : std::nullopt;
    }

    /** A file name stays valid when the completed scene stands in another folder. */
    std::string portable_value(const Entry &entry)
    {
      const auto from_scene = [&](const std::string &file) {
        return std::filesystem::absolute(std::filesystem::path(entry.place.file).parent_path() / file)
          .lexically_normal()
          .string();
      };
      if (entry.type == "file")
        return from_scene(entry.value);
      if (const auto table = table_of(entry))
        return "table " + from_scene(table->file) + (table->column.empty() ? "" : ": " + table->column);
      return entry.value;
    }

    std::string completed_line(const Entry &entry, const Completed what)
    {
      // Files decide by their content, which is compared apart, and not by their names.
      const bool        shortened = what == Completed::what_decides_results;
      const auto        table     = table_of(entry);
      const std::string value     = shortened && entry.type == "file" ? "(content)" :
                                    shortened && table                ? "table (content): " + table->column :
                                                                        portable_value(entry);
      const std::string line      = "set " + entry.name + " = " + value;
      return what == Completed::everything ?
               fmt::format("{:<48} # {}{}\n", line, entry.meaning, unit_in_brackets(entry)) :
               line + "\n";
    }

    void complete(const Section &section, const Completed what, const int depth, std::string &text)
    {
      for (const auto &entry : section.entries())
        if ((entry->set || (entry->needed() && !entry->required && !entry->value.empty())) &&
            (entry->decides || what == Completed::everything))
          text += margin(depth) + completed_line(*entry, what);
      for (const auto &subsection : section.sections())
        {
          if (!subsection->needed())
            continue;
          open(*subsection, depth, text);
          complete(*subsection, what, depth + 1, text);
          text += margin(depth) + "end\n";
        }
    }
  } // namespace

  std::string description_as_prm(const Section &section, const Entry *const only)
  {
    std::string text;
    std::string path = section.path();
    std::string opening, closing;
    for (int depth = 0; !path.empty(); ++depth)
      {
        const auto slash = path.find('/');
        opening += margin(depth) + "subsection " + path.substr(0, slash) + "\n";
        closing.insert(0, margin(depth) + "end\n");
        path = slash == std::string::npos ? "" : path.substr(slash + 1);
      }
    const auto depth = static_cast<int>(std::count(opening.begin(), opening.end(), '\n'));
    if (depth > 0)
      text = opening + margin(depth) + "# " + section.meaning() +
             (section.condition().empty() ? "" : "; only if " + section.condition()) + "\n";
    describe_in_prm(section, only, depth, text);
    return text + closing;
  }

  std::string description_as_markdown(const Section &section, const Entry *const only)
  {
    std::string text;
    if (!section.path().empty())
      text =
        section.meaning() + "." + (section.condition().empty() ? "" : " Only if " + section.condition() + ".") + "\n";
    if (!section.entries().empty())
      text += "\n| Entry | Unit | Default | Allowed | Meaning |\n|---|---|---|---|---|\n";
    for (const auto &entry : section.entries())
      if (!only || entry.get() == only)
        text += escaped(entry->name).insert(0, "| ") + " | " + entry->unit + " | " +
                (entry->required ? "required" : escaped(entry->value)) + " | " +
                escaped(entry->type + (entry->allowed.empty() ? "" : ", " + entry->allowed)) + " | " +
                escaped(entry->meaning) + (entry->condition.empty() ? "" : "; only if " + entry->condition) + " |\n";
    return text;
  }

  nlohmann::json description_as_json(const Section &section, const Entry *const only)
  {
    nlohmann::json described = {{"path", section.path()}, {"meaning", section.meaning()}};
    if (!section.condition().empty())
      described["only_if"] = section.condition();
    described["entries"] = nlohmann::json::array();
    for (const auto &entry : section.entries())
      {
        if (only && entry.get() != only)
          continue;
        nlohmann::json one = {{"name", entry->name}, {"unit", entry->unit},       {"meaning", entry->meaning},
                              {"type", entry->type}, {"allowed", entry->allowed}, {"required", entry->required}};
        if (!entry->required)
          one["default"] = entry->value;
        if (!entry->condition.empty())
          one["only_if"] = entry->condition;
        described["entries"].push_back(std::move(one));
      }
    described["sections"] = nlohmann::json::array();
    if (!only)
      for (const auto &subsection : section.sections())
        described["sections"].push_back(description_as_json(*subsection));
    return described;
  }

  std::string proposed_scene(const Section &root, const std::string &kind)
  {
    std::string text;
    propose(root, 0, "", text);
    return "# Take away the # of what you set; \"breccia check\" names all that must be given and is not.\n\nset Kind "
           "= " +
           kind + "\n\n" + text.substr(text.find('\n', text.find("# set Kind")) + 1);
  }

  std::string completed_scene(const Section &root, const Completed what)
  {
    std::string text;
    complete(root, what, 0, text);
    return text;
  }
} // namespace apps
