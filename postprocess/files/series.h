#pragma once

#include "postprocess/files/file_descriptor.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace postprocess
{
  struct SeriesColumn
  {
    std::string name, unit;    ///< written as `name [unit]`; `-` for a pure number, empty for none (a count, a flag)
    bool        words = false; ///< it holds words, not numbers
  };

  /**
   * A table that grows row by row (CSV): one header line with units, numbers in the shortest form that keeps every bit.
   *
   * Rows reach the file with the first append() more than two seconds after the last time, and with flush(). NaN and
   * infinity are written as nan and inf.
   */
  class SeriesWriter
  {
  public:
    /** Start afresh; what the file held is gone. @throws OutputError. */
    SeriesWriter(const std::filesystem::path &path, const std::vector<SeriesColumn> &columns);

    /**
     * Go on after an interruption: keep the first `rows` rows (those that the checkpoint knows of), drop later ones.
     * @throws base::InputError if the file has other columns or fewer rows; it is then unchanged. OutputError if it is
     * missing.
     */
    SeriesWriter(const std::filesystem::path &path, const std::vector<SeriesColumn> &columns, std::int64_t rows);

    ~SeriesWriter(); ///< writes what is left; call flush() to learn of errors

    /** One value per column. @throws std::invalid_argument for another number of values; OutputError (disk full). */
    void append(const std::vector<double> &values);
    /** The same between plain words (no comma, no quotes) in the first columns and in the last ones. */
    void append(const std::vector<std::string> &first,
                const std::vector<double>      &values,
                const std::vector<std::string> &last = {});

    /** Bring all rows to the disk; call it before a checkpoint stores rows(). @throws OutputError (disk full). */
    void flush();

    std::int64_t rows() const { return row_count; } ///< appended so far, header not counted

  private:
    void write_out();

    std::size_t                           column_count;
    std::int64_t                          row_count = 0;
    FileDescriptor                        file;
    std::string                           buffer;
    std::chrono::steady_clock::time_point last_written = std::chrono::steady_clock::now();
  };
} // namespace postprocess
