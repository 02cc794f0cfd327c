#include "apps/commands/command.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/results/result_folder.h"
#include "apps/results/warning.h"
#include "apps/studies/inversion_report.h"
#include "apps/text/value_text.h"
#include "base/errors.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/html_page.h"
#include "postprocess/files/summary.h"
#include "postprocess/pictures/plot.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <memory>

namespace apps
{
  namespace
  {
    struct InvertOptions
    {
      std::vector<std::string> surfaces, targets, boxes;
      std::string              folder;
      InversionQuestion        question;
      TargetScaling            scaling; ///< without a study: not requested
    };

    /** "NAME=VALUE" in two. */
    std::pair<std::string, std::string> named(const std::string &option, const std::string &text)
    {
      const std::size_t equal = text.find('=');
      if (equal == std::string::npos || equal == 0)
        throw base::InputError("command line: " + option + " " + text + ": NAME=VALUE is wanted.");
      return {trimmed(text.substr(0, equal)), trimmed(text.substr(equal + 1))};
    }

    double number_of(const std::string &option, const std::string &text, const std::string &value)
    {
      const auto number = number_in(value);
      if (!number)
        throw base::InputError("command line: " + option + " " + text + ": \"" + value + "\" is no number.");
      return *number;
    }

    std::map<std::string, double> targets_of(const InvertOptions &options)
    {
      std::map<std::string, double> targets;
      for (const std::string &text : options.targets)
        {
          const auto [name, value] = named("--target", text);
          if (!targets.emplace(name, number_of("--target", text, value)).second)
            throw base::InputError("command line: --target " + name + " is given twice.");
        }
      return targets;
    }

    InversionQuestion question_of(const InvertOptions &options)
    {
      InversionQuestion question = options.question;
      if (question.genetic.population % 2 != 0)
        throw base::InputError(
          fmt::format("command line: --population {}: an even number is wanted.", question.genetic.population));
      std::map<std::string, double> targets = targets_of(options);
      for (const std::string &file : options.surfaces)
        {
          StoredSurface surface = read_surface(file);
          const auto    target  = targets.find(surface.response);
          if (target == targets.end())
            throw base::InputError(file + ": no --target is given for its response " + surface.response + ".");
          question.targets.push_back(target->second);
          question.surfaces.push_back(std::move(surface));
          targets.erase(target);
        }
      if (!targets.empty())
        throw base::InputError("command line: --target " + targets.begin()->first + ": no surface has this response.");
      for (const std::string &text : options.boxes)
        {
          const auto [name, value] = named("--box", text);
          const auto bounds        = comma_separated(value);
          if (bounds.size() != 2)
            throw base::InputError("command line: --box " + text + ": NAME=LOWEST,HIGHEST is wanted.");
          question.box[name] = {number_of("--box", text, bounds[0]), number_of("--box", text, bounds[1])};
        }
      return question;
    }

    /** Where in its box each constant lies in the answers that are equally good. @return what went wrong, "" if nothing */
    std::string draw_answers(const Inversion &found, const std::filesystem::path &file)
    {
      postprocess::PlotPanel panel;
      panel.title   = fmt::format("{} equally good answers", found.equally_good.size());
      panel.y_label = "place in the box (0: lower, 1: upper bound)";
      panel.series.resize(2);
      panel.series[1].name = "the most central";
      for (std::size_t factor = 0; factor < found.factors.size(); ++factor)
        {
          panel.x_label += fmt::format("{}{} {}", factor > 0 ? ", " : "", factor + 1, found.factors[factor]);
          const auto place = [&](const InversionSolution &solution) {
            return (solution.constants[factor] - found.box.lower[factor]) /
                   (found.box.upper[factor] - found.box.lower[factor]);
          };
          for (const InversionSolution &solution : found.equally_good)
            {
              panel.series[0].x.push_back(static_cast<double>(factor) + 1);
              panel.series[0].y.push_back(place(solution));
            }
          panel.series[1].x.push_back(static_cast<double>(factor) + 1);
          panel.series[1].y.push_back(place(found.best()));
        }
      panel.series[0].style = panel.series[1].style = postprocess::PlotSeries::Style::points;
      return postprocess::plot(file, {panel});
    }

    int write_inversion(const InvertOptions  &options,
                        const Inversion      &found,
                        const nlohmann::json &json,
                        const std::string    &words)
    {
      ResultFolder folder(options.folder, ResultFolder::Start::afresh);
      postprocess::write_json(folder.running() / "inversion.json", json);
      warn_of_missing("answers.png", draw_answers(found, folder.running() / "answers.png"));
      postprocess::HtmlPage page("Constants for wanted responses");
      page.lines(words);
      page.picture(folder.running() / "answers.png", "How far equally good answers spread");
      postprocess::write_text(folder.running() / "report.html", page.text());
      folder.publish();
      fmt::print("\nwritten to {}: report.html, inversion.json and answers.png\n", options.folder);
      return exit_success;
    }

    /** Inversion and runs in turn, until these give what was wanted. */
    int invert_and_run(const InvertOptions &options, const InversionQuestion &question)
    {
      if (options.folder.empty())
        throw base::InputError("command line: --check wants a folder for its runs: -o DIR.");
      TargetScaling scaling  = options.scaling;
      scaling.options.folder = options.folder;
      catch_interrupts();
      std::string         words;
      const ScaledTargets scaled = scale_targets(question, scaling, [&](const ScaledRound &round) {
        words += words_of(question, round);
        fmt::print("{}\n", words_of(question, round));
      });
      if (scaled.interrupted)
        return exit_interrupted;
      InversionQuestion last = question;
      last.targets           = scaled.rounds.back().requested;
      const Inversion &found = scaled.rounds.back().found;
      nlohmann::json   json  = json_of(last, found);
      json["checked"]        = json_of(question, scaled);
      words                  = words_of(last, found) + words;
      if (!scaled.within_tolerance)
        words += fmt::format("warning: after {} rounds the means are not within {:g} % of the targets yet.\n",
                             scaled.rounds.size(), 100 * scaling.tolerance);
      fmt::print("{}", words);
      return write_inversion(options, found, json, words);
    }

    int invert_surfaces(const InvertOptions &options)
    {
      const InversionQuestion question = question_of(options);
      if (!options.scaling.study.empty())
        return invert_and_run(options, question);
      const Inversion found = invert(question);
      fmt::print("{}", words_of(question, found));
      if (options.folder.empty())
        return exit_success;
      return write_inversion(options, found, json_of(question, found), words_of(question, found));
    }
  } // namespace

  void add_invert(CLI::App &program, Action &chosen)
  {
    const auto         options  = std::make_shared<InvertOptions>();
    InversionQuestion &question = options->question;
    CLI::App          &command =
      *program.add_subcommand("invert", "Constants that give wanted responses, by the surfaces of studies");
    command.footer(
      "Where there are more constants than targets, many answers are as good: the most central one of the box "
      "is given, and how far the others spread.");
    command
      .add_option("surfaces", options->surfaces, "Surfaces: analysis.json of \"breccia analyse\", a response each")
      ->required()
      ->type_name("ANALYSIS.json");
    command.add_option("--target", options->targets, "What a response shall be, --target E=30; one for each surface")
      ->required()
      ->type_name("NAME=VALUE");
    command
      .add_option("--box", options->boxes,
                  "Where a constant may lie, --box cohesion=1e6,5e6; default: where all its surfaces were fitted")
      ->type_name("NAME=LOWEST,HIGHEST");
    command.add_option("--starts", question.starts, "Genetic searches; default: 5")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
    command.add_option("--population", question.genetic.population, "Of each search, an even number; default: 300")
      ->type_name("N")
      ->check(CLI::Range(4, 100000));
    command.add_option("--generations", question.genetic.generations, "Of each search; default: 300")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
    command.add_option("--seed", question.genetic.seed, "Of the searches; default: 1")
      ->type_name("N")
      ->check(CLI::Range(0, 1000000000));
    command.add_flag("--over-prediction", question.over_prediction,
                     "Deviations relative to what the surface gives instead of to the target");
    TargetScaling &scaling = options->scaling;
    command
      .add_option("--check", scaling.study,
                  "Study that runs the constants found, with several packings: where a mean is off its target, the "
                  "target of the surface is corrected by as much, in rounds")
      ->type_name("STUDY.prm");
    command.add_option("--tolerance", scaling.tolerance, "Of those means, over the targets; default: 0.05")
      ->type_name("SHARE")
      ->check(CLI::Range(1e-6, 1.0));
    command.add_option("--rounds", scaling.most_rounds, "At most; default: 4")
      ->type_name("N")
      ->check(CLI::Range(1, 100));
    command
      .add_option("--processes", scaling.options.processes,
                  "Runs at a time; default: as many as there are processors and memory for")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
    command.add_flag("--restart", scaling.options.restart, "Throw away the runs that are there");
    command.add_option("-o,--output", options->folder, "Folder for inversion.json; default: only words")
      ->type_name("DIR");
    command.callback([options, &chosen] { chosen = [options] { return invert_surfaces(*options); }; });
  }
} // namespace apps
