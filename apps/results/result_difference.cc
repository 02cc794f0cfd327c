#include "apps/results/result_difference.h"

#include "postprocess/files/digest.h"

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

    bool same_number(const double a, const double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

    bool is_among(const std::vector<std::string> &names, const std::string &name)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    /** Over the larger of both; of a number and none all of it. */
    double part_of(const double a, const double b, const double scale)
    {
      const double part = std::fabs(a - b) / scale;
      return std::isfinite(part) ? part : std::numeric_limits<double>::infinity();
    }

    ResultDifference only_in(const char *which, const std::string &name)
    {
      ResultDifference difference;
      difference.name = name;
      difference.only = which;
      difference.part = std::numeric_limits<double>::infinity();
      return difference;
    }

    double largest_of(const std::vector<double> &values)
    {
      double largest = 0;
      for (const double value : values)
        if (std::isfinite(value))
          largest = std::max(largest, std::fabs(value));
      return largest;
    }

    /** The row at which two columns differ most; a column without a difference gives part 0. */
    ResultDifference most(const std::vector<double> &a, const std::vector<double> &b)
    {
      ResultDifference found;
      const double     scale = std::max(largest_of(a), largest_of(b));
      for (std::size_t row = 0; row < std::min(a.size(), b.size()); ++row)
        if (!same_number(a[row], b[row]) && part_of(a[row], b[row], scale) > found.part)
          {
            found.part  = part_of(a[row], b[row], scale);
            found.first = a[row], found.second = b[row];
            found.row = static_cast<long>(row + 1);
          }
      return found;
    }

    std::vector<std::string> files_in(const std::filesystem::path &folder)
    {
      std::vector<std::string> names;
      for (const auto &entry : std::filesystem::directory_iterator(folder))
        if (entry.is_regular_file())
          names.push_back(entry.path().filename().string());
      std::sort(names.begin(), names.end());
      return names;
    }
  } // namespace

  std::vector<ResultDifference> differing_figures(const RunResult &first, const RunResult &second)
  {
    std::vector<ResultDifference>  found;
    const std::vector<std::string> names = first.figures(), others = second.figures();
    for (const std::string &name : names)
      if (!is_among(others, name))
        found.push_back(only_in("first", name));
      else
        {
          const Figure     a = first.figure(name), b = second.figure(name);
          ResultDifference difference;
          difference.name   = name;
          difference.unit   = a.unit;
          difference.first  = a.value.value_or(nothing);
          difference.second = b.value.value_or(nothing);
          if (same_number(difference.first, difference.second))
            continue;
          difference.part = part_of(difference.first, difference.second,
                                    std::max(std::fabs(difference.first), std::fabs(difference.second)));
          found.push_back(difference);
        }
    for (const std::string &name : others)
      if (!is_among(names, name))
        found.push_back(only_in("second", name));
    return found;
  }

  std::vector<ResultDifference> differing_columns(const postprocess::CsvTable &first,
                                                  const postprocess::CsvTable &second)
  {
    std::vector<ResultDifference> found;
    for (std::size_t k = 0; k < first.names.size(); ++k)
      if (!is_among(second.names, first.names[k]))
        found.push_back(only_in("first", first.names[k]));
      else
        {
          ResultDifference difference = most(first.columns[k], second.column(first.names[k]));
          difference.name             = first.names[k];
          difference.unit             = first.units[k];
          if (difference.part > 0)
            found.push_back(difference);
        }
    for (const std::string &name : second.names)
      if (!is_among(first.names, name))
        found.push_back(only_in("second", name));
    return found;
  }

  ComparedFiles compared_files(const std::filesystem::path &first, const std::filesystem::path &second)
  {
    ComparedFiles                  found;
    const std::vector<std::string> names = files_in(first), others = files_in(second);
    for (const std::string &name : names)
      if (!is_among(others, name))
        found.only_first.push_back(name);
      else
        (postprocess::digest_of_file(first / name) == postprocess::digest_of_file(second / name) ? found.same :
                                                                                                   found.other)
          .push_back(name);
    for (const std::string &name : others)
      if (!is_among(names, name))
        found.only_second.push_back(name);
    return found;
  }
} // namespace apps
