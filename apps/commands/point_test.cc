#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"
#include "apps/process/exit_status.h"
#include "apps/scene/material_driver.h"
#include "fem/points/registry.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/csv_table.h"

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
      const fem::MaterialHistory answer =
        drive_point(options.material, options.constants, postprocess::read_csv_table(options.path));
      postprocess::write_text(options.output, postprocess::csv_text(table_of(answer)));
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
