#include "apps/scene/link_driver.h"

#include "apps/text/column_unit.h"
#include "apps/text/nearest_name.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace apps
{
  namespace
  {
    const std::array<std::string, 3> path_columns = {"normal_strain", "shear_strain_1", "shear_strain_2"};

    bool has(const postprocess::CsvTable &table, const std::string &name)
    {
      return std::find(table.names.begin(), table.names.end(), name) != table.names.end();
    }

    std::vector<std::string> all_columns()
    {
      std::vector<std::string> known(path_columns.begin(), path_columns.end());
      for (const dem::LinkMotionName &name : dem::link_motion_names)
        known.insert(known.end(), {name.motion, name.force});
      return known;
    }

    void check_columns(const postprocess::CsvTable &table)
    {
      if (table.rows() == 0)
        throw base::InputError(table.origin + ": has no row below the names of its columns. Give one row a step.");
      const std::vector<std::string> known = all_columns();
      for (const std::string &name : table.names)
        if (std::find(known.begin(), known.end(), name) == known.end())
          throw base::InputError(table.origin + ": column \"" + name + "\" is not known. " + did_you_mean(name, known) +
                                 " Columns: normal_strain, and as wanted shear_strain_1, shear_strain_2; or "
                                 "normal_displacement and what else \"breccia link-test --help\" lists.");
    }

    bool is_of_strains(const postprocess::CsvTable &table)
    {
      return std::any_of(path_columns.begin(), path_columns.end(),
                         [&](const std::string &name) { return has(table, name); });
    }

    /** A column in its unit; the table has it. */
    std::vector<double> values_of(const postprocess::CsvTable &table, const std::string &name, const std::string &unit)
    {
      const auto at = std::find(table.names.begin(), table.names.end(), name) - table.names.begin();
      return column_in(table, static_cast<std::size_t>(at), unit);
    }

    std::vector<double> strains_in(const postprocess::CsvTable &table, const std::string &name)
    {
      std::vector<double> strains = values_of(table, name, "-");
      for (const double strain : strains)
        if (!(std::fabs(strain) <= 1e3))
          throw base::InputError(table.origin + fmt::format(": a strain of {}: must be from -1e3 to 1e3.", strain));
      return strains;
    }

    dem::LinkPath strains_of(const postprocess::CsvTable &table)
    {
      for (const std::string &name : table.names)
        if (std::find(path_columns.begin(), path_columns.end(), name) == path_columns.end())
          throw base::InputError(table.origin + ": column \"" + name +
                                 "\": strains and displacements do not go together in one path.");
      table.column(path_columns[0]); // refuses a table without it
      dem::LinkPath path;
      path.normal = strains_in(table, path_columns[0]);
      path.shear.resize(path.normal.size());
      for (std::size_t i = 0; i < 2; ++i)
        if (has(table, path_columns[i + 1]))
          {
            const std::vector<double> shear = strains_in(table, path_columns[i + 1]);
            for (std::size_t row = 0; row < path.shear.size(); ++row)
              path.shear[row][i] = shear[row];
          }
      return path;
    }

    dem::LinkMotionPath
    motions_of(const postprocess::CsvTable &table, const dem::LinkPair &pair, const double per_second)
    {
      const double        size = pair.radius_1 + pair.radius_2;
      dem::LinkMotionPath path;
      path.rows       = table.rows();
      path.per_second = per_second;
      for (int c = 0; c < dem::LinkMotionPath::components; ++c)
        {
          const dem::LinkMotionName &name = dem::link_motion_names[c];
          auto                      &part = path.component[c];
          if (has(table, name.motion) && has(table, name.force))
            throw base::InputError(table.origin + ": columns \"" + name.motion + "\" and \"" + name.force +
                                   "\": give one of them.");
          part.force = has(table, name.force);
          if (!part.force && !has(table, name.motion))
            continue;
          part.values =
            values_of(table, part.force ? name.force : name.motion, part.force ? name.force_unit : name.unit);
          const double limit = c < 3 ? 1e3 * size : 1e3;
          for (const double value : part.values)
            if (!part.force && !(std::fabs(value) < limit && (c > 0 || value > -0.9 * size - pair.gap)))
              throw base::InputError(table.origin + fmt::format(": {} {} of particles of {} m and {} m: out of range.",
                                                                name.motion, value, pair.radius_1, pair.radius_2));
        }
      return path;
    }
  } // namespace

  dem::LinkHistory drive_link(const dem::LinkLawKind      &law,
                              const dem::LinkConstants    &constants,
                              const dem::LinkPair         &pair,
                              const postprocess::CsvTable &path,
                              const double                 row_time)
  {
    check_columns(path);
    const double per_second = row_time > 0 ? 1 / row_time : 0.0;
    return is_of_strains(path) ? dem::drive(law, constants, strains_of(path), per_second) :
                                 dem::drive(law, constants, pair, motions_of(path, pair, per_second));
  }

  postprocess::CsvTable table_of(const dem::LinkHistory &history)
  {
    postprocess::CsvTable table;
    for (const auto &column : history.columns)
      {
        table.names.push_back(column.name);
        table.units.push_back(column.unit);
        table.columns.push_back(column.values);
      }
    return table;
  }
} // namespace apps
