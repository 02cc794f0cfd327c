#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"
#include "apps/drivers/read_scene.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/scene/reader.h"
#include "apps/studies/run_study.h"

#include <fmt/format.h>

#include <memory>

namespace apps
{
  namespace
  {
    /** Every run is read; one is forecast. */
    int check_study(const SceneOptions &options)
    {
      const auto         study = read_study(options.scene, options.overrides);
      const StudyPlan    plan  = plan_of(*study);
      const CheckedScene first = read_scene(study->base_scene, plan.changes.front());
      catch_interrupts();
      fmt::print("{}: valid\n{} runs over {} factors, {} at a time. The first of them:\n{}", options.scene,
                 plan.values.rows(), plan.values.cols(), processes_of(*study, {}), first.scene->forecast());
      return exit_success;
    }

    int check(const SceneOptions &options)
    {
      use_threads(options.threads);
      if (is_study(options.scene))
        return check_study(options);
      const CheckedScene scene = read_scene(options.scene, options.overrides);
      print_notes(scene);
      catch_interrupts();
      std::string forecast;
      with_places(*scene.root, [&] { forecast = scene.scene->forecast(); });
      fmt::print("{}: valid\n{}", options.scene, forecast);
      return exit_success;
    }
  } // namespace

  void add_check(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<SceneOptions>();
    CLI::App  &command = *program.add_subcommand(
       "check", "Validate a scene; say its particles, links, steps, memory and roughly how long it takes");
    add_scene_options(command, *options);
    command.callback([options, &chosen] { chosen = [options] { return check(*options); }; });
  }
} // namespace apps
