#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"
#include "apps/drivers/paths/link_path.h"
#include "apps/process/exit_status.h"
#include "apps/scene/law_block.h"
#include "apps/scene/nearest_name.h"
#include "apps/scene/overrides.h"
#include "apps/scene/reader.h"
#include "apps/scene/same_name.h"
#include "postprocess/atomic_file.h"
#include "postprocess/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace apps
{
  namespace
  {
    struct LinkTestOptions
    {
      std::string              law, path, output = "/dev/stdout";
      std::vector<std::string> constants;
    };

    const std::array<std::string, 3> path_columns = {"normal_strain", "shear_strain_1", "shear_strain_2"};

    bool has(const postprocess::CsvTable &table, const std::string &name)
    {
      return std::find(table.names.begin(), table.names.end(), name) != table.names.end();
    }

    LinkPath read_link_path(const std::string &file)
    {
      const postprocess::CsvTable table = postprocess::read_csv_table(file);
      if (table.rows() == 0)
        throw base::InputError(file + ": has no row below the names of its columns. Give one row a step.");
      const std::vector<std::string> known(path_columns.begin(), path_columns.end());
      for (const std::string &name : table.names)
        if (std::find(known.begin(), known.end(), name) == known.end())
          throw base::InputError(file + ": column \"" + name + "\" is not known. " + did_you_mean(name, known) +
                                 " Columns: normal_strain, and as wanted shear_strain_1, shear_strain_2.");
      for (const auto &column : table.columns)
        for (const double strain : column)
          if (strain < -1e3 || strain > 1e3)
            throw base::InputError(file + fmt::format(": a strain of {}: must be from -1e3 to 1e3.", strain));
      LinkPath path;
      path.normal = table.column(path_columns[0]);
      path.shear.resize(path.normal.size());
      for (std::size_t i = 0; i < 2; ++i)
        if (has(table, path_columns[i + 1]))
          for (std::size_t row = 0; row < path.shear.size(); ++row)
            path.shear[row][i] = table.column(path_columns[i + 1])[row];
      return path;
    }

    const dem::LinkLawKind &law_named(const std::string &name)
    {
      if (const dem::LinkLawKind *found = dem::find_link_law(name))
        return *found;
      std::vector<std::string> names;
      for (const auto &law : dem::link_laws())
        names.push_back(law->name());
      throw base::InputError("command line: law \"" + name + "\" is not known. " + did_you_mean(name, names));
    }

    int link_test(const LinkTestOptions &options)
    {
      const dem::LinkLawKind &law  = law_named(options.law);
      const LinkPath          path = read_link_path(options.path);
      Section                 block;
      LawBlock                entries(block);
      const auto              constants = law.constants();
      constants->visit(entries);
      assign(block, read_overrides(options.constants), "command line");
      constants->check();
      postprocess::write_text(options.output, drive(law, *constants, path).as_csv());
      return exit_success;
    }
  } // namespace

  void add_link_test(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<LinkTestOptions>();
    CLI::App  &command =
      *program.add_subcommand("link-test", "Drive one link along a strain path and write its stresses and state");
    std::string laws;
    for (const auto &law : dem::link_laws())
      laws += (laws.empty() ? "" : ", ") + law->name();
    command.add_option("--law", options->law, "Law of the link: " + laws)->required()->type_name("NAME");
    add_overrides(command, options->constants,
                  "Constant of the law, e.g. -s \"Normal modulus=25e9\"; repeatable; see \"breccia describe\"");
    command
      .add_option("--path", options->path,
                  "Strains, one row a step: CSV with the columns normal_strain, shear_strain_1, shear_strain_2 "
                  "(missing shear: 0)")
      ->required()
      ->type_name("FILE");
    command.add_option("-o,--output", options->output, "Answer, CSV; default: the terminal")->type_name("FILE");
    command.callback([options, &chosen] { chosen = [options] { return link_test(*options); }; });
  }
} // namespace apps
