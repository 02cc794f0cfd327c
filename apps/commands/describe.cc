#include "apps/commands/command.h"
#include "apps/drivers/all.h"
#include "apps/drivers/read_scene.h"
#include "apps/process/exit_status.h"
#include "apps/scene/description.h"
#include "apps/scene/nearest_name.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <memory>

namespace apps
{
  namespace
  {
    struct DescribeOptions
    {
      std::string wanted, kind, format = "prm";
    };

    std::string in_lower_case(std::string text)
    {
      for (char &c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      return text;
    }

    /** Whether the path ("Loading/Tension/Strain rate") is the wanted one or ends with it; case does not matter. */
    bool is_called(const std::string &path, const std::string &wanted)
    {
      const std::string longer = "/" + in_lower_case(path), end = "/" + in_lower_case(wanted);
      return longer.size() >= end.size() && longer.compare(longer.size() - end.size(), end.size(), end) == 0;
    }

    /** A section, or one entry of it. */
    struct Match
    {
      const Section *section;
      const Entry   *entry;
    };

    /** Every section of that name or path with all that it holds, and every such entry; all sections for an empty name. */
    void collect(const Section &section, const std::string &wanted, std::vector<Match> &found)
    {
      const bool is_wanted = wanted.empty() || (!section.path().empty() && is_called(section.path(), wanted));
      if (is_wanted)
        found.push_back({&section, nullptr});
      else
        for (const auto &entry : section.entries())
          if (is_called(section.path_of(entry->name), wanted))
            found.push_back({&section, entry.get()});
      for (const auto &subsection : section.sections())
        collect(*subsection, is_wanted ? "" : wanted, found);
    }

    void collect_names(const Section &section, std::vector<std::string> &names)
    {
      if (!section.path().empty())
        names.push_back(section.path());
      for (const auto &entry : section.entries())
        names.push_back(entry->name);
      for (const auto &subsection : section.sections())
        collect_names(*subsection, names);
    }

    /** A text, and the kinds of scenes that it holds for. */
    struct Passage
    {
      std::string heading, text, kinds;
    };

    /** What several kinds have in common is said once; another wording stands after the first of its heading. */
    void add(std::vector<Passage> &passages, const Passage &next)
    {
      auto after = passages.end();
      for (auto passage = passages.begin(); passage != passages.end(); ++passage)
        {
          if (passage->heading != next.heading)
            continue;
          if (passage->text == next.text)
            {
              passage->kinds += ", " + next.kinds;
              return;
            }
          after = passage + 1;
        }
      passages.insert(after, next);
    }

    Passage in_markdown(const Match &match, const std::string &kind)
    {
      const std::string path = match.section->path();
      std::string       text = description_as_markdown(*match.section, match.entry);
      // Each kind has itself as the default of Kind; but for that all of them say the same.
      const std::string own = "| Kind |  | " + kind + " |";
      if (const auto at = text.find(own); path.empty() && at != std::string::npos)
        text.replace(at, own.size(), "| Kind |  | required |");
      if (path.empty())
        text.insert(0, "\n"); // a table begins after an empty line
      return {path.empty() ? "Outside all sections" : path, text, kind};
    }

    void print_markdown(const std::vector<Passage> &passages, const bool whole)
    {
      if (whole)
        fmt::print(
          "# Parameters of scenes\n\nWritten by `breccia describe --format md`. Numbers are in SI units; `-` marks "
          "pure numbers.\n\n");
      for (std::size_t i = 0; i < passages.size(); ++i)
        fmt::print("{}## {}\n\n*Scenes of kind {}.* {}", i > 0 ? "\n" : "", passages[i].heading, passages[i].kinds,
                   passages[i].text);
    }

    void print_prm(const std::vector<Passage> &passages)
    {
      for (const Passage &passage : passages)
        fmt::print("# Scenes of kind {}\n{}", passage.kinds, passage.text);
    }

    /** Whole files show each section once, inside its parent: matches within matches are left out. */
    std::vector<Match> outermost(const std::vector<Match> &found)
    {
      std::vector<Match> kept;
      for (const Match &match : found)
        {
          const auto holds = [&](const Match &outer) {
            const std::string path = match.section->path();
            return !outer.entry && (outer.section->path().empty() || path == outer.section->path() ||
                                    path.rfind(outer.section->path() + "/", 0) == 0);
          };
          if (std::none_of(kept.begin(), kept.end(), holds))
            kept.push_back(match);
        }
      return kept;
    }

    /** Sections and entries of all kinds, or of the one asked for. */
    int describe(const DescribeOptions &options)
    {
      std::vector<std::string>    names;
      std::vector<Passage>        passages;
      std::vector<nlohmann::json> objects;
      for (const SceneKind &kind : scene_kinds())
        {
          if (!options.kind.empty() && kind.name != options.kind)
            continue;
          const CheckedScene scene = declare_scene(kind.name);
          std::vector<Match> found;
          collect(*scene.root, options.wanted, found);
          collect_names(*scene.root, names);
          if (options.format == "md")
            for (const Match &match : found)
              add(passages, in_markdown(match, kind.name));
          else
            for (const Match &match : outermost(found))
              {
                add(passages, {match.section->path(), description_as_prm(*match.section, match.entry), kind.name});
                objects.push_back(description_as_json(*match.section, match.entry));
                objects.back()["kind"] = kind.name;
              }
        }
      if (passages.empty())
        throw base::InputError("command line: there is no section or entry \"" + options.wanted + "\". " +
                               did_you_mean(options.wanted, names));
      if (options.format == "json")
        fmt::print("{}\n",
                   (objects.size() == 1 && !options.kind.empty() ? objects.front() : nlohmann::json(objects)).dump(2));
      else if (options.format == "md")
        print_markdown(passages, options.wanted.empty() && options.kind.empty());
      else
        print_prm(passages);
      return exit_success;
    }
  } // namespace

  void add_describe(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<DescribeOptions>();
    CLI::App  &command = *program.add_subcommand(
       "describe", "Every parameter of a scene, or those of a section, or one: meaning, unit, default, range");
    command
      .add_option(
        "name", options->wanted,
        "Section or entry by its name or the end of its path, e.g. Damping, Tension, Loading/Tension; default: all")
      ->type_name("NAME");
    std::vector<std::string> kinds;
    for (const SceneKind &kind : scene_kinds())
      kinds.push_back(kind.name);
    command.add_option("--kind", options->kind, "Only scenes of this kind; default: all kinds")
      ->check(CLI::IsMember(kinds));
    command.add_option("--format", options->format, "prm (default), json or md (Markdown)")
      ->check(CLI::IsMember({"prm", "json", "md"}));
    command.callback([options, &chosen] { chosen = [options] { return describe(*options); }; });
  }
} // namespace apps
