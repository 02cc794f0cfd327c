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

  bool has_words(const std::string &name, const std::string &words)
  {
    const auto letter = [&](const std::size_t i) {
      return i < name.size() && std::isalnum(static_cast<unsigned char>(name[i]));
    };
    for (std::size_t at = 0; at + words.size() <= name.size(); ++at)
      {
        std::size_t same = 0;
        while (same < words.size() && std::tolower(static_cast<unsigned char>(name[at + same])) == words[same])
          ++same;
        if (same == words.size() && (at == 0 || !letter(at - 1)) && !letter(at + same))
          return true;
      }
    return false;
  }
} // namespace apps
