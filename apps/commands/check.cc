#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"
#include "apps/forecasts/duration.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/progress.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/kinds/seeds.h"
#include "apps/scene/reader.h"
#include "apps/studies/calibration_runs.h"
#include "apps/studies/child_runs.h"
#include "apps/studies/run_study.h"
#include "base/errors.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <omp.h>

#include <memory>

namespace apps
{
  namespace
  {
    struct CheckOptions : SceneOptions
    {
      std::size_t ranks = 0; ///< among which particles are to be shared out; 0: not requested
    };

    /** The first line of a forecast that says how long a run takes, in seconds; 0: none does. */
    double seconds_of_run(const CheckedScene &scene, std::string &forecast)
    {
      with_places(*scene.root, [&] { forecast = scene.scene->forecast(); });
      return duration_in(forecast).value_or(0);
    }

    std::string together_line(const double seconds, const int at_a_time)
    {
      return seconds > 0 ?
               fmt::format("  altogether   roughly {}, {} at a time\n", duration_text(seconds / at_a_time), at_a_time) :
               "";
    }

    /** Every run is read; one is forecast. */
    int check_study(const SceneOptions &options)
    {
      const auto         study = read_study(options.scene, options.overrides);
      const StudyPlan    plan  = plan_of(*study);
      const CheckedScene first = read_scene(study->base_scene, plan.changes.front());
      catch_interrupts();
      std::string  forecast;
      const double seconds = seconds_of_run(first, forecast);
      fmt::print("{}: valid\n{} runs over {} factors, {} at a time. The first of them:\n{}{}", options.scene,
                 plan.values.rows(), plan.values.cols(), processes_of(*study, {}), forecast,
                 together_line(seconds * static_cast<double>(plan.values.rows()), processes_of(*study, {})));
      return exit_success;
    }

    /** Every scene is forecast; how many sets it takes is unknown beforehand; the most is known. */
    int check_calibration(const SceneOptions &options)
    {
      const auto      file = read_calibration(options.scene, options.overrides);
      StudyOptions    none;
      CalibrationRuns runs(*file, none);
      catch_interrupts();
      fmt::print("{}: valid\n{} constants, {} targets; {} runs for each set of constants, at most {} sets{}\n",
                 options.scene, file->constants.size(), file->targets.size(), runs.runs_of_a_set(), file->most_runs,
                 file->posterior.runs > 0 ? fmt::format(" and {} for the posterior", file->posterior.runs) : "");
      double seconds = 0;
      for (const auto &[scene, changes] : runs.scenes_at_start())
        {
          std::string forecast;
          seconds += seconds_of_run(read_scene(scene, changes), forecast);
          fmt::print("{}\n{}", scene, forecast);
        }
      const auto sets = static_cast<double>(file->most_runs + file->posterior.runs);
      fmt::print("{}", together_line(sets * seconds * static_cast<double>(runs.runs_of_a_set()) /
                                       static_cast<double>(runs.scenes_at_start().size()),
                                     runs.together()));
      return exit_success;
    }

    void print_replicates(const CheckedScene &scene, const double seconds)
    {
      const SharedThreads shared = shared_threads(omp_get_max_threads(), scene.replicates);
      std::string         seeds;
      for (const SceneSeed &seed : seeds_in_use(*scene.root))
        seeds += (seeds.empty() ? "" : ", ") + seed.entry;
      fmt::print("  replicates   {}, with {} of their own\n{}", scene.replicates, seeds,
                 together_line(seconds * static_cast<double>(scene.replicates), shared.runs));
    }

    void refuse_ranks(const CheckOptions &options, const char *what)
    {
      if (options.ranks > 0)
        throw base::InputError(
          fmt::format("{}: --ranks: shares are reported of one scene; this is a {} of many. Check the "
                      "scene that it runs.",
                      options.scene, what));
    }

    int check(const CheckOptions &options)
    {
      use_threads(options.threads);
      const FileOf kind = kind_of_file(options.scene);
      if (kind == FileOf::study)
        {
          refuse_ranks(options, "study");
          return check_study(options);
        }
      if (kind == FileOf::calibration)
        {
          refuse_ranks(options, "calibration");
          return check_calibration(options);
        }
      const CheckedScene scene = read_scene(options.scene, options.overrides);
      print_notes(scene);
      catch_interrupts();
      std::string forecast;
      with_places(*scene.root, [&] {
        forecast = options.ranks > 0 ? scene.scene->forecast_over(options.ranks) : scene.scene->forecast();
      });
      fmt::print("{}: valid\n{}", options.scene, forecast);
      if (scene.replicates > 1)
        print_replicates(scene, duration_in(forecast).value_or(0));
      return exit_success;
    }
  } // namespace

  void add_check(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<CheckOptions>();
    CLI::App  &command = *program.add_subcommand(
       "check", "Validate a scene; say its particles, links, steps, memory and roughly how long it takes");
    add_scene_options(command, *options);
    command
      .add_option("--ranks", options->ranks,
                  "Say too how its particles would be shared out among so many ranks, and what that would cost")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
    command.callback([options, &chosen] { chosen = [options] { return check(*options); }; });
  }
} // namespace apps
