#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"
#include "apps/process/exit_status.h"
#include "apps/scene/link_driver.h"
#include "apps/scene/link_law_named.h"
#include "base/errors.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/csv_table.h"

#include <memory>

namespace apps
{
  namespace
  {
    struct LinkTestOptions
    {
      std::string              law, path, output = "/dev/stdout";
      std::vector<std::string> constants;
      dem::LinkPair            pair;
      double                   row_time = 0;
    };

    int link_test(const LinkTestOptions &options)
    {
      const dem::LinkLawKind     &law       = link_law_named(options.law);
      const postprocess::CsvTable table     = postprocess::read_csv_table(options.path);
      const auto                  constants = constants_of(law, options.constants);
      const dem::LinkHistory      answer    = drive_link(law, *constants, options.pair, table, options.row_time);
      if (!answer.columns.empty())
        postprocess::write_text(options.output, postprocess::csv_text(table_of(answer)));
      if (!answer.broke_off.empty())
        throw base::NumericalError(answer.broke_off +
                                   (answer.columns.empty() ? "" : " The rows before it are written."));
      return exit_success;
    }
  } // namespace

  void add_link_test(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<LinkTestOptions>();
    CLI::App  &command = *program.add_subcommand(
       "link-test", "Drive one link along a path of strains, displacements or forces and write its answer and state");
    std::string laws;
    for (const auto &law : dem::link_laws())
      laws += (laws.empty() ? "" : ", ") + law->name();
    command.add_option("--law", options->law, "Law of the link: " + laws)->required()->type_name("NAME");
    add_overrides(command, options->constants,
                  "Constant of the law, e.g. -s \"Normal modulus=25e9\"; repeatable; see \"breccia describe\"");
    command
      .add_option(
        "--path", options->path,
        "One row a step, CSV. Of a link of unit size: normal_strain, shear_strain_1, shear_strain_2. Of two "
        "particles: normal_displacement, shear_displacement_1, shear_displacement_2 [m], bending_1, bending_2, "
        "twist [rad], of the second against the first, or in place of any of them what is to be held: "
        "normal_force, shear_force_1, shear_force_2 [N], bending_moment_1, bending_moment_2, twisting_moment "
        "[N m], on the second (normal force: tension positive). In the plane: normal, shear 1, bending 1. What "
        "is missing is no motion")
      ->required()
      ->type_name("FILE");
    dem::LinkPair &pair     = options->pair;
    const auto     positive = CLI::Range(1e-100, 1e100);
    command.add_option("--dimension", pair.dimension, "Of displacement paths: 3, spheres; 2, discs; default 3")
      ->check(CLI::Range(2, 3));
    command.add_option("--thickness", pair.thickness, "Of discs [m]; default 1")->check(positive);
    command.add_option("--radius-1", pair.radius_1, "Of the first particle [m]; default 1e-3")->check(positive);
    command.add_option("--radius-2", pair.radius_2, "Of the second particle [m]; default 1e-3")->check(positive);
    command.add_option("--gap", pair.gap, "Between their surfaces when the link is made [m]; default 0")
      ->check(CLI::Range(-1e100, 1e100));
    command
      .add_option("--row-time", options->row_time,
                  "From row to row [s], for laws that depend on the rate; default: no time passes, as for slow paths")
      ->check(positive);
    command.add_option("-o,--output", options->output, "Answer, CSV; default: the terminal")->type_name("FILE");
    command.callback([options, &chosen] { chosen = [options] { return link_test(*options); }; });
  }
} // namespace apps
