#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fem
{
  /**
   * A Gmsh file line by line and word by word.
   *
   * Every word is read by its meaning; what is missing or wrong ends with base::InputError that says file, line, what
   * was expected and what was found.
   */
  class GmshText
  {
  public:
    explicit GmshText(const std::string &file);

    bool next();                             ///< Goes to the next line; false at the end of the file.
    void need_line(const std::string &what); ///< The same, but the end of the file is refused.

    std::string_view line() const { return current; } ///< Without blanks at its ends.
    std::size_t      number() const { return line_number; }
    std::size_t      size() const { return text.size(); } ///< Characters of the file: nothing is more numerous.

    std::int64_t integer(const std::string &what, std::int64_t least, std::int64_t most);
    double       real(const std::string &what); ///< A finite number.
    std::string  quoted(const std::string &what);
    void         end_of_line(const std::string &expected); ///< Refuses more words.

    std::string       shown() const; ///< The line in quotation marks, shortened, unprintable characters replaced.
    [[noreturn]] void refuse(const std::string &problem) const;      ///< With file and line.
    [[noreturn]] void refuse_file(const std::string &problem) const; ///< With the file only.

  private:
    std::string_view word(const std::string &what);

    std::string      file, text;
    std::string_view rest, current, words;
    std::size_t      line_number = 0;
  };
}
