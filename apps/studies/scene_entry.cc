#include "apps/studies/scene_entry.h"

namespace apps
{
  const Entry *entry_at(const Section &root, const std::string &path)
  {
    const Section *section = &root;
    std::size_t    begin   = 0;
    for (std::size_t slash; (slash = path.find('/', begin)) != std::string::npos; begin = slash + 1)
      if (!(section = section->find_section(path.substr(begin, slash - begin))))
        return nullptr;
    return section->find_entry(path.substr(begin));
  }
} // namespace apps
