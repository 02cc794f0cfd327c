#include "apps/commands/command.h"
#include "apps/drivers/all.h"
#include "apps/exit_status.h"
#include "apps/scene/description.h"
#include "apps/scene/load.h"
#include "apps/scene/nearest_name.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace apps
{
  namespace
  {
    struct DescribeOptions
    {
      std::string section, kind, format = "prm";
    };

    void collect_sections(const Section &section, std::vector<const Section *> &all)
    {
      all.push_back(&section);
      for (const auto &subsection : section.sections())
        collect_sections(*subsection, all);
    }

    /** The section of that path ("Material/CPM") or, if only one has it, of that name ("CPM"); case does not matter. */
    const Section *find(const std::vector<const Section *> &sections, const std::string &wanted)
    {
      const Section *by_name = nullptr;
      int            times   = 0;
      for (const Section *section : sections)
        {
          if (edit_distance(section->path(), wanted) == 0)
            return section;
          if (edit_distance(section->name(), wanted) == 0)
            {
              by_name = section;
              ++times;
            }
        }
      return times == 1 ? by_name : nullptr;
    }

    void print(const Section &section, const std::string &kind, const std::string &format)
    {
      if (format == "md")
        fmt::print("# Scenes of kind {}\n{}", kind, description_as_markdown(section));
      else
        fmt::print("# Scenes of kind {}\n{}", kind, description_as_prm(section));
    }

    /** One kind asked for: its description; otherwise a list of those of all kinds that have the section. */
    void print_json(const std::vector<nlohmann::json> &described, const bool one_kind)
    {
      fmt::print("{}\n", one_kind ? described.front().dump(2) : nlohmann::json(described).dump(2));
    }

    /** Every kind that has the section, or the one asked for. */
    int describe(const DescribeOptions &options)
    {
      std::vector<std::string>    paths;
      std::vector<nlohmann::json> described;
      bool                        shown = false;
      for (const SceneKind &kind : scene_kinds())
        {
          if (!options.kind.empty() && kind.name != options.kind)
            continue;
          const LoadedScene            scene = declare_scene(kind.name);
          std::vector<const Section *> sections;
          collect_sections(*scene.root, sections);
          for (const Section *section : sections)
            if (!section->path().empty())
              paths.push_back(section->path());
          if (const Section *wanted = find(sections, options.section))
            {
              shown = true;
              if (options.format != "json")
                {
                  print(*wanted, kind.name, options.format);
                  continue;
                }
              described.push_back(description_as_json(*wanted));
              described.back()["kind"] = kind.name;
            }
        }
      if (!shown)
        throw dem::InputError("command line: section \"" + options.section + "\" is not known. " +
                              did_you_mean(options.section, paths));
      if (options.format == "json")
        print_json(described, !options.kind.empty());
      return exit_success;
    }
  } // namespace

  void add_describe(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<DescribeOptions>();
    CLI::App  &command = *program.add_subcommand(
       "describe", "Every parameter of a scene, or of one section: meaning, unit, default, range");
    command.add_option("section", options->section, "Section, e.g. Material/CPM; default: all")->type_name("SECTION");
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
