#include "apps/text/name_list.h"

#include <algorithm>

namespace apps
{
  std::vector<std::string> names_in(const std::string &text)
  {
    std::vector<std::string> names;
    for (std::size_t from = 0; from < text.size();)
      {
        const std::size_t to    = std::min(text.find(',', from), text.size());
        const std::size_t first = text.find_first_not_of(' ', from), last = text.find_last_not_of(' ', to - 1);
        if (first < to)
          names.push_back(text.substr(first, last - first + 1));
        from = to + 1;
      }
    return names;
  }
} // namespace apps
