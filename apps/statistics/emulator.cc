#include "apps/statistics/emulator.h"

#include "base/errors.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace statistics
{
  namespace
  {
    constexpr double       kept_share      = 1 - 1e-6; // of the sum of squares
    constexpr Eigen::Index most_components = 8;

    /** As few as have the share. */
    Eigen::Index components_needed(const Eigen::VectorXd &singular_values)
    {
      const double whole = singular_values.squaredNorm();
      double       sum   = 0;
      Eigen::Index count = 0;
      while (count < std::min(singular_values.size(), most_components) && sum < kept_share * whole)
        sum += std::pow(singular_values[count++], 2);
      return count;
    }
  } // namespace

  Emulator::Emulator(const ModelRuns &runs)
    : mean(runs.outputs.colwise().mean())
  {
    const Eigen::MatrixXd                   deviations = runs.outputs.rowwise() - mean.transpose();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(deviations, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::Index                      count = components_needed(svd.singularValues());
    if (count == 0 || !(svd.singularValues()[0] > 1e-12 * runs.outputs.norm()))
      throw base::InputError("emulator: the outputs are the same in every run.");
    directions = svd.matrixV().leftCols(count);
    std::vector<Factor> factors;
    for (Eigen::Index k = 0; k < runs.constants.cols(); ++k)
      factors.push_back({runs.names[k], runs.constants.col(k)});
    Eigen::MatrixXd missed = deviations;
    for (Eigen::Index k = 0; k < count; ++k)
      {
        processes.emplace_back(factors, deviations * directions.col(k));
        missed -= processes.back().left_out() * directions.col(k).transpose();
      }
    const auto entries = static_cast<double>(deviations.size());
    truncated          = (deviations - deviations * directions * directions.transpose()).squaredNorm() / entries;
    left_out_error     = std::sqrt(missed.squaredNorm() / entries);
  }

  Emulator::Outputs Emulator::at(const Eigen::VectorXd &constants) const
  {
    Outputs found{mean, Eigen::VectorXd(directions.cols())};
    for (Eigen::Index k = 0; k < directions.cols(); ++k)
      {
        const Predicted own = processes[k].at(constants);
        found.mean += own.mean * directions.col(k);
        found.variances[k] = own.standard_error * own.standard_error;
      }
    return found;
  }
} // namespace statistics
