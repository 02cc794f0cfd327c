#include "apps/studies/table_selection.h"

#include "base/errors.h"
#include "postprocess/files/csv_table.h"
#include "postprocess/files/numeric_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace apps
{
  namespace
  {
    using namespace postprocess::numeric_text;

    std::vector<ColumnName> header_of(const std::filesystem::path &file)
    {
      const std::string text = read_text(file);
      for (Lines lines(text); lines.next();)
        if (const std::string_view line = postprocess::numeric_text::trimmed(lines.text());
            !line.empty() && line[0] != '#')
          return column_names(line);
      throw base::InputError(file.string() + ": is empty. The first line must name the columns.");
    }

    /** The name in the file of a column requested with or without its unit. */
    std::string
    column_named(const std::filesystem::path &file, const std::vector<ColumnName> &header, const std::string &requested)
    {
      std::vector<std::string> known, without_unit;
      for (const ColumnName &column : header)
        {
          if (column.name == requested)
            return requested;
          known.push_back(column.name);
          if (column_title(column.name).name == requested)
            without_unit.push_back(column.name);
        }
      if (without_unit.size() == 1)
        return without_unit.front();
      throw base::InputError(fmt::format("{}: there is {} column {}. Columns: {}.", file.string(),
                                         without_unit.empty() ? "no" : "more than one", requested,
                                         fmt::join(known, ", ")));
    }

    void refuse_repeated(const std::filesystem::path &file, std::vector<std::string> columns)
    {
      std::sort(columns.begin(), columns.end());
      const auto twice = std::adjacent_find(columns.begin(), columns.end());
      if (twice != columns.end())
        throw base::InputError(file.string() + ": the column " + *twice + " is given twice.");
    }

    /** Everything that the table says of a run but its number. */
    std::string whole_row(const postprocess::CsvTable &table, const std::size_t row)
    {
      std::string text;
      for (std::size_t column = 0; column < table.names.size(); ++column)
        if (table.names[column] != "run")
          text += table.words[column].empty() ? fmt::format("{},", table.columns[column][row]) :
                                                table.words[column][row] + ',';
      return text;
    }

    std::size_t place_of(const postprocess::CsvTable &table, const std::string &column)
    {
      return std::find(table.names.begin(), table.names.end(), column) - table.names.begin();
    }

    /** Rows whose response is a number; the others are remembered by their run. */
    std::vector<int> rows_with_response(TableSelection                 &selection,
                                        const postprocess::CsvTable    &table,
                                        const std::vector<std::string> &factors,
                                        const std::vector<double>      &response)
    {
      const std::size_t numbers = place_of(table, "run");
      std::vector<int>  rows;
      for (std::size_t row = 0; row < table.rows(); ++row)
        {
          const std::string run = numbers < table.names.size() ? table.words[numbers][row] : std::to_string(row + 1);
          if (!std::isfinite(response[row]))
            {
              selection.left_out.push_back(run);
              continue;
            }
          for (const std::string &factor : factors)
            if (!std::isfinite(table.column(factor)[row]))
              throw base::InputError(fmt::format("{}: run {}: {} is not a finite number.", table.origin, run, factor));
          rows.push_back(static_cast<int>(row));
          selection.runs.push_back(run);
        }
      if (rows.empty())
        throw base::InputError(table.origin + ": no run has the response " + selection.response + ".");
      return rows;
    }

    /** In brackets of the head, or at the end of the name. */
    std::string unit_of(const postprocess::CsvTable &table, const std::string &column)
    {
      const std::string in_head = table.units[place_of(table, column)];
      return in_head.empty() ? column_title(column).unit : in_head;
    }

    Eigen::VectorXd picked(const std::vector<double> &column, const std::vector<int> &rows)
    {
      return Eigen::Map<const Eigen::VectorXd>(column.data(), column.size())(rows);
    }
  } // namespace

  ColumnTitle column_title(const std::string &column)
  {
    static const std::vector<std::string> units = {"Pa", "kPa", "MPa", "GPa", "kN", "MN",  "kJ", "mm",     "cm",
                                                   "um", "kg",  "deg", "rad", "Hz", "kHz", "ms", "percent"};
    const std::size_t                     last  = column.rfind('_');
    if (last != std::string::npos && last > 0)
      if (const std::string unit = column.substr(last + 1); std::find(units.begin(), units.end(), unit) != units.end())
        return {column.substr(0, last), unit};
    return {column, ""};
  }

  TableSelection
  select(const std::filesystem::path &file, const std::string &response, const std::vector<std::string> &factors)
  {
    const std::vector<ColumnName> header = header_of(file);
    std::vector<std::string>      requested;
    for (const std::string &factor : factors)
      requested.push_back(column_named(file, header, factor));
    const std::string target = column_named(file, header, response);
    requested.push_back(target);
    refuse_repeated(file, requested);
    std::vector<std::string> others;
    for (const ColumnName &column : header)
      if (std::find(requested.begin(), requested.end(), column.name) == requested.end())
        others.push_back(column.name);
    const postprocess::CsvTable table = postprocess::read_csv_table(file, true, others);
    requested.pop_back();

    TableSelection selection;
    selection.file              = file;
    selection.response          = column_title(target).name;
    selection.response_unit     = unit_of(table, target);
    const std::vector<int> rows = rows_with_response(selection, table, requested, table.column(target));
    selection.values            = picked(table.column(target), rows);
    for (const std::string &factor : requested)
      {
        selection.factors.push_back({column_title(factor).name, picked(table.column(factor), rows)});
        selection.factor_units.push_back(unit_of(table, factor));
      }
    std::map<std::string, int> first;
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (const auto [found, is_new] = first.emplace(whole_row(table, rows[k]), static_cast<int>(k)); !is_new)
        selection.copies.emplace_back(static_cast<int>(k), found->second);
    return selection;
  }
} // namespace apps
