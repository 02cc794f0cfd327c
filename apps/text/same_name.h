#pragma once

#include <string>

namespace apps
{
  /** Equal but for case: so are sections, entries, kinds, laws and other words of the program found. */
  bool same_name(const std::string &a, const std::string &b);

  /** Whether these words, in small letters, stand in a name as whole words, its capital letters or not. */
  bool has_words(const std::string &name, const std::string &words);
} // namespace apps
