#include "postprocess/files/csv_table.h"

#include "base/errors.h"
#include "postprocess/files/numeric_text.h"

#include <algorithm>

namespace postprocess
{
  using namespace numeric_text;

  std::size_t CsvTable::rows() const
  {
    std::size_t most = 0;
    for (const auto &column : columns)
      most = std::max(most, column.size());
    return most;
  }

  const std::vector<double> &CsvTable::column(const std::string &name) const
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end())
      return columns[found - names.begin()];
    std::string known;
    for (const std::string &other : names)
      known += (known.empty() ? "" : ", ") + other;
    throw base::InputError(origin + ": there is no column " + name + ". Columns: " + known + ".");
  }

  namespace
  {
    void read_header(CsvTable &table, const std::string_view line, const std::size_t line_number)
    {
      for (ColumnName &column : column_names(line))
        {
          if (column.name.empty() || number(column.name))
            refuse(table.origin, line_number,
                   "the first line must name the columns, found \"" + std::string(line) + "\".");
          if (std::find(table.names.begin(), table.names.end(), column.name) != table.names.end())
            refuse(table.origin, line_number, "the column " + column.name + " is named twice.");
          table.names.push_back(std::move(column.name));
          table.units.push_back(std::move(column.unit));
        }
      table.columns.resize(table.names.size());
      table.words.resize(table.names.size());
    }

    double
    value_of(const std::string_view field, const CsvTable &table, const std::size_t line, const bool accept_not_finite)
    {
      if (accept_not_finite)
        if (const auto value = number(field))
          return *value;
      return finite_number(field, table.origin, line);
    }
  } // namespace

  CsvTable read_csv_table(const std::filesystem::path    &path,
                          const bool                      accept_not_finite,
                          const std::vector<std::string> &word_columns)
  {
    CsvTable                      table{{}, {}, {}, path.string(), {}};
    const std::string             text = read_text(path);
    std::vector<std::string_view> fields;
    for (Lines lines(text); lines.next();)
      {
        const std::string_view line = trimmed(lines.text());
        if (line.empty() || line[0] == '#')
          continue;
        if (table.names.empty())
          {
            read_header(table, line, lines.number());
            continue;
          }
        split(line, fields);
        if (fields.size() != table.names.size())
          refuse(table.origin, lines.number(),
                 "found " + std::to_string(fields.size()) + " values, expected " + std::to_string(table.names.size()) +
                   " as in the header.");
        for (std::size_t c = 0; c < fields.size(); ++c)
          if (std::find(word_columns.begin(), word_columns.end(), table.names[c]) != word_columns.end())
            table.words[c].emplace_back(fields[c]);
          else
            table.columns[c].push_back(value_of(fields[c], table, lines.number(), accept_not_finite));
      }
    if (table.names.empty())
      throw base::InputError(table.origin + ": is empty. The first line must name the columns.");
    return table;
  }

  std::string csv_text(const CsvTable &table)
  {
    std::string text;
    for (std::size_t c = 0; c < table.names.size(); ++c)
      text += (c > 0 ? "," : "") + table.names[c] + (table.units[c].empty() ? "" : " [" + table.units[c] + "]");
    text += '\n';
    for (std::size_t row = 0; row < table.rows(); ++row)
      for (std::size_t c = 0; c < table.columns.size(); ++c)
        {
          append(text, table.columns[c][row]);
          text += c + 1 < table.columns.size() ? ',' : '\n';
        }
    return text;
  }
} // namespace postprocess
