#include "apps/scene/link_law_named.h"

#include "apps/scene/law_block.h"
#include "apps/scene/overrides.h"
#include "apps/scene/reader.h"
#include "apps/text/nearest_name.h"
#include "base/errors.h"

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

  std::shared_ptr<dem::LinkConstants> constants_of(const dem::LinkLawKind &law, const std::vector<std::string> &texts)
  {
    auto     constants = law.constants();
    Section  block;
    LawBlock entries(block);
    constants->visit(entries);
    assign(block, read_overrides(texts), "command line");
    constants->check();
    return constants;
  }
} // namespace apps
