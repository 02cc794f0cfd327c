#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace postprocess
{
  /** A table of numbers with named columns, as SeriesWriter writes it and as a user hands in a load path. */
  struct CsvTable
  {
    std::vector<std::string>         names; ///< without the unit
    std::vector<std::string>         units; ///< text between brackets, empty where there is none
    std::vector<std::vector<double>> columns;
    std::string                      origin; ///< file name, for messages

    std::vector<std::vector<std::string>>
      words; ///< of columns of words, as many as columns; those of numbers stay empty

    std::size_t rows() const;
    /** @throws base::InputError that lists the columns there are. */
    const std::vector<double> &column(const std::string &name) const;
  };

  /**
   * Read a table: the first line names the columns (`name` or `name [unit]`), commas, semicolons, blanks or tabs separate, lines
   * starting with `#` are comments. The values nan and inf are accepted only on request. Columns of words are those
   * that the caller names.
   *
   * @throws base::InputError naming file and line: missing file, no header, a name twice, wrong number of values, not a
   * number.
   */
  CsvTable read_csv_table(const std::filesystem::path    &path,
                          bool                            accept_not_finite = false,
                          const std::vector<std::string> &word_columns      = {});

  /** A table of numbers as text: a header line with units, numbers in the shortest form that keeps every bit. */
  std::string csv_text(const CsvTable &table);
} // namespace postprocess
