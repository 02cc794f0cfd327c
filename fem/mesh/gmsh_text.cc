#include "fem/mesh/gmsh_text.h"

#include "base/errors.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace fem
{
  namespace
  {
    constexpr const char *blanks          = " \t\r";
    constexpr const char *byte_order_mark = "\xEF\xBB\xBF"; // which some editors put before a text

    std::string_view trimmed(const std::string_view line)
    {
      const std::size_t first = line.find_first_not_of(blanks);
      return first == std::string_view::npos ? std::string_view() :
                                               line.substr(first, line.find_last_not_of(blanks) - first + 1);
    }

    std::string readable(const std::string_view words)
    {
      constexpr std::size_t longest = 60;
      std::string           shown;
      for (const char c : words.substr(0, longest))
        shown += std::isprint(static_cast<unsigned char>(c)) ? c : '?';
      return '"' + shown + (words.size() > longest ? "..." : "") + '"';
    }
  }

  GmshText::GmshText(const std::string &file_)
    : file(file_)
  {
    std::ifstream in(file, std::ios::binary);
    if (!in || std::filesystem::is_directory(file))
      throw base::InputError(file + ": cannot be read. Give the path of a Gmsh file (.msh).");
    std::ostringstream all;
    all << in.rdbuf();
    text = all.str();
    rest = text;
    if (rest.substr(0, 3) == byte_order_mark)
      rest.remove_prefix(3);
  }

  bool GmshText::next()
  {
    if (rest.empty())
      return false;
    const std::size_t end = rest.find('\n');
    current = words = trimmed(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    ++line_number;
    return true;
  }

  void GmshText::need_line(const std::string &what)
  {
    if (!next())
      refuse_file("ends after line " + std::to_string(line_number) + ", where " + what +
                  " is expected: it is cut off.");
  }

  std::string_view GmshText::word(const std::string &what)
  {
    const std::size_t first = words.find_first_not_of(blanks);
    if (first == std::string_view::npos)
      refuse("the line ends where " + what + " is expected; it is " + shown() + ".");
    words.remove_prefix(first);
    const std::string_view found = words.substr(0, words.find_first_of(blanks));
    words.remove_prefix(found.size());
    return found;
  }

  std::int64_t GmshText::integer(const std::string &what, const std::int64_t least, const std::int64_t most)
  {
    const std::string_view found = word(what);
    std::int64_t           value = 0;
    const auto             end   = std::from_chars(found.data(), found.data() + found.size(), value);
    if (end.ec != std::errc() || end.ptr != found.data() + found.size() || value < least || value > most)
      refuse("expected " + what + ", a whole number from " + std::to_string(least) + " to " + std::to_string(most) +
             ", found " + readable(found) + ".");
    return value;
  }

  double GmshText::real(const std::string &what)
  {
    const std::string_view found = word(what);
    double                 value = 0;
    const auto             end   = std::from_chars(found.data(), found.data() + found.size(), value);
    if (end.ec != std::errc() || end.ptr != found.data() + found.size() || !std::isfinite(value))
      refuse("expected " + what + ", a number, found " + readable(found) + ".");
    return value;
  }

  std::string GmshText::quoted(const std::string &what)
  {
    const std::size_t open = words.find('"'), close = words.rfind('"');
    if (open == std::string_view::npos || close == open)
      refuse("expected " + what + " in quotation marks, found " + shown() + ".");
    const std::string_view found = words.substr(open + 1, close - open - 1);
    words.remove_prefix(words.size());
    return std::string(found);
  }

  void GmshText::end_of_line(const std::string &expected)
  {
    if (words.find_first_not_of(blanks) != std::string_view::npos)
      refuse("expected " + expected + ", found " + shown() + ".");
  }

  std::string GmshText::shown() const { return readable(current); }

  void GmshText::refuse(const std::string &problem) const
  {
    throw base::InputError(file + ", line " + std::to_string(line_number) + ": " + problem);
  }

  void GmshText::refuse_file(const std::string &problem) const { throw base::InputError(file + ": " + problem); }
}
