#include "apps/text/same_name.h"

#include <algorithm>
#include <cctype>

namespace apps
{
  bool same_name(const std::string &a, const std::string &b)
  {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const unsigned char x, const unsigned char y) { return std::tolower(x) == std::tolower(y); });
  }
} // namespace apps
