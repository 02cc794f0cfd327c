#include "apps/scene/kinds/seeds.h"

#include "apps/text/value_text.h"

namespace apps
{
  namespace
  {
    constexpr const char *seed_entry = "Seed";

    void collect_seeds(const Section &section, std::vector<SceneSeed> &found)
    {
      if (!section.needed())
        return;
      if (const Entry *seed = section.find_entry(seed_entry); seed && seed->needed())
        found.push_back({section.path_of(seed->name), static_cast<std::int64_t>(number_in(seed->value).value())});
      for (const auto &subsection : section.sections())
        collect_seeds(*subsection, found);
    }
  } // namespace

  bool has_seed(const Section &root)
  {
    if (root.find_entry(seed_entry))
      return true;
    for (const auto &subsection : root.sections())
      if (has_seed(*subsection))
        return true;
    return false;
  }

  std::vector<SceneSeed> seeds_in_use(const Section &root)
  {
    std::vector<SceneSeed> found;
    collect_seeds(root, found);
    return found;
  }
} // namespace apps
