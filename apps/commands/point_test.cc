#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"
#include "apps/process/exit_status.h"
#include "apps/scene/constant_entries.h"
#include "apps/scene/overrides.h"
#include "apps/scene/reader.h"
#include "apps/text/nearest_name.h"
#include "apps/text/same_name.h"
#include "base/voigt.h"
#include "fem/points/material_path.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace apps
{
  namespace
  {
    struct PointTestOptions
    {
      std::string              material, path, output = "/dev/stdout";
      std::vector<std::string> constants;
    };

    fem::MaterialPath read_material_path(const std::string &file)
    {
      const postprocess::CsvTable table = postprocess::read_csv_table(file);
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
          given[component]             = true;
          path.stress_given[component] = position % 2 == 1;
          for (std::size_t row = 0; row < path.rows.size(); ++row)
            path.rows[row][component] = table.column(name)[row];
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

    postprocess::CsvTable table_of(const fem::MaterialHistory &history)
    {
      postprocess::CsvTable table;
      table.names = history.names;
      table.units = history.units;
      table.columns.resize(table.names.size());
      for (const std::vector<double> &row : history.rows)
        for (std::size_t c = 0; c < row.size(); ++c)
          table.columns[c].push_back(row[c]);
      return table;
    }

    int point_test(const PointTestOptions &options)
    {
      const auto              constants = material_named(options.material).constants();
      const fem::MaterialPath path      = read_material_path(options.path);
      Section                 entries;
      constants->visit(ConstantEntries{entries});
      assign(entries, read_overrides(options.constants), "command line");
      postprocess::write_text(options.output, postprocess::csv_text(table_of(fem::drive(*constants, path))));
      return exit_success;
    }
  } // namespace

  void add_point_test(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<PointTestOptions>();
    CLI::App  &command = *program.add_subcommand(
       "point-test", "Drive one material point along a path of strains and stresses and write its answer");
    std::string materials;
    for (const auto &kind : fem::material_kinds())
      materials += (materials.empty() ? "" : ", ") + kind->name();
    command.add_option("--material", options->material, "Material: " + materials)->required()->type_name("NAME");
    add_overrides(command, options->constants, "Constant of the material, e.g. -s \"Young modulus=30e9\"; repeatable");
    command
      .add_option(
        "--path", options->path,
        "One row a step: CSV with the columns strain_xx ... strain_xy (order xx yy zz yz zx xy, engineering shear) or "
        "stress_xx ... [Pa]; a component without a column keeps zero strain")
      ->required()
      ->type_name("FILE");
    command.add_option("-o,--output", options->output, "Answer, CSV; default: the terminal")->type_name("FILE");
    command.callback([options, &chosen] { chosen = [options] { return point_test(*options); }; });
  }
} // namespace apps
