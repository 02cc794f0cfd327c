#include "apps/commands/command.h"
#include "apps/process/exit_status.h"
#include "apps/scene/absent.h"
#include "apps/scene/description.h"
#include "apps/scene/kinds/kinds.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/studies/calibration_file.h"
#include "apps/studies/study_file.h"
#include "apps/text/nearest_name.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

namespace apps
{
  namespace
  {
    struct DescribeOptions
    {
      std::vector<std::string> words;
      std::string              wanted, kind, format = "prm"; ///< wanted: the words, with blanks between
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

    bool mentions(const std::string &text, const std::string &wanted)
    {
      return in_lower_case(text).find(in_lower_case(wanted)) != std::string::npos;
    }

    /** Where a word may stand that is no name, best first. */
    enum class Mention
    {
      in_name,
      in_value,
      in_meaning,
      word_by_word ///< of several words each somewhere else
    };

    constexpr Mention mentions_by_rank[] = {Mention::in_name, Mention::in_value, Mention::in_meaning,
                                            Mention::word_by_word};

    bool mentions_each_word(const std::string &text, const std::string &wanted)
    {
      std::istringstream words(wanted);
      return std::all_of(std::istream_iterator<std::string>(words), {},
                         [&text](const std::string &word) { return mentions(text, word); });
    }

    /** The best place at which an entry has the word. */
    std::optional<Mention> mention_in(const Entry &entry, const std::string &wanted)
    {
      if (mentions(entry.name, wanted))
        return Mention::in_name;
      if (mentions(entry.value, wanted) || mentions(entry.allowed, wanted))
        return Mention::in_value;
      if (mentions(entry.meaning, wanted))
        return Mention::in_meaning;
      if (mentions_each_word(entry.name + ' ' + entry.value + ' ' + entry.allowed + ' ' + entry.meaning, wanted))
        return Mention::word_by_word;
      return {};
    }

    void
    collect_mentions(const Section &section, const std::string &wanted, const Mention where, std::vector<Match> &found)
    {
      for (const auto &entry : section.entries())
        if (mention_in(*entry, wanted) == where)
          found.push_back({&section, entry.get()});
      for (const auto &subsection : section.sections())
        collect_mentions(*subsection, wanted, where, found);
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

    void add_words(const std::string &text, std::set<std::string> &words)
    {
      constexpr std::size_t telling = 4; // letters; shorter ones are like too many others
      std::string           word;
      for (const char c : text + ' ')
        if (std::isalpha(static_cast<unsigned char>(c)) != 0)
          word += c;
        else
          {
            if (word.size() >= telling)
              words.insert(in_lower_case(word));
            word.clear();
          }
    }

    /** Those of what is said of entries: they are searched too. */
    void collect_words(const Section &section, std::set<std::string> &words)
    {
      for (const auto &entry : section.entries())
        for (const std::string &text : {entry->value, entry->allowed, entry->meaning})
          add_words(text, words);
      for (const auto &subsection : section.sections())
        collect_words(*subsection, words);
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

    /** Each kind has itself as the default of Kind; but for that all of them say the same of it. */
    std::string without_own_kind(std::string text, const std::string &own, const std::string &instead)
    {
      if (const auto at = text.find(own); at != std::string::npos)
        text.replace(at, own.size(), instead);
      return text;
    }

    Passage in_markdown(const Match &match, const std::string &kind)
    {
      const std::string path = match.section->path();
      std::string       text = description_as_markdown(*match.section, match.entry);
      if (path.empty()) // a table begins after an empty line
        text = "\n" + without_own_kind(text, "| Kind |  | " + kind + " |", "| Kind |  | required |");
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

    /** What is found, in the words of each format. */
    struct Found
    {
      std::vector<Passage>        passages;
      std::vector<nlohmann::json> objects;
    };

    void add(Found &all, const std::vector<Match> &matches, const std::string &kind, const std::string &format)
    {
      if (format == "md")
        for (const Match &match : matches)
          add(all.passages, in_markdown(match, kind));
      else
        for (const Match &match : outermost(matches))
          {
            std::string text = description_as_prm(*match.section, match.entry);
            if (match.entry && match.section->path().empty())
              text = without_own_kind(text, "set Kind = " + kind + "\n", "set Kind =\n");
            add(all.passages, {match.section->path(), text, kind});
            all.objects.push_back(description_as_json(*match.section, match.entry));
            all.objects.back()["kind"] = kind;
          }
    }

    /** What has entries: scenes of each kind, studies and calibrations. */
    struct Described
    {
      std::string           kind;
      const Section        *root;
      std::shared_ptr<void> holds; ///< the owner of the section
    };

    template <typename File>
    Described described(const std::string &kind, std::unique_ptr<File> file)
    {
      file->root->open_placeholders();
      const Section *root = file->root.get();
      return {kind, root, std::shared_ptr<File>(std::move(file))};
    }

    std::vector<Described> all_described(const std::string &only)
    {
      std::vector<Described> all;
      for (const SceneKind &kind : scene_kinds())
        if (only.empty() || kind.name == only)
          all.push_back(described(kind.name, std::make_unique<CheckedScene>(declare_scene(kind.name))));
      if (only.empty() || only == "study")
        all.push_back(described("study", declare_study()));
      if (only.empty() || only == "calibration")
        all.push_back(described("calibration", declare_calibration()));
      return all;
    }

    /** All of the kind of that name; sections and entries of the name; if none has it, entries that speak of it, the best first. */
    Found find(const std::vector<Described> &scenes, const DescribeOptions &options)
    {
      Found all;
      for (const bool is_kind : {true, false})
        for (const Described &scene : scenes)
          if ((scene.kind == options.wanted) == is_kind)
            {
              std::vector<Match> matches;
              collect(*scene.root, is_kind ? "" : options.wanted, matches);
              add(all, matches, scene.kind, options.format);
            }
      if (!all.passages.empty() || !absent(options.wanted).empty())
        return all;
      for (const Mention where : mentions_by_rank)
        for (const Described &scene : scenes)
          {
            std::vector<Match> matches;
            collect_mentions(*scene.root, options.wanted, where, matches);
            add(all, matches, scene.kind, options.format);
          }
      return all;
    }

    [[noreturn]] void refuse_unknown(const std::vector<Described> &scenes, const std::string &wanted)
    {
      std::vector<std::string> names;
      std::set<std::string>    words;
      for (const Described &scene : scenes)
        {
          collect_names(*scene.root, names);
          collect_words(*scene.root, words);
        }
      names.insert(names.end(), words.begin(), words.end());
      const std::string answer = absent(wanted), nearest = nearest_spelling(wanted, names);
      throw base::InputError("command line: there is no section or entry \"" + wanted + "\"" +
                             (!answer.empty() ? ". " + answer :
                              nearest.empty() ? ", and none speaks of it." :
                                                ". Did you mean \"" + nearest + "\"?"));
    }

    /** Sections and entries of all kinds, or of the requested one. */
    int describe(const DescribeOptions &options)
    {
      const std::vector<Described> scenes = all_described(options.kind);
      const Found                  found  = find(scenes, options);
      if (found.passages.empty())
        refuse_unknown(scenes, options.wanted);
      if (options.format == "json")
        fmt::print("{}\n", (found.objects.size() == 1 && !options.kind.empty() ? found.objects.front() :
                                                                                 nlohmann::json(found.objects))
                             .dump(2));
      else if (options.format == "md")
        print_markdown(found.passages, options.wanted.empty() && options.kind.empty());
      else
        print_prm(found.passages);
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
        "name", options->words,
        "Section or entry by its name or the end of its path, e.g. Damping, Tension, Loading/Tension; a kind, "
        "e.g. study; words that are no name are sought in names, values and texts, e.g. triaxial; default: all")
      ->type_name("NAME");
    std::vector<std::string> kinds;
    for (const SceneKind &kind : scene_kinds())
      kinds.push_back(kind.name);
    kinds.insert(kinds.end(), {"study", "calibration"});
    command.add_option("--kind", options->kind, "Only scenes of this kind; default: all kinds")
      ->check(CLI::IsMember(kinds));
    command.add_option("--format", options->format, "prm (default), json or md (Markdown)")
      ->check(CLI::IsMember({"prm", "json", "md"}));
    command.callback([options, &chosen] {
      options->wanted = fmt::format("{}", fmt::join(options->words, " "));
      chosen          = [options] { return describe(*options); };
    });
  }
} // namespace apps
