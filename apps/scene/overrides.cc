#include "apps/scene/overrides.h"

#include "apps/text/value_text.h"
#include "base/errors.h"

#include <sstream>

namespace apps
{
  std::vector<Assignment> read_overrides(const std::vector<std::string> &texts)
  {
    std::vector<Assignment> found;
    for (const std::string &text : texts)
      {
        const auto  equals = text.find('=');
        Assignment  added;
        std::string part;
        for (std::istringstream path(text.substr(0, equals)); std::getline(path, part, '/');)
          added.sections.push_back(trimmed(part));
        if (equals == std::string::npos || added.sections.empty() || added.sections.back().empty())
          throw base::InputError("command line: -s \"" + text + "\": expected \"Section/Key=value\".");
        added.entry = added.sections.back();
        added.sections.pop_back();
        added.value = trimmed(text.substr(equals + 1));
        found.push_back(std::move(added));
      }
    return found;
  }
} // namespace apps
