#include "apps/scene/renamed.h"

#include "apps/text/same_name.h"

#include <array>
#include <cstddef>

namespace apps
{
  namespace
  {
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
    for (const Renamed &one : renamed())
      {
        bool noted = false;
        for (Assignment &assignment : assignments)
          if (std::string *const name = name_in(assignment, one))
            {
              if (!noted)
                notes.push_back(assignment.place.text() + ": " + (one.section ? "section" : "entry") + " \"" +
                                one.before + "\" is called \"" + one.now +
                                "\" now; the old name is read in this version only.");
              noted = true;
              *name = one.now;
            }
      }
    return notes;
  }
} // namespace apps
