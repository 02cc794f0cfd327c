#include "apps/scene/kinds/read_scene.h"

#include "apps/scene/description.h"
#include "apps/scene/kinds/kinds.h"
#include "apps/scene/kinds/seeds.h"
#include "apps/scene/overrides.h"
#include "apps/scene/parameter_file.h"
#include "apps/scene/reader.h"
#include "apps/scene/renamed.h"
#include "apps/text/nearest_name.h"
#include "apps/text/same_name.h"
#include "apps/text/time_table.h"
#include "apps/text/value_text.h"
#include "postprocess/files/digest.h"

#include <filesystem>

namespace apps
{
  namespace
  {
    const SceneKind *find_kind(const std::string &name)
    {
      for (const SceneKind &kind : scene_kinds())
        if (same_name(kind.name, name))
          return &kind;
      return nullptr;
    }

    std::vector<std::string> kind_names()
    {
      std::vector<std::string> names;
      for (const SceneKind &kind : scene_kinds())
        names.push_back(kind.name);
      return names;
    }

    std::string kinds_in_words()
    {
      std::string words;
      for (const SceneKind &kind : scene_kinds())
        words += (words.empty() ? "" : ", ") + kind.name + " (" + kind.meaning + ")";
      return words;
    }

    [[noreturn]] void refuse_unknown_kind(const std::string &named, const std::string &name)
    {
      const std::string meant = did_you_mean(name, kind_names());
      throw base::InputError(named + " is not known. " + meant + (meant.empty() ? "" : " ") +
                             "Known kinds: " + kinds_in_words() + ".");
    }

    /** The last word on "Kind", which decides what else may stand in a scene. */
    Assignment *kind_in(std::vector<Assignment> &assignments)
    {
      Assignment *found = nullptr;
      for (Assignment &assignment : assignments)
        if (assignment.sections.empty() && same_name(assignment.entry, "Kind"))
          found = &assignment;
      return found;
    }

    CheckedScene declared(const SceneKind &kind)
    {
      CheckedScene read;
      read.kind  = kind.name;
      read.root  = std::make_unique<Section>();
      read.scene = kind.create();
      return read;
    }

    /** Entries that every kind has, and then its own. The strings must already be where they stay. */
    void declare_all(CheckedScene &read)
    {
      read.root->text("Kind", read.kind, Need::optional).means("What the scene computes: " + kinds_in_words());
      read.root->text("Output folder", read.output_folder, Need::optional)
        .means("Where the results go (option -o), from the current folder")
        .housekeeping();
      read.scene->declare(*read.root);
      if (has_seed(*read.root))
        read.root->integer("Replicates", read.replicates, "", Range::between(1, 1000), Need::optional)
          .means(
            "Runs of the scene, the first with its seeds, each further one with all seeds one larger; with several, "
            "results are their mean and scatter (breccia run)")
          .housekeeping();
      Section *const output = read.root->find_section("Output");
      (output ? *output : read.root->section("Output", "What is written"))
        .flag("Report", read.report)
        .means("A page of the results for a browser, report.html, with the scene and the files that it names in it: "
               "breccia run report.html gives the same bits again")
        .housekeeping();
    }

    void refuse_equal_replicates(const CheckedScene &read)
    {
      if (read.replicates > 1 && seeds_in_use(*read.root).empty())
        read.root->refuse("Replicates", "nothing of this scene is drawn by a seed, and all would be equal.");
    }

    /** The kinds, but for this one, that have a section of this name. */
    std::string kinds_with(const std::string &section, const std::string &but)
    {
      std::string kinds;
      for (const SceneKind &kind : scene_kinds())
        if (kind.name != but)
          {
            CheckedScene other = declared(kind);
            declare_all(other);
            if (other.root->find_section(section))
              kinds += (kinds.empty() ? "" : ", ") + kind.name;
          }
      return kinds;
    }

    /** A section of other kinds is no misspelt one of this. */
    void refuse_of_other_kinds(const CheckedScene &read, const std::vector<Assignment> &assignments)
    {
      for (const Assignment &assignment : assignments)
        {
          if (assignment.sections.empty() || read.root->find_section(assignment.sections.front()))
            continue;
          const std::string &name  = assignment.sections.front();
          const std::string  kinds = kinds_with(name, read.kind);
          if (!kinds.empty())
            throw base::InputError(assignment.place.text() + ": section \"" + name + "\" is not in scenes of kind " +
                                   read.kind + ", only in those of kind " + kinds + ".");
        }
    }

    /** The files that an entry names, from the current folder. */
    std::vector<std::filesystem::path> files_of(const Entry &entry)
    {
      std::vector<std::filesystem::path> files;
      if (entry.type == "file")
        files.push_back((std::filesystem::path(entry.place.file).parent_path() / entry.value).lexically_normal());
      if (const auto table = entry.type == "formula" ? table_in(entry.value) : std::nullopt)
        files.push_back((std::filesystem::path(entry.place.file).parent_path() / table->file).lexically_normal());
      if (entry.type == "list of files")
        for (const std::string &name : comma_separated(entry.value))
          files.emplace_back(name);
      return files;
    }

    void add_inputs(const Section &section, std::vector<InputFile> &inputs)
    {
      if (!section.needed())
        return;
      std::error_code none; // a file that is missing is refused where it is read
      for (const auto &entry : section.entries())
        if (entry->set && entry->needed())
          for (const std::filesystem::path &file : files_of(*entry))
            if (std::filesystem::is_regular_file(file, none))
              inputs.push_back({section.path_of(entry->name), file.string(), std::filesystem::file_size(file),
                                postprocess::digest_of_file(file)});
      for (const auto &subsection : section.sections())
        add_inputs(*subsection, inputs);
    }
  } // namespace

  CheckedScene read_scene(const std::string &file, const std::vector<std::string> &overrides)
  {
    std::vector<Assignment> assignments = read_parameter_file(file);
    for (Assignment &assignment : read_overrides(overrides))
      assignments.push_back(std::move(assignment));
    const std::vector<std::string> notes = use_present_names(assignments);

    Assignment *named = kind_in(assignments);
    if (!named)
      throw base::InputError(file + ": \"Kind\" is not set and has no default. Known kinds: " + kinds_in_words() + ".");
    const SceneKind *kind = find_kind(named->value);
    if (!kind)
      refuse_unknown_kind(named->place.text() + ": Kind = " + named->value, named->value);

    named->value       = kind->name; // whatever its case
    CheckedScene read  = declared(*kind);
    read.file          = file;
    read.overrides     = overrides;
    read.notes         = notes;
    read.output_folder = "output/" + std::filesystem::path(file).stem().string();
    declare_all(read);
    refuse_of_other_kinds(read, assignments);
    assign(*read.root, assignments, file);
    refuse_equal_replicates(read);
    with_places(*read.root, [&] { read.scene->check(); });
    return read;
  }

  CheckedScene declare_scene(const std::string &name)
  {
    const SceneKind *kind = find_kind(name);
    if (!kind)
      refuse_unknown_kind("command line: kind \"" + name + "\"", name);
    CheckedScene read  = declared(*kind);
    read.output_folder = "output/NAME";
    declare_all(read);
    read.root->open_placeholders();
    return read;
  }

  RunRequest request_of(const CheckedScene &scene)
  {
    RunRequest request;
    request.output_folder = scene.output_folder;
    request.scene_file    = scene.file;
    request.scene_text    = completed_scene(*scene.root, Completed::everything);
    request.deciding_text = completed_scene(*scene.root, Completed::what_decides_results);
    request.inputs        = inputs_of(*scene.root);
    return request;
  }

  std::vector<InputFile> inputs_of(const Section &root)
  {
    std::vector<InputFile> inputs;
    add_inputs(root, inputs);
    return inputs;
  }
} // namespace apps
