#include "apps/bench/calibration.h"

#include "apps/bench/calibration_problems.h"
#include "apps/bench/results.h"
#include "apps/optimisation/direct_search.h"
#include "apps/optimisation/synthetic_calibrations.h"
#include "apps/statistics/emulator.h"
#include "apps/statistics/space_filling.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace apps
{
  namespace
  {
    constexpr double near_enough = 0.01, difference_step = 0.03; // of the range of a constant
    constexpr int    most_runs = 500, runs_of_emulator = 6, most_emulators = 20;

    /** A model that counts its runs, and remembers how near to the truth it was ever evaluated. */
    class CountedModel
    {
    public:
      explicit CountedModel(const CalibrationProblem &problem_)
        : problem(problem_)
        , observed(problem.model(problem.truth))
      {
      }

      Eigen::VectorXd residuals(const Eigen::VectorXd &place)
      {
        ++runs;
        const double own = (place - problem.truth).cwiseQuotient(problem.upper - problem.lower).cwiseAbs().maxCoeff();
        nearest          = std::min(nearest, own);
        if (runs_needed == 0 && own < near_enough)
          runs_needed = runs;
        way.push_back(nearest);
        return problem.model(place) - observed;
      }

      const Eigen::VectorXd &target() const { return observed; }

      int                 runs = 0, runs_needed = 0; ///< 0: it never came as near
      double              nearest = std::numeric_limits<double>::infinity();
      std::vector<double> way; ///< after each run

    private:
      const CalibrationProblem &problem;
      const Eigen::VectorXd     observed;
    };

    optimisation::LeastSquaresProblem
    least_squares_of(const CalibrationProblem                                      &problem,
                     const std::function<Eigen::VectorXd(const Eigen::VectorXd &)> &residuals)
    {
      const auto one_by_one = [residuals](const std::vector<Eigen::VectorXd> &places) {
        std::vector<std::optional<Eigen::VectorXd>> all;
        for (const Eigen::VectorXd &place : places)
          all.emplace_back(residuals(place));
        return all;
      };
      return {problem.start, problem.lower, problem.upper, difference_step * (problem.upper - problem.lower),
              one_by_one};
    }

    optimisation::LeastSquaresOptions options_with(const bool updates)
    {
      optimisation::LeastSquaresOptions options;
      options.updated_jacobian  = updates;
      options.most_evaluations  = most_runs;
      options.smallest_decrease = 1e-6;
      return options;
    }

    optimisation::LeastSquaresProblem counted(const CalibrationProblem &problem, CountedModel &model)
    {
      return least_squares_of(problem, [&model](const Eigen::VectorXd &place) { return model.residuals(place); });
    }

    void by_differences(const CalibrationProblem &problem, CountedModel &model)
    {
      optimisation::least_squares(counted(problem, model), options_with(false));
    }

    void by_updates(const CalibrationProblem &problem, CountedModel &model)
    {
      optimisation::least_squares(counted(problem, model), options_with(true));
    }

    void after_cheap_model(const CalibrationProblem &problem, CountedModel &model)
    {
      const auto before = optimisation::least_squares(
        least_squares_of(problem, [&](const Eigen::VectorXd &place) { return problem.cheap(place) - model.target(); }),
        options_with(true));
      optimisation::LeastSquaresProblem costly = counted(problem, model);
      costly.start                             = before.place;
      costly.first_jacobian                    = before.jacobian;
      optimisation::least_squares(costly, options_with(true));
    }

    void without_derivatives(const CalibrationProblem &problem, CountedModel &model)
    {
      optimisation::direct_search(counted(problem, model), options_with(false));
    }

    /** Runs all over the bounds; then one more at a time where the emulator of those so far has its least sum. */
    void by_emulator(const CalibrationProblem &problem, CountedModel &model)
    {
      const Eigen::Index    n = problem.truth.size(), outputs = model.target().size();
      statistics::ModelRuns runs;
      const Eigen::MatrixXd cube =
        statistics::latin_hypercube(static_cast<int>(runs_of_emulator * n), static_cast<int>(n), 1);
      runs.constants.resize(cube.rows(), n);
      runs.outputs.resize(cube.rows(), outputs);
      for (Eigen::Index k = 0; k < n; ++k)
        runs.names.push_back("c" + std::to_string(k));
      const auto add = [&](const Eigen::Index row, const Eigen::VectorXd &place) {
        runs.constants.row(row) = place;
        runs.outputs.row(row)   = model.residuals(place);
      };
      for (Eigen::Index row = 0; row < cube.rows(); ++row)
        add(row, problem.lower + cube.row(row).transpose().cwiseProduct(problem.upper - problem.lower));
      for (int round = 0; round < most_emulators && model.runs_needed == 0; ++round)
        {
          const statistics::Emulator        emulator(runs);
          optimisation::LeastSquaresProblem cheap =
            least_squares_of(problem, [&](const Eigen::VectorXd &place) { return emulator.at(place).mean; });
          Eigen::Index best = 0;
          runs.outputs.rowwise().squaredNorm().minCoeff(&best);
          cheap.start               = runs.constants.row(best);
          const Eigen::VectorXd way = optimisation::least_squares(cheap, options_with(false)).place;
          if ((runs.constants.rowwise() - way.transpose()).rowwise().norm().minCoeff() < 1e-9)
            break; // it was there already
          runs.constants.conservativeResize(runs.constants.rows() + 1, Eigen::NoChange);
          runs.outputs.conservativeResize(runs.constants.rows(), Eigen::NoChange);
          add(runs.constants.rows() - 1, way);
        }
    }

    struct NamedSearch
    {
      const char *name;
      void (*search)(const CalibrationProblem &, CountedModel &);
    };

    constexpr NamedSearch searches[] = {{"differences", by_differences},
                                        {"updated differences", by_updates},
                                        {"after a cheap model", after_cheap_model},
                                        {"without derivatives", without_derivatives},
                                        {"emulator", by_emulator}};

    postprocess::PlotSeries way_of(const char *method, const CountedModel &model)
    {
      postprocess::PlotSeries series;
      series.name  = method;
      series.style = postprocess::PlotSeries::Style::line;
      for (std::size_t run = 0; run < model.way.size(); ++run)
        {
          series.x.push_back(static_cast<double>(run + 1));
          series.y.push_back(std::max(100 * model.way[run], 1e-3));
        }
      return series;
    }
    /** How often bands of 95 % hold the truth, of smooth models and of rough ones: a table and a file of its own. */
    void measure_coverage(const std::filesystem::path &folder)
    {
      const BenchResults results(folder, "calibration_coverage");
      std::string        csv = "scatter_of_runs,deviation_known,constant,inside [%],by_residuals [%],rough [%]\n";
      std::string        md =
        "| runs scatter by, over the deviation | deviation | inside bands of 95 % [%] | by residuals alone [%] "
        "| noise found [%] |\n|---|---|---|---|---|\n";
      for (const double scatter : {0.0, 0.25, 1.0})
        for (const bool known : {true, false})
          {
            optimisation::SyntheticCalibrations requested;
            requested.model_scatter      = scatter * requested.deviation;
            requested.known              = known;
            const auto            found  = optimisation::coverage_of(requested);
            const double          part   = 100.0 / requested.count;
            const Eigen::VectorXd inside = part * found.inside.cast<double>(),
                                  narrow = part * found.by_residuals.cast<double>();
            for (int k = 0; k < 3; ++k)
              csv += fmt::format("{},{},{},{},{},{}\n", scatter, known ? 1 : 0, k + 1, inside[k], narrow[k],
                                 part * found.rough);
            md += fmt::format("| {} | {} | {:.1f} to {:.1f} | {:.1f} to {:.1f} | {:.1f} |\n", scatter,
                              known ? "known" : "estimated", inside.minCoeff(), inside.maxCoeff(), narrow.minCoeff(),
                              narrow.maxCoeff(), part * found.rough);
          }
      fmt::print("\n{}", md);
      results.write(csv, md);
    }
  } // namespace

  int run_calibration_bench(const CalibrationBench &bench)
  {
    const BenchResults results(bench.folder, "calibration");
    std::string        csv = "problem,method,runs_needed,runs,nearest [%]\n";
    std::string        md  = "| problem | method | runs to 1 % | runs in all | nearest [%] |\n|---|---|---|---|---|\n";
    std::vector<postprocess::PlotPanel> panels;
    for (const CalibrationProblem &problem : calibration_problems())
      {
        postprocess::PlotPanel &panel = panels.emplace_back();
        panel.title                   = problem.name + ": " + problem.meaning;
        panel.x_label                 = "runs of the model";
        panel.y_label                 = "nearest so far [% of the range]";
        panel.log_x = panel.log_y = true;
        for (const NamedSearch &method : searches)
          {
            CountedModel model(problem);
            method.search(problem, model);
            const std::string needed = model.runs_needed > 0 ? std::to_string(model.runs_needed) : "";
            csv += fmt::format("{},{},{},{},{}\n", problem.name, method.name, needed.empty() ? "nan" : needed,
                               model.runs, 100 * model.nearest);
            md += fmt::format("| {} | {} | {} | {} | {:.3g} |\n", problem.name, method.name,
                              needed.empty() ? "never" : needed, model.runs, 100 * model.nearest);
            panel.series.push_back(way_of(method.name, model));
          }
      }
    fmt::print("{}", md);
    results.write(csv, md);
    measure_coverage(bench.folder);
    return results.finish(panels);
  }
} // namespace apps
