#include "apps/scene/reader.h"

#include "apps/scene/absent.h"
#include "apps/text/nearest_name.h"
#include "apps/text/value_text.h"

#include <algorithm>
#include <map>

namespace apps
{
  namespace
  {
    /** " of section "Loading/Tension"", or "" at the top. */
    std::string inside(const Section &section)
    {
      return section.path().empty() ? "" : " in section \"" + section.path() + "\"";
    }

    /** Paths of all entries with this very name, wherever they are. */
    void collect_paths(const Section &section, const std::string &entry, std::vector<std::string> &paths)
    {
      if (section.find_entry(entry))
        paths.push_back(section.path_of(entry));
      for (const auto &subsection : section.sections())
        collect_paths(*subsection, entry, paths);
    }

    Section &section_of(Section &root, const Assignment &assignment)
    {
      Section *section = &root;
      for (const std::string &name : assignment.sections)
        {
          Section *next = section->open_section(name, assignment.place);
          if (!next)
            {
              const std::string answer = absent(name);
              throw base::InputError(assignment.place.text() + ": section \"" +
                                     (section->path().empty() ? "" : section->path() + "/") + name +
                                     "\" is not known. " +
                                     (answer.empty() ? did_you_mean_or_known(name, section->section_names()) : answer));
            }
          section = next;
        }
      return *section;
    }

    /** Where more entries are known than a message may list. */
    std::string hint_for(const Section &section)
    {
      return section.path().empty() ? "`breccia describe` lists what there is." :
                                      "`breccia describe " + section.name() + "` lists what there is.";
    }

    [[noreturn]] void refuse_unknown(const Section &root, const Section &section, const Assignment &assignment)
    {
      std::string              message = assignment.place.text() + ": \"" + assignment.path() + "\" is not known. ";
      std::vector<std::string> elsewhere;
      collect_paths(root, assignment.entry, elsewhere);
      // What does not exist here may be a constant of something else; that is meant only where it lies further in.
      const auto further_in = [&](const std::string &path) { return path.rfind(section.path(), 0) == 0; };
      if (const std::string answer = absent(assignment.entry);
          !answer.empty() && std::none_of(elsewhere.begin(), elsewhere.end(), further_in))
        message += answer;
      else if (const std::string here = did_you_mean(assignment.entry, section.entry_names());
               !here.empty() && std::none_of(elsewhere.begin(), elsewhere.end(), further_in))
        message += here;
      else if (!elsewhere.empty())
        message += "Did you mean \"" + elsewhere.front() + "\"?";
      else if (!section.entries().empty())
        message += did_you_mean_or_known(assignment.entry, section.entry_names(), hint_for(section));
      else
        message += "There is no entry" + inside(section) + ". " +
                   did_you_mean_or_known(assignment.entry, section.section_names());
      throw base::InputError(message);
    }

    /** "25 GPa" for a number in Pa. */
    bool has_other_unit(const Entry &entry, const std::string &value)
    {
      const std::size_t blank = value.find(' ');
      return entry.type == "number" && !entry.unit.empty() && blank != std::string::npos &&
             number_in(value.substr(0, blank)) && value.substr(blank + 1) != entry.unit;
    }

    void store(const Section &section, Entry &entry, const Assignment &assignment)
    {
      const std::string wrong = entry.store(assignment.value, assignment.place);
      if (!wrong.empty())
        throw base::InputError(assignment.place.text() + ": " + section.path_of(entry.name) + " = " +
                               (assignment.value.empty() ? "(nothing)" : assignment.value) + ": " + wrong +
                               (entry.unit.empty() || entry.unit == "-" ? "" : " [" + entry.unit + "]") +
                               (has_other_unit(entry, assignment.value) ? ", alone or with this unit behind it" : "") +
                               ". Meaning: " + entry.meaning + ".");
      entry.value = assignment.value;
      entry.place = assignment.place;
      entry.set   = true;
    }

    /** What has to be set and is not. */
    struct Missing
    {
      std::string name, meaning;
    };

    void collect_missing(const Section &section, std::vector<Missing> &missing)
    {
      if (!section.needed())
        return;
      for (const auto &entry : section.entries())
        if (entry->required && !entry->set && entry->needed())
          missing.push_back(
            {"\"" + section.path_of(entry->name) + "\"" + (entry->unit.empty() ? "" : " [" + entry->unit + "]"),
             entry->meaning + (entry->allowed.empty() ? "" : "; " + entry->allowed) + "."});
      for (const auto &subsection : section.sections())
        collect_missing(*subsection, missing);
    }

    /** All in one message, a line for each of several. */
    void refuse_missing(const Section &section, const std::string &source)
    {
      std::vector<Missing> missing;
      collect_missing(section, missing);
      if (missing.empty())
        return;
      if (missing.size() == 1)
        throw base::InputError(source + ": " + missing.front().name +
                               " is not set and has no default. Meaning: " + missing.front().meaning);
      std::string lines;
      for (const Missing &one : missing)
        lines += "\n  " + one.name + ": " + one.meaning;
      throw base::InputError(source + ": " + std::to_string(missing.size()) +
                             " entries are not set and have no default:" + lines);
    }
  } // namespace

  void assign(Section &root, const std::vector<Assignment> &assignments, const std::string &source)
  {
    // All names first: a misspelt key explains a "missing" one.
    std::vector<std::pair<const Section *, Entry *>> targets;
    std::map<const Entry *, Place>                   first_of_file;
    for (const Assignment &assignment : assignments)
      {
        const Section &section = section_of(root, assignment);
        Entry         *entry   = assignment.opens_section() ? nullptr : section.find_entry(assignment.entry);
        if (!entry && !assignment.opens_section())
          refuse_unknown(root, section, assignment);
        targets.emplace_back(&section, entry);
        if (entry && !assignment.place.file.empty()) // two spellings of one name; the command line may say it again
          if (const auto [first, fresh] = first_of_file.emplace(entry, assignment.place); !fresh)
            throw base::InputError(assignment.place.text() + ": \"" + assignment.path() +
                                   "\" is set a second time; first in line " + std::to_string(first->second.line) +
                                   ". Keep one of them.");
      }
    for (std::size_t i = 0; i < assignments.size(); ++i)
      if (targets[i].second)
        store(*targets[i].first, *targets[i].second, assignments[i]);
    refuse_missing(root, source);
  }

  void with_places(const Section &root, const std::function<void()> &work)
  {
    try
      {
        work();
      }
    catch (const base::EntryError &refused)
      {
        const Section *section = &root;
        for (const std::string &name : refused.sections)
          if (section != nullptr)
            section = section->find_section(name);
        if (section == nullptr)
          throw base::InputError(refused.what());
        if (!refused.entry.empty())
          section->refuse(refused.entry, refused.rule);
        const Section *opened = section; // what has a fixed name is where the first of its parts is
        while (opened->place().line == 0 && !opened->sections().empty())
          opened = opened->sections().front().get();
        throw base::InputError(opened->place().text() + ": " + section->path() + refused.separator + refused.rule);
      }
  }
} // namespace apps
