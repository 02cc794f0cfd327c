#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** Without blanks and tabs at both ends. */
  std::string trimmed(const std::string &text);

  /** The whole text as a number; nothing if it is not one, or not finite. */
  std::optional<double> number_in(const std::string &text);

  /** The whole text as a whole number; nothing if it is not one or too large. "1e3" is not one. */
  std::optional<std::int64_t> integer_in(const std::string &text);

  /** The trimmed parts between commas; none for a blank text. */
  std::vector<std::string> comma_separated(const std::string &text);
} // namespace apps
