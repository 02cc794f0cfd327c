#include "apps/studies/scaled_targets.h"

#include "apps/process/exit_status.h"
#include "apps/studies/study_file.h"
#include "apps/studies/study_plan.h"
#include "base/errors.h"
#include "postprocess/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    template <typename Named>
    void demand(const std::deque<Named> &all, const std::string &name, const std::string &file, const char *what)
    {
      std::vector<std::string> names;
      for (const Named &each : all)
        names.push_back(each.name);
      if (std::find(names.begin(), names.end(), name) == names.end())
        throw base::InputError(fmt::format("{}: there is no {} {}, which the surfaces have. There are: {}.", file, what,
                                           name, fmt::join(names, ", ")));
    }

    /** The study with the constants found. */
    std::unique_ptr<StudyFile> study_with(const TargetScaling &scaling, const Inversion &found)
    {
      const auto               plain = read_study(scaling.study, {});
      std::vector<std::string> levels;
      for (std::size_t k = 0; k < found.factors.size(); ++k)
        {
          demand(plain->factors, found.factors[k], scaling.study, "factor");
          levels.push_back(fmt::format("Factors/{}/Levels={}", found.factors[k], found.best().constants[k]));
        }
      return read_study(scaling.study, levels);
    }

    /** Means and variations over the runs that have all responses. */
    void read_responses(const InversionQuestion &question, const std::filesystem::path &file, ScaledRound &round)
    {
      const postprocess::CsvTable table = postprocess::read_csv_table(file, true);
      Eigen::MatrixXd             values(static_cast<Eigen::Index>(table.rows()),
                                         static_cast<Eigen::Index>(question.surfaces.size()));
      for (Eigen::Index k = 0; k < values.cols(); ++k)
        {
          const std::vector<double> &column = table.column(question.surfaces[k].response);
          values.col(k)                     = Eigen::Map<const Eigen::VectorXd>(column.data(), values.rows());
        }
      std::vector<Eigen::Index> whole;
      for (Eigen::Index run = 0; run < values.rows(); ++run)
        if (values.row(run).allFinite())
          whole.push_back(run);
      if (whole.empty())
        throw base::InputError(file.string() + ": no run has all the responses that targets are given for.");
      round.runs = static_cast<Eigen::Index>(whole.size());
      for (Eigen::Index k = 0; k < values.cols(); ++k)
        {
          const Eigen::VectorXd own  = values.col(k)(whole);
          const double          mean = own.mean(), squares = (own.array() - mean).square().sum();
          round.means.push_back(mean);
          round.variations.push_back(
            round.runs > 1 ? std::sqrt(squares / static_cast<double>(round.runs - 1)) / std::fabs(mean) : 0);
        }
    }
  } // namespace

  ScaledTargets scale_targets(const InversionQuestion                        &question,
                              const TargetScaling                            &scaling,
                              const std::function<void(const ScaledRound &)> &on_round)
  {
    ScaledTargets     all;
    InversionQuestion requested = question;
    const auto        plain     = read_study(scaling.study, {});
    for (const StoredSurface &surface : question.surfaces)
      demand(plain->responses, surface.response, scaling.study, "response");
    for (std::int64_t number = 1; number <= scaling.most_rounds && !all.within_tolerance; ++number)
      {
        ScaledRound round;
        round.requested      = requested.targets;
        round.found          = invert(requested);
        const auto   study   = study_with(scaling, round.found);
        StudyOptions options = scaling.options;
        options.folder       = scaling.options.folder / fmt::format("round_{}", number);
        if (run_study(*study, plan_of(*study), options) != exit_success)
          {
            all.interrupted = true;
            return all;
          }
        read_responses(question, options.folder / "table.csv", round);
        all.within_tolerance = true;
        for (std::size_t k = 0; k < question.targets.size(); ++k)
          {
            const double ratio   = round.means[k] / question.targets[k];
            all.within_tolerance = all.within_tolerance && std::fabs(ratio - 1) <= scaling.tolerance;
            requested.targets[k] /= ratio;
          }
        all.rounds.push_back(round);
        on_round(all.rounds.back());
      }
    return all;
  }
} // namespace apps
