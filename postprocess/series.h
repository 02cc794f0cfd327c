#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace postprocess
{
  struct SeriesColumn
  {
    std::string name, unit; ///< written as `name [unit]`; `-` for a pure number, empty for none (a count, a flag)
  };

  /**
   * A table that grows row by row (CSV): one header line with units, numbers in the shortest form that keeps every bit.
   *
   * Rows reach the operating system at most two seconds after append(), and with flush(). NaN and infinity are written
   * as `nan` and `inf`.
   */
  class SeriesWriter
  {
  public:
    /** Start afresh; what the file held is gone. @throws OutputError. */
    SeriesWriter(const std::filesystem::path &path, std::vector<SeriesColumn> columns);

    /**
     * Go on after an interruption: keep the first `rows` rows (those that the checkpoint knows of), drop later ones.
     * @throws dem::InputError if the file is missing, has other columns, or fewer rows; OutputError.
     */
    SeriesWriter(const std::filesystem::path &path, std::vector<SeriesColumn> columns, std::int64_t rows);

    ~SeriesWriter();
    SeriesWriter(const SeriesWriter &)            = delete;
    SeriesWriter &operator=(const SeriesWriter &) = delete;

    /** One value per column. @throws std::invalid_argument for another number of values; OutputError (disk full). */
    void append(const std::vector<double> &values);

    /** Bring all rows to the disk; call it before a checkpoint stores rows(). @throws OutputError (disk full). */
    void flush();

    std::int64_t rows() const { return row_count; } ///< in the file, header not counted

  private:
    void open(int flags);
    void write_out();

    std::filesystem::path     path;
    std::vector<SeriesColumn> columns;
    std::string               buffer;
    std::int64_t              row_count    = 0;
    double                    last_written = 0; ///< monotonic clock [s]
    int                       descriptor   = -1;
  };
} // namespace postprocess
