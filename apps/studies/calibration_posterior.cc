#include "apps/statistics/posterior.h"
#include "apps/statistics/space_filling.h"
#include "apps/studies/calibration.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    constexpr double standard_errors_around = 4, posterior_share = 0.95, most_drift = 0.2;
    constexpr double poor_emulator = 0.5; // its error over the scatter of observations

    /** Around the answer, or the bounds where there is no error. */
    statistics::Box box_around(const CalibrationFile &file, const Calibration &found)
    {
      statistics::Box box{found.constants, found.constants};
      for (Eigen::Index k = 0; k < found.constants.size(); ++k)
        {
          const SoughtConstant &constant = file.constants[k];
          const double          reach    = standard_errors_around * found.standard_errors[k];
          const bool            known    = found.determined[k] && std::isfinite(reach);
          box.lower[k] = known ? std::max(constant.lower, found.constants[k] - reach) : constant.lower;
          box.upper[k] = known ? std::min(constant.upper, found.constants[k] + reach) : constant.upper;
        }
      return box;
    }

    std::vector<Eigen::VectorXd> sets_in(const statistics::Box &box, const PosteriorRequest &request)
    {
      const Eigen::MatrixXd cube =
        statistics::latin_hypercube(static_cast<int>(request.runs), static_cast<int>(box.lower.size()), request.seed);
      std::vector<Eigen::VectorXd> sets;
      for (const auto &place : cube.rowwise())
        sets.emplace_back(box.lower + place.transpose().cwiseProduct(box.upper - box.lower));
      return sets;
    }

    /** Of those sets that had an answer. */
    statistics::ModelRuns
    runs_with_answers(const CalibrationFile &file, CalibrationRuns &runs, const statistics::Box &box)
    {
      const std::vector<Eigen::VectorXd> sets    = sets_in(box, file.posterior);
      const auto                         answers = runs.predicted(sets);
      const auto count = std::count_if(answers.begin(), answers.end(), [](const auto &own) { return own.has_value(); });
      statistics::ModelRuns model{
        {}, Eigen::MatrixXd(count, box.lower.size()), Eigen::MatrixXd(count, runs.measured().size())};
      for (const SoughtConstant &constant : file.constants)
        model.names.push_back(constant.name);
      Eigen::Index row = 0;
      for (std::size_t k = 0; k < sets.size(); ++k)
        if (answers[k])
          {
            model.constants.row(row) = sets[k];
            model.outputs.row(row++) = answers[k]->cwiseQuotient(runs.scale());
          }
      return model;
    }

    void warn(const CalibrationFile &file, const statistics::Box &box, CalibrationPosterior &found)
    {
      if (found.drift > most_drift)
        found.warnings.push_back(fmt::format("The sampler still drifts, by {:.2g} standard deviations: more draws are "
                                             "wanted (Posterior/Draws).",
                                             found.drift));
      if (found.emulator_error > poor_emulator * found.scatter)
        found.warnings.push_back(fmt::format(
          "The emulator errs by {:.2g} of the observations' scatter: more runs are wanted (Posterior/Runs).",
          found.emulator_error / found.scatter));
      for (Eigen::Index k = 0; k < found.mean.size(); ++k)
        {
          const double edge = 0.02 * (box.upper[k] - box.lower[k]);
          if ((found.lower[k] < box.lower[k] + edge && box.lower[k] > file.constants[k].lower) ||
              (found.upper[k] > box.upper[k] - edge && box.upper[k] < file.constants[k].upper))
            found.warnings.push_back("The posterior of " + file.constants[k].name +
                                     " reaches the edge of the runs around the answer: its band is too narrow.");
        }
    }
  } // namespace

  CalibrationPosterior posterior_of(const CalibrationFile &file, CalibrationRuns &runs, const Calibration &found)
  {
    const statistics::Box       box   = box_around(file, found);
    const statistics::ModelRuns model = runs_with_answers(file, runs, box);
    const bool                  known = file.targets.front().deviation > 0;
    const statistics::Emulator  emulator(model);
    const statistics::Posterior drawn =
      statistics::posterior(emulator, {runs.measured().cwiseQuotient(runs.scale()), known ? 1.0 : 0.0},
                            {static_cast<int>(file.posterior.draws), static_cast<int>(file.posterior.draws / 4),
                             static_cast<std::uint64_t>(file.posterior.seed)});
    CalibrationPosterior posterior;
    posterior.runs                                = model.constants.rows();
    posterior.mean                                = drawn.mean();
    posterior.standard_deviation                  = drawn.standard_deviation();
    std::tie(posterior.lower, posterior.upper)    = drawn.band(posterior_share);
    std::tie(posterior.lowest, posterior.highest) = drawn.band_of_outputs(posterior_share);
    posterior.lowest                              = posterior.lowest.cwiseProduct(runs.scale());
    posterior.highest                             = posterior.highest.cwiseProduct(runs.scale());
    posterior.emulator_error                      = emulator.error();
    posterior.scatter                             = known ? 1 :
                                                            (found.predicted - runs.measured()).cwiseQuotient(runs.scale()).norm() /
                                  std::sqrt(static_cast<double>(found.predicted.size()));
    posterior.accepted                            = drawn.accepted;
    posterior.drift                               = drawn.drift;
    warn(file, box, posterior);
    return posterior;
  }
} // namespace apps
