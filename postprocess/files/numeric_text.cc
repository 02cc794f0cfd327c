#include "postprocess/files/numeric_text.h"

#include "base/errors.h"
#include "postprocess/files/file_descriptor.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace postprocess::numeric_text
{
  namespace
  {
    bool is_separator(const char c) { return c == ' ' || c == '\t' || c == ',' || c == ';'; }

    /** For a message: in quotes, without what a terminal would obey, and no longer than a line. */
    std::string quoted(const std::string_view field)
    {
      constexpr std::size_t longest = 60;
      std::string           text(field.substr(0, longest));
      for (char &c : text)
        if (std::iscntrl(static_cast<unsigned char>(c)))
          c = '?';
      return '"' + text + (field.size() > longest ? "..." : "") + '"';
    }
  }

  std::string read_whole(const std::filesystem::path &path)
  {
    if (std::filesystem::is_directory(path))
      throw base::InputError(path.string() + ": is a folder, not a file.");
    errno = 0;
    std::ifstream      file(path, std::ios::binary);
    std::ostringstream text;
    if (!file || (file.peek() != std::ifstream::traits_type::eof() && !(text << file.rdbuf())))
      throw base::InputError(path.string() + ": cannot be read: " + system_reason() + ".");
    return text.str();
  }

  std::string read_text(const std::filesystem::path &path)
  {
    std::string text = read_whole(path);
    if (const std::size_t zero = text.find('\0'); zero != std::string::npos)
      refuse(path.string(), static_cast<std::size_t>(std::count(text.begin(), text.begin() + zero, '\n')) + 1,
             "holds a zero byte: this is no plain text. Save it as such (UTF-8, not UTF-16).");
    return text;
  }

  void refuse(const std::string &origin, const std::size_t line, const std::string &message)
  {
    throw base::InputError(origin + ", line " + std::to_string(line) + ": " + message);
  }

  Lines::Lines(const std::string_view text)
    : rest(text)
  {
    if (rest.substr(0, 3) == "\xEF\xBB\xBF")
      rest.remove_prefix(3);
  }

  bool Lines::next()
  {
    if (rest.empty())
      return false;
    const std::size_t end = rest.find_first_of("\r\n");
    line_                 = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + (rest.substr(end, 2) == "\r\n" ? 2 : 1));
    ++number_;
    return true;
  }

  std::string_view trimmed(std::string_view text)
  {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos)
      return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
  }

  void split(const std::string_view line, std::vector<std::string_view> &fields)
  {
    fields.clear();
    for (std::size_t i = 0; i < line.size();)
      {
        if (is_separator(line[i]))
          {
            ++i;
            continue;
          }
        const std::size_t begin = i;
        while (i < line.size() && !is_separator(line[i]))
          ++i;
        fields.push_back(line.substr(begin, i - begin));
      }
  }

  std::optional<double> number(std::string_view field)
  {
    if (field.size() > 1 && field[0] == '+' && field[1] != '-') // from_chars does not know the plus
      field.remove_prefix(1);
    double     value = 0;
    const auto end   = field.data() + field.size();
    const auto found = std::from_chars(field.data(), end, value);
    if (found.ec != std::errc() || found.ptr != end)
      return std::nullopt;
    return value;
  }

  double finite_number(const std::string_view field, const std::string &origin, const std::size_t line)
  {
    const std::optional<double> value = number(field);
    if (!value)
      refuse(origin, line, quoted(field) + " is not a number.");
    if (!std::isfinite(*value))
      refuse(origin, line, quoted(field) + ": only finite numbers are allowed.");
    return *value;
  }

  void append(std::string &text, const double value)
  {
    char       digits[32]; // the longest is -2.2250738585072014e-308
    const auto end = std::to_chars(digits, digits + sizeof(digits), value).ptr;
    text.append(digits, end);
  }

  std::string rounded(const double value)
  {
    char text[32];
    std::snprintf(text, sizeof(text), "%.3g", value);
    return text;
  }

  std::vector<ColumnName> column_names(std::string_view line)
  {
    constexpr std::string_view opening = "[(", closing = "])";
    constexpr std::string_view between = ",;";
    const bool                 commas  = line.find_first_of(between) != std::string_view::npos;
    std::vector<ColumnName>    names;
    while (!(line = trimmed(line)).empty())
      {
        std::size_t end = commas ? line.find_first_of(between) : line.find_first_of(" \t[(");
        // `name [unit]` without commas: the bracket belongs to the name before it.
        if (!commas && end != std::string_view::npos)
          if (const std::size_t next = line.find_first_not_of(" \t", end);
              next != std::string_view::npos && opening.find(line[next]) != std::string_view::npos)
            end = std::min(line.find(closing[opening.find(line[next])], next), line.size() - 1) + 1;
        const std::string_view field = trimmed(line.substr(0, end));
        line.remove_prefix(std::min(end == std::string_view::npos ? end : end + commas, line.size()));

        const std::size_t open = field.find_first_of(opening), close = field.find_last_of(closing);
        if (open == std::string_view::npos || close == std::string_view::npos || close < open)
          names.push_back({std::string(field), ""});
        else
          names.push_back(
            {std::string(trimmed(field.substr(0, open))), std::string(field.substr(open + 1, close - open - 1))});
      }
    return names;
  }
} // namespace postprocess::numeric_text
