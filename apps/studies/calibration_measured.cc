// What was measured, of the runs of a calibration: apart from what their models give for it.
#include "apps/results/run_result.h"
#include "apps/studies/calibration_runs.h"
#include "apps/studies/measured_curve.h"
#include "apps/text/column_unit.h"
#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace apps
{
  namespace
  {
    std::string label_of(const std::string &column, const postprocess::CsvTable &table)
    {
      const auto         found = std::find(table.names.begin(), table.names.end(), column) - table.names.begin();
      const std::string &unit  = table.units.at(static_cast<std::size_t>(found));
      return unit.empty() ? column : column + " [" + unit + "]";
    }

    /** A laboratory's table may be in MPa and per cent; what runs find is in units of the System. */
    void put_curve_in_si(postprocess::CsvTable &table, const CurveColumns &columns)
    {
      for (std::size_t c = 0; c < table.names.size(); ++c)
        if (table.names[c] == columns.abscissa || table.names[c] == columns.ordinate)
          put_in_si(table, c);
    }

    /** What a residual is divided by: the standard deviation, or what makes targets of one weight count alike. */
    double scale_of_target(const CalibrationTarget &target, const Eigen::VectorXd &measured)
    {
      if (target.deviation > 0)
        return target.deviation;
      return measured.cwiseAbs().maxCoeff() * std::sqrt(static_cast<double>(measured.size()) / target.weight);
    }
  } // namespace

  /** What was measured, from tables, values and runs of reference scenes. */
  void CalibrationRuns::take_measured()
  {
    std::vector<double> values, abscissae, scales;
    begins = {0};
    labels.assign(calibration.targets.size(), {});
    for (const CalibrationTarget &target : calibration.targets)
      {
        Eigen::VectorXd             x         = Eigen::VectorXd::Constant(1, std::numeric_limits<double>::quiet_NaN());
        Eigen::VectorXd             y         = Eigen::VectorXd::Constant(1, target.value);
        const std::filesystem::path reference = target.reference.empty() ?
                                                  std::filesystem::path() :
                                                  folder_of(job_of(target.reference, std::vector<std::string>()));
        if (target.is_curve())
          {
            const CurveColumns columns =
              target.reference.empty() ?
                CurveColumns{target.abscissa, target.ordinate, ""} :
                CurveColumns{target.reference_abscissa, target.reference_ordinate, target.reference_test};
            auto table = postprocess::read_csv_table(target.reference.empty() ? std::filesystem::path(target.curve) :
                                                                                reference / "series.csv",
                                                     true, {"test"});
            if (target.reference.empty())
              put_curve_in_si(table, columns);
            x                         = abscissae_of(table, columns);
            y                         = ordinates_at(x, table, columns);
            labels[begins.size() - 1] = {label_of(columns.abscissa, table), label_of(columns.ordinate, table)};
          }
        else if (!reference.empty())
          y[0] =
            figure_of_run(reference, target.reference_figure).value.value_or(std::numeric_limits<double>::quiet_NaN());
        if (!y.allFinite())
          throw base::InputError(calibration.file + ": target " + target.name + ": the run of " + target.reference +
                                 " has no such figure.");
        abscissae.insert(abscissae.end(), x.begin(), x.end());
        values.insert(values.end(), y.begin(), y.end());
        scales.insert(scales.end(), static_cast<std::size_t>(y.size()), scale_of_target(target, y));
        begins.push_back(static_cast<Eigen::Index>(values.size()));
      }
    const auto n = static_cast<Eigen::Index>(values.size());
    observed     = Eigen::Map<const Eigen::VectorXd>(values.data(), n);
    places       = Eigen::Map<const Eigen::VectorXd>(abscissae.data(), n);
    deviations   = Eigen::Map<const Eigen::VectorXd>(scales.data(), n);
  }

  void CalibrationRuns::measure()
  {
    std::vector<Job> jobs, fresh;
    for (const CalibrationTarget &target : calibration.targets)
      if (!target.reference.empty())
        jobs.push_back(job_of(target.reference, std::vector<std::string>()));
    for (const Job &job : jobs)
      if (!message_of(job) &&
          std::none_of(fresh.begin(), fresh.end(), [&job](const Job &other) { return other.key == job.key; }))
        fresh.push_back(job);
    work_off(fresh);
    for (const Job &job : jobs)
      if (const std::string problem = *message_of(job); !problem.empty())
        throw base::InputError(calibration.file + ": what is measured in " + job.scene + " is not known: " + problem);
    take_measured();
  }
} // namespace apps
