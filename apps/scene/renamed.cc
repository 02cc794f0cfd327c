#include "apps/scene/renamed.h"

#include "apps/text/same_name.h"
#include "apps/text/value_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace apps
{
  namespace
  {
    /** Any name, of sections that a scene names itself. */
    const std::string any = "*";

    /** A section, or an entry, by its whole path: before and since version 0.1. */
    struct Renamed
    {
      std::vector<std::string> sections;
      std::string              before, now;
      bool                     section;
    };

    const std::array<Renamed, 4> &renamed()
    {
      static const std::array<Renamed, 4> all = {{
        {{}, "Gauges", "Probes", true},
        {{"Particles"}, "Gauges", "Probes", true},
        {{"Particles", "Impact"}, "Striker radius", "Impactor radius", false},
        {{"Particles", "Impact"}, "Striker velocities", "Impactor velocities", false},
      }};
      return all;
    }

    /** A word that entries take, alone or in a list between commas, or how it ends: before and since version 0.1. */
    struct RenamedWord
    {
      std::vector<std::string> sections;
      std::string              entry, before, now;
      bool                     ending = false;
    };

    const std::array<RenamedWord, 8> &renamed_words()
    {
      static const std::array<RenamedWord, 8> all = {{
        {{"Handshakes", any}, "Method", "slaved", "constrained"},
        {{"Waves"}, "Methods", "slaved", "constrained"},
        {{"Output"}, "Curve horizontal", "_made", "_spurious", true},
        {{"Output"}, "Curve vertical", "_made", "_spurious", true},
        {{"Output"}, "Curve horizontal", "_made_by_contacts", "_spurious_of_contacts", true},
        {{"Output"}, "Curve vertical", "_made_by_contacts", "_spurious_of_contacts", true},
        {{"Output"}, "Curve horizontal", "_twice", "_double_counted", true},
        {{"Output"}, "Curve vertical", "_twice", "_double_counted", true},
      }};
      return all;
    }

    bool same_sections(const std::vector<std::string> &sections, const std::vector<std::string> &renamed)
    {
      return std::equal(sections.begin(), sections.end(), renamed.begin(), renamed.end(),
                        [](const std::string &a, const std::string &b) { return b == any || same_name(a, b); });
    }

    /** The present word in the place of the one before; nothing where it is another. */
    std::optional<std::string> present_word(const std::string &word, const RenamedWord &renamed)
    {
      const std::string &before = renamed.before;
      const std::size_t  kept   = renamed.ending && word.size() > before.size() ? word.size() - before.size() : 0;
      if (!same_name(word.substr(kept), before) || (renamed.ending && kept == 0))
        return {};
      return word.substr(0, kept) + renamed.now;
    }

    /** Put present words into a list; one without any stays as it is written. @return whether there was one */
    bool replace_words(std::string &list, const RenamedWord &renamed)
    {
      std::string joined;
      bool        found = false;
      for (const std::string &word : comma_separated(list))
        {
          const auto now = present_word(word, renamed);
          found          = found || now;
          joined += (joined.empty() ? "" : ", ") + now.value_or(word);
        }
      if (found)
        list = joined;
      return found;
    }

    /** The name in an assignment that stands where the renamed one stood; nullptr: none does. */
    std::string *name_in(Assignment &assignment, const Renamed &one)
    {
      const std::size_t depth = one.sections.size();
      if (one.section ? assignment.sections.size() <= depth : assignment.sections.size() != depth)
        return nullptr;
      for (std::size_t k = 0; k < depth; ++k)
        if (!same_name(assignment.sections[k], one.sections[k]))
          return nullptr;
      std::string &name = one.section ? assignment.sections[depth] : assignment.entry;
      return same_name(name, one.before) ? &name : nullptr;
    }
  } // namespace

  std::vector<std::string> use_present_names(std::vector<Assignment> &assignments)
  {
    std::vector<std::string> notes;
    const auto               note = [&notes](const Assignment &assignment, const char *what, const std::string &before,
                               const std::string &now) {
      notes.push_back(assignment.place.text() + ": " + what + " \"" + before + "\" is called \"" + now +
                                    "\" now; the old name is read in this version only.");
    };
    for (const Renamed &one : renamed())
      {
        bool noted = false;
        for (Assignment &assignment : assignments)
          if (std::string *const name = name_in(assignment, one))
            {
              if (!noted)
                note(assignment, one.section ? "section" : "entry", one.before, one.now);
              noted = true;
              *name = one.now;
            }
      }
    for (const RenamedWord &word : renamed_words())
      for (Assignment &assignment : assignments)
        if (same_name(assignment.entry, word.entry) && same_sections(assignment.sections, word.sections) &&
            replace_words(assignment.value, word))
          note(assignment, "word", word.before, word.now);
    return notes;
  }
} // namespace apps
