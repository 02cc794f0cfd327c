#include "postprocess/files/series.h"

#include "base/errors.h"
#include "postprocess/files/errors.h"
#include "postprocess/files/numeric_text.h"

#include <fcntl.h>

#include <stdexcept>

namespace postprocess
{
  namespace
  {
    std::string header_line(const std::vector<SeriesColumn> &columns)
    {
      std::string header;
      for (const SeriesColumn &column : columns)
        {
          header += (header.empty() ? "" : ",") + column.name;
          if (!column.unit.empty())
            header += " [" + column.unit + "]";
        }
      return header + "\n";
    }

    /** Length of the header and the first rows of a series, once it is sure that they are there. */
    std::size_t bytes_to_keep(const std::filesystem::path &path, const std::string &header, const std::int64_t rows)
    {
      const std::string text = numeric_text::read_whole(path);
      if (text.compare(0, header.size(), header) != 0)
        throw base::InputError(path.string() +
                               ": its header is not that of this run, which cannot go on with it. Expected: " +
                               header.substr(0, header.size() - 1));
      std::size_t end = header.size();
      for (std::int64_t row = 0; row < rows; ++row)
        {
          const std::size_t line_end = text.find('\n', end);
          if (line_end == std::string::npos)
            throw base::InputError(path.string() + ": holds " + std::to_string(row) +
                                   " rows, the checkpoint knows of " + std::to_string(rows) +
                                   ". It was changed or cut short; start the run afresh.");
          end = line_end + 1;
        }
      return end;
    }
  } // namespace

  SeriesWriter::SeriesWriter(const std::filesystem::path &path, const std::vector<SeriesColumn> &columns)
    : column_count(columns.size())
    , file(path, O_WRONLY | O_CREAT | O_TRUNC)
    , buffer(header_line(columns))
  {
    write_out();
  }

  SeriesWriter::SeriesWriter(const std::filesystem::path     &path,
                             const std::vector<SeriesColumn> &columns,
                             const std::int64_t               rows)
    : column_count(columns.size())
    , row_count(rows)
    , file(path, O_WRONLY)
  {
    file.shorten(bytes_to_keep(path, header_line(columns), rows));
  }

  SeriesWriter::~SeriesWriter()
  {
    try
      {
        write_out();
      }
    catch (const OutputError &)
      {
        // Too late to report a failure: callers that need to know call flush().
      }
  }

  void SeriesWriter::append(const std::vector<double> &values) { append({}, values); }

  void SeriesWriter::append(const std::vector<std::string> &first,
                            const std::vector<double>      &values,
                            const std::vector<std::string> &last)
  {
    const std::size_t given = first.size() + values.size() + last.size();
    if (given != column_count)
      throw std::invalid_argument("SeriesWriter::append: " + std::to_string(given) + " values for " +
                                  std::to_string(column_count) + " columns");
    std::string row;
    const auto  add_word = [&row](const std::string &word) {
      if (word.find_first_of(",\"\n") != std::string::npos)
        throw std::invalid_argument("SeriesWriter::append: \"" + word + "\" is not a plain word");
      row += word + ',';
    };
    for (const std::string &word : first)
      add_word(word);
    for (const double value : values)
      {
        numeric_text::append(row, value);
        row += ',';
      }
    for (const std::string &word : last)
      add_word(word);
    if (!row.empty())
      row.back() = '\n';
    buffer += row;
    ++row_count;
    if (std::chrono::steady_clock::now() - last_written > std::chrono::seconds(2))
      write_out();
  }

  void SeriesWriter::flush()
  {
    write_out();
    file.sync();
  }

  void SeriesWriter::write_out()
  {
    file.write(buffer);
    buffer.clear();
    last_written = std::chrono::steady_clock::now();
  }
} // namespace postprocess
