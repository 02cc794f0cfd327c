#include "apps/scene/number_list.h"

#include "apps/scene/usual_sizes.h"
#include "apps/text/name_list.h"
#include "apps/text/value_text.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <utility>

namespace apps
{
  Entry &declare_list(Section                                 &section,
                      const std::string                       &entry,
                      std::function<void(const std::string &)> read,
                      const std::string                       &unit,
                      const Need                               need)
  {
    std::string text;
    Entry      &added = section.text(entry, text, need); // its store does not outlive this
    added.store = [read = std::move(read), entry, unit](const std::string &written, const Place &) -> std::string {
      const std::string question = question_about_list(entry, unit, written);
      if (!question.empty())
        return question;
      try
        {
          read(list_without_units(written, unit));
        }
      catch (const base::InputError &refused)
        {
          std::string message = refused.what();
          if (!message.empty() && message.back() == '.') // the sentence goes on with what the entry means
            message.pop_back();
          return message;
        }
      return "";
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
