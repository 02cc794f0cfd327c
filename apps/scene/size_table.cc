#include "apps/scene/size_table.h"

#include "apps/scene/value_text.h"
#include "base/errors.h"
#include "postprocess/csv_table.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    /** Smallest and largest diameter of "1e-3" or "1e-3-2e-3"; a minus within a number stands behind its e. */
    bool read_diameters(const std::string &text, dem::SizeClass &to)
    {
      for (std::size_t at = 1; at < text.size(); ++at)
        if (text[at] == '-' && text[at - 1] != 'e' && text[at - 1] != 'E')
          {
            const auto low = number_in(text.substr(0, at)), high = number_in(text.substr(at + 1));
            to.smallest = low.value_or(0);
            to.largest  = high.value_or(0);
            return low && high;
          }
      const auto only = number_in(text);
      to.smallest = to.largest = only.value_or(0);
      return only.has_value();
    }
  } // namespace

  std::vector<dem::SizeClass> size_classes_in_text(const std::string &text)
  {
    std::vector<dem::SizeClass> classes;
    for (const std::string &part : comma_separated(text))
      {
        const std::size_t colon = part.find(':');
        dem::SizeClass    one;
        const auto        fraction = number_in(trimmed(part.substr(std::min(colon, part.size() - 1) + 1)));
        if (colon == std::string::npos || !fraction || !read_diameters(trimmed(part.substr(0, colon)), one))
          throw base::InputError("\"" + part + "\": expected diameter: fraction, or smallest-largest: fraction.");
        one.fraction = *fraction;
        classes.push_back(one);
      }
    return classes;
  }

  namespace
  {
    bool has_column(const postprocess::CsvTable &table, const char *name)
    {
      return std::find(table.names.begin(), table.names.end(), name) != table.names.end();
    }

    /** A column of lengths in metres. */
    std::vector<double> lengths_of(const postprocess::CsvTable &table, const char *name)
    {
      std::vector<double> values = table.column(name);
      const auto          place =
        static_cast<std::size_t>(std::find(table.names.begin(), table.names.end(), name) - table.names.begin());
      const std::string &unit = table.units.at(place);
      if (!unit.empty() && unit != "m" && unit != "mm")
        throw base::InputError(table.origin + ": column " + name + " is in [" + unit + "]: expected [m] or [mm].");
      for (double &value : values)
        value *= unit == "mm" ? 1e-3 : 1.0;
      return values;
    }

    std::vector<dem::SizeClass> between_sieves(const postprocess::CsvTable &table)
    {
      const std::vector<double>   size = lengths_of(table, "size"), &passing = table.column("passing");
      std::vector<dem::SizeClass> classes;
      if (size.size() < 2 || passing.front() != 0 || passing.back() != 1)
        throw base::InputError(table.origin + ": column passing goes from 0 (nothing is finer) to 1 (all is).");
      for (std::size_t i = 1; i < size.size(); ++i)
        {
          if (!(size[i] > size[i - 1] && passing[i] >= passing[i - 1]))
            throw base::InputError(table.origin + ": row " + std::to_string(i + 1) + ": size and passing must ascend.");
          if (passing[i] > passing[i - 1])
            classes.push_back({passing[i] - passing[i - 1], size[i - 1], size[i]});
        }
      return classes;
    }
  } // namespace

  std::vector<dem::SizeClass> size_classes_in_file(const std::string &file)
  {
    const postprocess::CsvTable table = postprocess::read_csv_table(file);
    if (has_column(table, "passing"))
      return between_sieves(table);
    const bool                single = has_column(table, "diameter");
    const std::vector<double> low    = lengths_of(table, single ? "diameter" : "smallest"),
                              high   = lengths_of(table, single ? "diameter" : "largest");
    std::vector<dem::SizeClass> classes;
    for (std::size_t i = 0; i < low.size(); ++i)
      classes.push_back({table.column("fraction")[i], low[i], high[i]});
    return classes;
  }
} // namespace apps
