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

    /**
     * Takes out the constant of the largest standard error until the others are determined. Noise in the Jacobian makes all squares of
     * singular values larger, and bars narrower, by what is expected of it: they are taken less that, but not less than half.
     */
    Eigen::MatrixXd inverse_of_determined(const Eigen::MatrixXd    &scaled,
                                          const UncertaintyOptions &options,
                                          std::vector<int>         &kept,
                                          Uncertainty              &found)
    {
      while (!kept.empty())
        {
          const Eigen::MatrixXd                   own = scaled(Eigen::all, kept);
          const Eigen::JacobiSVD<Eigen::MatrixXd> svd(own, Eigen::ComputeThinV);
          const Eigen::VectorXd                  &values = svd.singularValues();
          const double                            least  = values[values.size() - 1];
          found.condition = least > 0 ? std::pow(values[0] / least, 2) : std::numeric_limits<double>::infinity();
          if (found.condition <= options.largest_condition)
            return svd.matrixV() *
                   (values.cwiseAbs2().array() - options.jacobian_noise)
                     .max(values.cwiseAbs2().array() / 2)
                     .inverse()
                     .matrix()
                     .asDiagonal() *
                   svd.matrixV().transpose();
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

  /**
   * Variances of two sources, each with degrees of its own, count as one with the degrees of F. E. Satterthwaite, Biometrics Bulletin 2
   * (1946) 110, Eq. 17: few draws of the noise are not sure of it.
   */
  double Uncertainty::quantile(const Eigen::VectorXd &derivatives, const double probability) const
  {
    constexpr double as_good_as_known = 1e9; // degrees
    const double     all              = derivatives.dot(covariance * derivatives),
                 of_residuals         = known_scatter ? as_good_as_known : degrees;
    const double by_noise             = draws > 0 ? derivatives.dot(covariance_of_noise * derivatives) : 0;
    if (!(by_noise > 0))
      return t_limit((1 - probability) / 2, of_residuals);
    const double rest = all - by_noise;
    return t_limit((1 - probability) / 2, all * all / (rest * rest / of_residuals + by_noise * by_noise / draws));
  }

  double Uncertainty::half_width(const int constant, const double probability) const
  {
    if (std::isnan(standard_errors[constant]))
      return nan;
    return quantile(Eigen::VectorXd::Unit(covariance.rows(), constant), probability) * standard_errors[constant];
  }

  double Uncertainty::half_width_of(const Eigen::VectorXd &derivatives, const double probability) const
  {
    const double variance = derivatives.dot(covariance * derivatives);
    return variance > 0 ? quantile(derivatives, probability) * std::sqrt(variance) : 0;
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
    const Eigen::MatrixXd inverse = inverse_of_determined(jacobian * ranges.asDiagonal(), options, kept, found);
    found.degrees                 = static_cast<int>(residuals.size()) - static_cast<int>(kept.size());
    found.known_scatter           = options.known_scatter > 0;
    if (found.degrees < (found.known_scatter ? 0 : 1))
      throw base::InputError("uncertainty: " + std::to_string(residuals.size()) + " residuals do not determine " +
                             std::to_string(kept.size()) + " constants and their scatter.");
    const bool noisy = !kept.empty() && options.model_noise.cols() > 0;
    found.scatter    = found.known_scatter ? options.known_scatter : std::sqrt(residuals.squaredNorm() / found.degrees);
    double scatter_but_noise = found.scatter * found.scatter;
    if (noisy && !found.known_scatter) // the residuals have the noise of a run and of what was measured
      scatter_but_noise = std::max(0.0, scatter_but_noise - 2 * options.model_noise.colwise().squaredNorm().mean() /
                                                              static_cast<double>(residuals.size()));
    found.standard_errors  = Eigen::VectorXd::Constant(n, nan);
    found.covariance       = Eigen::MatrixXd::Zero(n, n);
    found.correlation      = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd scaled = scatter_but_noise * inverse, of_noise;
    if (noisy)
      {
        const Eigen::MatrixXd jumps =
          inverse * (jacobian * ranges.asDiagonal())(Eigen::all, kept).transpose() * options.model_noise;
        of_noise = (1 + options.noise_share) * jumps * jumps.transpose() /
                   static_cast<double>(jumps.cols()); // of what was measured, and of runs
        scaled += of_noise;
        found.draws = options.noise_degrees > 0 ? options.noise_degrees : static_cast<double>(jumps.cols());
        found.covariance_of_noise = Eigen::MatrixXd::Zero(n, n);
      }
    for (std::size_t i = 0; i < kept.size(); ++i)
      for (std::size_t j = 0; j < kept.size(); ++j)
        {
          found.covariance(kept[i], kept[j]) = scaled(i, j) * ranges[kept[i]] * ranges[kept[j]];
          if (found.draws > 0)
            found.covariance_of_noise(kept[i], kept[j]) = of_noise(i, j) * ranges[kept[i]] * ranges[kept[j]];
          found.correlation(kept[i], kept[j]) = scaled(i, j) / std::sqrt(scaled(i, i) * scaled(j, j));
        }
    for (const int k : kept)
      found.standard_errors[k] = std::sqrt(found.covariance(k, k));
    return found;
  }
} // namespace statistics
