#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/** Tables of numbers as text: how lines, fields, numbers and column names are read, and numbers written. */
namespace postprocess::numeric_text
{
  /** The whole file. @throws base::InputError with the system's reason. */
  std::string read_whole(const std::filesystem::path &path);

  /** The whole file, which must be plain text. @throws base::InputError also for what no text holds: zero bytes, as in UTF-16 */
  std::string read_text(const std::filesystem::path &path);

  /** @throws base::InputError "FILE, line N: MESSAGE". */
  [[noreturn]] void refuse(const std::string &origin, std::size_t line, const std::string &message);

  /** Walks over the lines of a text; line ends of every system, and a leading byte-order mark, are taken off. */
  class Lines
  {
  public:
    explicit Lines(std::string_view text);
    bool             next();                            ///< go to the next line; false after the last
    std::string_view text() const { return line_; }     ///< of this line
    std::size_t      number() const { return number_; } ///< of this line, from 1

  private:
    std::string_view rest, line_;
    std::size_t      number_ = 0;
  };

  std::string_view trimmed(std::string_view text); ///< without blanks and tabs at both ends

  /** Fields between blanks, tabs and commas; several separators in a row count as one. */
  void split(std::string_view line, std::vector<std::string_view> &fields);

  /** The number that the whole field stands for, nan and inf included; empty if it is none, or too large or small. */
  std::optional<double> number(std::string_view field);

  /** The number, finite. @throws base::InputError. */
  double finite_number(std::string_view field, const std::string &origin, std::size_t line);

  /** Append the shortest text that reads back to the same bits. */
  void append(std::string &text, double value);

  /** Three significant digits, for readers. */
  std::string rounded(double value);

  struct ColumnName
  {
    std::string name, unit; ///< `name [unit]` or `name (unit)`; unit is empty when there are no brackets
  };

  /** Column names between commas or, where the line has none, between blanks. */
  std::vector<ColumnName> column_names(std::string_view line);
} // namespace postprocess::numeric_text
