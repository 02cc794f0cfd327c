#include "apps/commands/link_law_named.h"

#include "apps/scene/nearest_name.h"
#include "base/errors.h"

#include <vector>

namespace apps
{
  const dem::LinkLawKind &link_law_named(const std::string &name)
  {
    if (const dem::LinkLawKind *found = dem::find_link_law(name))
      return *found;
    std::vector<std::string> names;
    for (const auto &law : dem::link_laws())
      names.push_back(law->name());
    throw base::InputError("command line: law \"" + name + "\" is not known. " + did_you_mean(name, names));
  }
} // namespace apps
