#include "apps/scene/material_driver.h"

#include "apps/scene/constant_entries.h"
#include "apps/scene/overrides.h"
#include "apps/scene/reader.h"
#include "apps/text/column_unit.h"
#include "apps/text/nearest_name.h"
#include "apps/text/same_name.h"
#include "base/errors.h"
#include "base/voigt.h"

#include <algorithm>
#include <array>

namespace apps
{
  namespace
  {
    fem::MaterialPath material_path_of(const postprocess::CsvTable &table)
    {
      const std::string &file = table.origin;
      if (table.rows() == 0)
        throw base::InputError(file + ": has no row below the names of its columns. Give one row a step.");
      fem::MaterialPath path;
      path.origin = file;
      path.rows.assign(table.rows(), {});
      std::vector<std::string> known;
      for (const char *component : base::voigt_names)
        for (const char *quantity : {"strain_", "stress_"})
          known.push_back(std::string(quantity) + component);
      std::array<bool, 6> given{};
      for (const std::string &name : table.names)
        {
          const auto found = std::find(known.begin(), known.end(), name);
          if (found == known.end())
            throw base::InputError(file + ": column \"" + name + "\" is not known. " + did_you_mean(name, known) +
                                   " Columns: strain_xx ... strain_xy or stress_xx ... stress_xy.");
          const auto position  = static_cast<std::size_t>(found - known.begin());
          const auto component = position / 2;
          if (given[component])
            throw base::InputError(file + ": column \"" + name +
                                   "\": strain and stress of the same component cannot both be given.");
          given[component]                 = true;
          path.stress_given[component]     = position % 2 == 1;
          const auto                place  = static_cast<std::size_t>(&name - table.names.data());
          const std::vector<double> values = column_in(table, place, position % 2 == 1 ? "Pa" : "-");
          for (std::size_t row = 0; row < path.rows.size(); ++row)
            path.rows[row][component] = values[row];
        }
      return path;
    }

    const fem::MaterialKind &material_named(const std::string &name)
    {
      std::vector<std::string> names;
      for (const auto &kind : fem::material_kinds())
        {
          if (same_name(kind->name(), name))
            return *kind;
          names.push_back(kind->name());
        }
      throw base::InputError("command line: material \"" + name + "\" is not known. " + did_you_mean(name, names));
    }
  } // namespace

  fem::MaterialHistory
  drive_point(const std::string &material, const std::vector<std::string> &constants, const postprocess::CsvTable &path)
  {
    const auto              chosen = material_named(material).constants();
    const fem::MaterialPath rows   = material_path_of(path);
    Section                 entries;
    chosen->visit(ConstantEntries{entries});
    assign(entries, read_overrides(constants), "command line");
    return fem::drive(*chosen, rows);
  }
} // namespace apps
