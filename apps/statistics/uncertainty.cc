#include "apps/statistics/uncertainty.h"

#include "apps/statistics/distributions.h"
#include "base/errors.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>

namespace statistics
{
  namespace
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    /** Takes out the constant of the largest standard error until the others are determined. */
    Eigen::MatrixXd inverse_of_determined(const Eigen::MatrixXd &scaled,
                                          const double           largest_condition,
                                          std::vector<int>      &kept,
                                          Uncertainty           &found)
    {
      while (!kept.empty())
        {
          const Eigen::MatrixXd                   own = scaled(Eigen::all, kept);
          const Eigen::JacobiSVD<Eigen::MatrixXd> svd(own, Eigen::ComputeThinV);
          const Eigen::VectorXd                  &values = svd.singularValues();
          const double                            least  = values[values.size() - 1];
          found.condition = least > 0 ? std::pow(values[0] / least, 2) : std::numeric_limits<double>::infinity();
          if (found.condition <= largest_condition)
            return svd.matrixV() * values.cwiseAbs2().cwiseInverse().asDiagonal() * svd.matrixV().transpose();
          const double          floor    = values[0] * std::numeric_limits<double>::epsilon();
          const Eigen::VectorXd inverses = values.cwiseMax(std::max(floor, 1e-300)).cwiseAbs2().cwiseInverse();
          const Eigen::VectorXd errors   = svd.matrixV().cwiseAbs2() * inverses;
          Eigen::Index          worst    = 0;
          errors.maxCoeff(&worst);
          found.undetermined.push_back(kept[worst]);
          kept.erase(kept.begin() + worst);
        }
      found.condition = nan;
      return {};
    }
  } // namespace

  double Uncertainty::quantile(const double probability) const
  {
    constexpr double as_good_as_known = 1e9; // degrees
    return t_limit((1 - probability) / 2, known_scatter ? as_good_as_known : degrees);
  }

  double Uncertainty::half_width(const int constant, const double probability) const
  {
    return std::isnan(standard_errors[constant]) ? nan : quantile(probability) * standard_errors[constant];
  }

  double Uncertainty::half_width_of(const Eigen::VectorXd &derivatives, const double probability) const
  {
    return quantile(probability) * std::sqrt(derivatives.dot(covariance * derivatives));
  }

  Uncertainty uncertainty(const Eigen::MatrixXd    &jacobian,
                          const Eigen::VectorXd    &residuals,
                          const Eigen::VectorXd    &ranges,
                          const UncertaintyOptions &options)
  {
    const Eigen::Index n = jacobian.cols();
    Uncertainty        found;
    std::vector<int>   kept;
    for (int k = 0; k < n; ++k)
      (std::find(options.held.begin(), options.held.end(), k) == options.held.end() ? kept : found.undetermined)
        .push_back(k);
    const Eigen::MatrixXd inverse =
      inverse_of_determined(jacobian * ranges.asDiagonal(), options.largest_condition, kept, found);
    found.degrees       = static_cast<int>(residuals.size()) - static_cast<int>(kept.size());
    found.known_scatter = options.known_scatter > 0;
    if (found.degrees < (found.known_scatter ? 0 : 1))
      throw base::InputError("uncertainty: " + std::to_string(residuals.size()) + " residuals do not determine " +
                             std::to_string(kept.size()) + " constants and their scatter.");
    found.scatter = found.known_scatter ? options.known_scatter : std::sqrt(residuals.squaredNorm() / found.degrees);
    found.standard_errors  = Eigen::VectorXd::Constant(n, nan);
    found.covariance       = Eigen::MatrixXd::Zero(n, n);
    found.correlation      = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd scaled = found.scatter * found.scatter * inverse;
    if (!kept.empty() && options.model_noise.cols() > 0)
      {
        const Eigen::MatrixXd jumps =
          inverse * (jacobian * ranges.asDiagonal())(Eigen::all, kept).transpose() * options.model_noise;
        scaled +=
          2 * jumps * jumps.transpose() / static_cast<double>(jumps.cols()); // of the run, and of what was measured
      }
    for (std::size_t i = 0; i < kept.size(); ++i)
      for (std::size_t j = 0; j < kept.size(); ++j)
        {
          found.covariance(kept[i], kept[j])  = scaled(i, j) * ranges[kept[i]] * ranges[kept[j]];
          found.correlation(kept[i], kept[j]) = scaled(i, j) / std::sqrt(scaled(i, i) * scaled(j, j));
        }
    for (const int k : kept)
      found.standard_errors[k] = std::sqrt(found.covariance(k, k));
    return found;
  }
} // namespace statistics
