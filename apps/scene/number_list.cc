#include "apps/scene/number_list.h"

#include "apps/scene/usual_sizes.h"
#include "apps/text/name_list.h"
#include "apps/text/value_text.h"

#include <fmt/format.h>

#include <utility>

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

  Entry &declare_numbers(Section             &section,
                         const std::string   &entry,
                         std::vector<double> &member,
                         const std::string   &unit,
                         const std::string   &expected,
                         const Need           need)
  {
    std::string text  = fmt::format("{}", fmt::join(member, ", "));
    Entry      &added = section.text(entry, text, need); // its store does not outlive this
    added.store       = [&member, entry, unit, expected](const std::string &written, const Place &) -> std::string {
      std::vector<double> numbers;
      for (const std::string &part : comma_separated(list_without_units(written, unit)))
        {
          const auto number = number_in(part);
          if (!number)
            return "expected " + expected + ", separated by commas";
          numbers.push_back(*number);
        }
      const std::string question = question_about_list(entry, unit, written);
      if (question.empty())
        member = std::move(numbers);
      return question;
    };
    return added;
  }

  Entry &declare_names(Section &section, const std::string &entry, std::vector<std::string> &member, const Need need)
  {
    std::string text  = fmt::format("{}", fmt::join(member, ", "));
    Entry      &added = section.text(entry, text, need); // its store does not outlive this
    added.store       = [&member](const std::string &written, const Place &) -> std::string {
      member = names_in(written);
      return "";
    };
    return added;
  }
} // namespace apps
