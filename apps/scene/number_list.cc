#include "apps/scene/number_list.h"

#include "apps/scene/usual_sizes.h"

namespace apps
{
  Entry &declare_list(
    Section &section, const std::string &entry, std::string &member, const std::string &unit, const Need need)
  {
    Entry &added = section.text(entry, member, need);
    added.store  = [&member, entry, unit](const std::string &text, const Place &) -> std::string {
      const std::string question = question_about_list(entry, unit, text);
      if (question.empty())
        member = list_without_units(text, unit);
      return question;
    };
    return added;
  }
} // namespace apps
