#include "apps/commands/command.h"
#include "apps/process/exit_status.h"
#include "apps/process/version.h"
#include "apps/results/result_folder.h"
#include "apps/results/warning.h"
#include "apps/studies/inversion.h"
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

    double deviation(const InversionQuestion &question, const InversionSolution &solution, const std::size_t response)
    {
      return solution.responses[response] / question.targets[response] - 1;
    }

    std::string words_of(const InversionQuestion &question, const Inversion &found)
    {
      std::string text = fmt::format("{:<14} {:>12} {:>12} {:>12}\n", "response", "target", "surface", "deviation");
      for (std::size_t k = 0; k < question.targets.size(); ++k)
        text += fmt::format("{:<14} {:>12.6g} {:>12.6g} {:>10.3g} %\n", question.surfaces[k].response,
                            question.targets[k], found.best().responses[k], 100 * deviation(question, found.best(), k));
      text += fmt::format("\n{:<14} {:>12} {:>12} {:>12}   of {} equally good answers\n", "constant", "most central",
                          "least", "largest", found.equally_good.size());
      for (std::size_t factor = 0; factor < found.factors.size(); ++factor)
        {
          double least = INFINITY, largest = -INFINITY;
          for (const InversionSolution &solution : found.equally_good)
            {
              least   = std::min(least, solution.constants[factor]);
              largest = std::max(largest, solution.constants[factor]);
            }
          text += fmt::format("{:<14} {:>12.6g} {:>12.6g} {:>12.6g}\n", found.factors[factor],
                              found.best().constants[factor], least, largest);
        }
      for (const std::string &warning : found.warnings)
        text += "warning: " + warning + "\n";
      return text;
    }

    nlohmann::json json_of(const InversionQuestion &question, const Inversion &found)
    {
      nlohmann::json json = {{"made_by", "breccia " + version()}, {"seed", question.genetic.seed},
                             {"reached", found.reached},          {"misfit", found.best().misfit},
                             {"warnings", found.warnings},        {"solutions", nlohmann::json::array()}};
      for (const InversionSolution &solution : found.equally_good)
        {
          nlohmann::json one = {{"misfit", solution.misfit}};
          for (std::size_t factor = 0; factor < found.factors.size(); ++factor)
            one["constants"][found.factors[factor]] = solution.constants[factor];
          json["solutions"].push_back(one);
        }
      for (std::size_t k = 0; k < question.targets.size(); ++k)
        json["responses"][question.surfaces[k].response] = {
          {"target", question.targets[k]},
          {"value", found.best().responses[k]},
          {"relative_deviation", deviation(question, found.best(), k)},
          {"unit", question.surfaces[k].unit}};
      for (std::size_t factor = 0; factor < found.factors.size(); ++factor)
        {
          Eigen::VectorXd values(static_cast<Eigen::Index>(found.equally_good.size()));
          for (std::size_t k = 0; k < found.equally_good.size(); ++k)
            values[k] = found.equally_good[k].constants[factor];
          json["constants"][found.factors[factor]] = {{"value", found.best().constants[factor]},
                                                      {"least", values.minCoeff()},
                                                      {"largest", values.maxCoeff()},
                                                      {"box", {found.box.lower[factor], found.box.upper[factor]}}};
        }
      return json;
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

    int invert_surfaces(const InvertOptions &options)
    {
      const InversionQuestion question = question_of(options);
      const Inversion         found    = invert(question);
      fmt::print("{}", words_of(question, found));
      if (options.folder.empty())
        return exit_success;
      ResultFolder folder(options.folder, ResultFolder::Start::afresh);
      postprocess::write_json(folder.running() / "inversion.json", json_of(question, found));
      warn_of_missing("answers.png", draw_answers(found, folder.running() / "answers.png"));
      postprocess::HtmlPage page("Constants for wanted responses");
      page.lines(words_of(question, found));
      page.picture(folder.running() / "answers.png", "How far equally good answers spread");
      postprocess::write_text(folder.running() / "report.html", page.text());
      folder.publish();
      fmt::print("\nwritten to {}: report.html, inversion.json and answers.png\n", options.folder);
      return exit_success;
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
    command.add_option("-o,--output", options->folder, "Folder for inversion.json; default: only words")
      ->type_name("DIR");
    command.callback([options, &chosen] { chosen = [options] { return invert_surfaces(*options); }; });
  }
} // namespace apps
