#include "apps/text/value_text.h"

#include <charconv>
#include <cmath>
#include <sstream>

namespace apps
{
  namespace
  {
    /** from_chars refuses a leading plus, which people write. */
    std::string without_plus(const std::string &text)
    {
      const std::string inner = trimmed(text);
      return inner.size() > 1 && inner[0] == '+' && inner[1] != '-' ? inner.substr(1) : inner;
    }

    template <typename Number>
    std::optional<Number> whole_text_as(const std::string &text)
    {
      const std::string inner = without_plus(text);
      const char       *end   = inner.data() + inner.size();
      Number            value{};
      const auto [stopped, error] = std::from_chars(inner.data(), end, value);
      if (error != std::errc() || stopped != end || inner.empty())
        return std::nullopt;
      return value;
    }
  } // namespace

  std::string trimmed(const std::string &text)
  {
    const char *blanks = " \t\r\n";
    const auto  first  = text.find_first_not_of(blanks);
    if (first == std::string::npos)
      return "";
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }

  std::optional<double> number_in(const std::string &text)
  {
    const auto value = whole_text_as<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
  }

  std::optional<std::int64_t> integer_in(const std::string &text) { return whole_text_as<std::int64_t>(text); }

  std::vector<std::string> comma_separated(const std::string &text)
  {
    std::vector<std::string> parts;
    if (trimmed(text).empty())
      return parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');)
      parts.push_back(trimmed(part));
    if (trimmed(text).back() == ',')
      parts.emplace_back(); // "a," has an empty second part, which nothing accepts
    return parts;
  }
} // namespace apps
