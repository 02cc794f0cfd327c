#include "apps/commands/command.h"

namespace apps
{
  void add_run(CLI::App &program, Action &chosen);
  void add_check(CLI::App &program, Action &chosen);
  void add_describe(CLI::App &program, Action &chosen);
  void add_pack(CLI::App &program, Action &chosen);
  void add_homogenise(CLI::App &program, Action &chosen);
  void add_link_test(CLI::App &program, Action &chosen);
  void add_measure(CLI::App &program, Action &chosen);
  void add_point_test(CLI::App &program, Action &chosen);
  void add_transfer(CLI::App &program, Action &chosen);
  void add_envelope(CLI::App &program, Action &chosen);
  void add_study(CLI::App &program, Action &chosen);
  void add_invert(CLI::App &program, Action &chosen);
  void add_analyse(CLI::App &program, Action &chosen);
  void add_calibrate(CLI::App &program, Action &chosen);
  void add_report(CLI::App &program, Action &chosen);
  void add_diff(CLI::App &program, Action &chosen);
  void add_new(CLI::App &program, Action &chosen);
  void add_plot(CLI::App &program, Action &chosen);
  void add_shell(CLI::App &program, Action &chosen);
  void add_validate(CLI::App &program, Action &chosen);
  void add_bench(CLI::App &program, Action &chosen);

  const std::vector<AddCommand> &all_commands()
  {
    static const std::vector<AddCommand> commands = {
      add_run,      add_check,    add_describe, add_pack,  add_homogenise, add_link_test, add_point_test,
      add_envelope, add_transfer, add_measure,  add_study, add_analyse,    add_invert,    add_calibrate,
      add_report,   add_plot,     add_diff,     add_new,   add_validate,   add_shell,     add_bench};
    return commands;
  }
} // namespace apps
