#include "apps/commands/number_option.h"

#include "apps/scene/usual_sizes.h"
#include "apps/text/value_text.h"

#include <CLI/Error.hpp>

namespace apps
{
  CLI::Option *
  add_number_option(CLI::App &command, const NumberOption &what, double &member, const std::string &meaning)
  {
    const auto take = [what, &member](const std::string &text) {
      const auto number = number_in(list_without_units(text, what.unit));
      if (!number || !what.range.contains(*number))
        throw CLI::ValidationError(what.option, text + ": expected a number" +
                                                  (what.range.text().empty() ? "" : ", " + what.range.text()));
      const std::string question = question_about_list(what.quantity, what.unit, text);
      if (!question.empty())
        throw CLI::ValidationError(what.option, text + ": " + question);
      member = *number;
    };
    return command.add_option_function<std::string>(what.option, take, meaning);
  }
} // namespace apps
