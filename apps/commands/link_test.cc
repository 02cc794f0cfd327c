#include "apps/commands/command.h"
#include "apps/commands/link_law_named.h"
#include "apps/commands/scene_options.h"
#include "apps/process/exit_status.h"
#include "apps/text/nearest_name.h"
#include "apps/text/same_name.h"
#include "dem/loading/link_motion.h"
#include "dem/loading/link_path.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
      double                   seconds = 0; ///< from row to row
    };

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

    postprocess::CsvTable read_path_table(const std::string &file)
    {
      const postprocess::CsvTable table = postprocess::read_csv_table(file);
      if (table.rows() == 0)
        throw base::InputError(file + ": has no row below the names of its columns. Give one row a step.");
      const std::vector<std::string> known = all_columns();
      for (const std::string &name : table.names)
        if (std::find(known.begin(), known.end(), name) == known.end())
          throw base::InputError(file + ": column \"" + name + "\" is not known. " + did_you_mean(name, known) +
                                 " Columns: normal_strain, and as wanted shear_strain_1, shear_strain_2; or "
                                 "normal_displacement and what else \"breccia link-test --help\" lists.");
      return table;
    }

    bool is_of_strains(const postprocess::CsvTable &table)
    {
      return std::any_of(path_columns.begin(), path_columns.end(),
                         [&](const std::string &name) { return has(table, name); });
    }

    dem::LinkPath strains_of(const postprocess::CsvTable &table)
    {
      for (std::size_t c = 0; c < table.names.size(); ++c)
        {
          if (std::find(path_columns.begin(), path_columns.end(), table.names[c]) == path_columns.end())
            throw base::InputError(table.origin + ": column \"" + table.names[c] +
                                   "\": strains and displacements do not go together in one path.");
          for (const double strain : table.columns[c])
            if (strain < -1e3 || strain > 1e3)
              throw base::InputError(table.origin + fmt::format(": a strain of {}: must be from -1e3 to 1e3.", strain));
        }
      dem::LinkPath path;
      path.normal = table.column(path_columns[0]);
      path.shear.resize(path.normal.size());
      for (std::size_t i = 0; i < 2; ++i)
        if (has(table, path_columns[i + 1]))
          for (std::size_t row = 0; row < path.shear.size(); ++row)
            path.shear[row][i] = table.column(path_columns[i + 1])[row];
      return path;
    }

    void demand_unit(const postprocess::CsvTable &table, const std::string &name, const std::string &unit)
    {
      const auto        c     = std::find(table.names.begin(), table.names.end(), name) - table.names.begin();
      const std::string given = table.units[static_cast<std::size_t>(c)];
      if (!given.empty() && given != unit)
        throw base::InputError(
          fmt::format("{}: column \"{}\" is in [{}]: must be in [{}].", table.origin, name, given, unit));
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
          demand_unit(table, part.force ? name.force : name.motion, part.force ? name.force_unit : name.unit);
          part.values        = table.column(part.force ? name.force : name.motion);
          const double limit = c < 3 ? 1e3 * size : 1e3;
          for (const double value : part.values)
            if (!part.force && !(std::fabs(value) < limit && (c > 0 || value > -0.9 * size - pair.gap)))
              throw base::InputError(table.origin + fmt::format(": {} {} of particles of {} m and {} m: out of range.",
                                                                name.motion, value, pair.radius_1, pair.radius_2));
        }
      return path;
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

    int link_test(const LinkTestOptions &options)
    {
      const dem::LinkLawKind     &law        = link_law_named(options.law);
      const postprocess::CsvTable table      = read_path_table(options.path);
      const auto                  constants  = constants_of(law, options.constants);
      const double                per_second = options.seconds > 0 ? 1 / options.seconds : 0.0;
      const dem::LinkHistory      answer =
        is_of_strains(table) ? dem::drive(law, *constants, strains_of(table), per_second) :
                                    dem::drive(law, *constants, options.pair, motions_of(table, options.pair, per_second));
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
      .add_option("--row-time", options->seconds,
                  "From row to row [s], for laws that depend on the rate; default: no time passes, as for slow paths")
      ->check(positive);
    command.add_option("-o,--output", options->output, "Answer, CSV; default: the terminal")->type_name("FILE");
    command.callback([options, &chosen] { chosen = [options] { return link_test(*options); }; });
  }
} // namespace apps
