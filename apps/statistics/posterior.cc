#include "apps/statistics/posterior.h"

#include "apps/statistics/space_filling.h"
#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace statistics
{
  namespace
  {
    constexpr Eigen::Index walkers_per_variable = 6, most_outputs = 2000;
    constexpr double       widest_scatter = 1e3; // of an unknown one, over its first guess and under it

    /** Of errors whose covariance is (scatter^2 + left over) 1 + components diag(variances) components^T. */
    double
    log_likelihood(const Emulator &emulator, const Observed &observed, const Eigen::VectorXd &constants, double scatter)
    {
      const Emulator::Outputs predicted = emulator.at(constants);
      const Eigen::VectorXd   missed    = observed.outputs - predicted.mean;
      const Eigen::VectorXd   along     = emulator.components().transpose() * missed;
      const double            across    = scatter * scatter + emulator.left_over();
      const auto              rest      = static_cast<double>(missed.size() - along.size());
      double                  sum = (missed.squaredNorm() - along.squaredNorm()) / across + rest * std::log(across);
      for (Eigen::Index k = 0; k < along.size(); ++k)
        sum += along[k] * along[k] / (across + predicted.variances[k]) + std::log(across + predicted.variances[k]);
      return -sum / 2;
    }

    /** Root mean square of what the best of the draws misses: where an unknown scatter begins. */
    double first_scatter(const Emulator &emulator, const Observed &observed, const Eigen::MatrixXd &draws)
    {
      double least = std::numeric_limits<double>::infinity();
      for (const auto &draw : draws.rowwise())
        least = std::min(least, (observed.outputs - emulator.at(draw).mean).squaredNorm());
      return std::sqrt(std::max(least, 1e-300) / static_cast<double>(observed.outputs.size()));
    }

    std::pair<Eigen::VectorXd, Eigen::VectorXd> band_of(const Eigen::MatrixXd &draws, const double probability)
    {
      std::pair<Eigen::VectorXd, Eigen::VectorXd> ends{Eigen::VectorXd(draws.cols()), Eigen::VectorXd(draws.cols())};
      for (Eigen::Index k = 0; k < draws.cols(); ++k)
        {
          ends.first[k]  = quantile(draws.col(k), (1 - probability) / 2);
          ends.second[k] = quantile(draws.col(k), (1 + probability) / 2);
        }
      return ends;
    }

    double drift_of(const Eigen::MatrixXd &draws, const Eigen::VectorXd &deviations)
    {
      const Eigen::Index    half  = draws.rows() / 2;
      const Eigen::VectorXd first = draws.topRows(half).colwise().mean(),
                            last  = draws.bottomRows(half).colwise().mean();
      return (last - first).cwiseAbs().cwiseQuotient(deviations).maxCoeff();
    }
  } // namespace

  Eigen::VectorXd Posterior::standard_deviation() const
  {
    return ((constants.rowwise() - mean().transpose()).colwise().squaredNorm() /
            static_cast<double>(constants.rows() - 1))
      .cwiseSqrt();
  }

  std::pair<Eigen::VectorXd, Eigen::VectorXd> Posterior::band(const double probability) const
  {
    return band_of(constants, probability);
  }

  std::pair<Eigen::VectorXd, Eigen::VectorXd> Posterior::band_of_outputs(const double probability) const
  {
    return band_of(outputs, probability);
  }

  Posterior posterior(const Emulator &emulator, const Observed &observed, const EnsembleOptions &options)
  {
    if (observed.outputs.size() != emulator.components().rows())
      throw base::InputError("posterior: there are " + std::to_string(observed.outputs.size()) + " observations for " +
                             std::to_string(emulator.components().rows()) + " outputs.");
    const Box         &box     = emulator.box();
    const Eigen::Index n       = box.lower.size();
    const bool         unknown = !(observed.scatter > 0);
    const Eigen::Index all = n + unknown, walkers = walkers_per_variable * all;

    const Eigen::MatrixXd cube = latin_hypercube(static_cast<int>(walkers), static_cast<int>(all), options.seed);
    Eigen::MatrixXd       starts(walkers, all);
    for (Eigen::Index k = 0; k < n; ++k)
      starts.col(k) = box.lower[k] + cube.col(k).array() * (box.upper[k] - box.lower[k]);
    const double first = unknown ? std::log(first_scatter(emulator, observed, starts.leftCols(n))) : 0;
    if (unknown)
      starts.col(n) = first - 1 + 2 * cube.col(n).array();

    const double widest      = std::log(widest_scatter);
    const auto   log_density = [&](const Eigen::VectorXd &place) {
      if (!box.contains(place.head(n)) || (unknown && std::fabs(place[n] - first) > widest))
        return -std::numeric_limits<double>::infinity();
      return log_likelihood(emulator, observed, place.head(n), unknown ? std::exp(place[n]) : observed.scatter);
    };
    const Ensemble drawn = sampled(log_density, starts, options);
    Posterior      found;
    found.constants          = drawn.places.leftCols(n);
    found.accepted           = drawn.accepted;
    found.drift              = drift_of(found.constants, found.standard_deviation());
    const Eigen::Index shown = std::min(found.constants.rows(), most_outputs);
    found.outputs.resize(shown, observed.outputs.size());
    for (Eigen::Index k = 0; k < shown; ++k)
      {
        const Eigen::Index step = k * options.steps / shown, walker = k % walkers; // each walker as often
        found.outputs.row(k) = emulator.at(found.constants.row(step * walkers + walker)).mean;
      }
    return found;
  }
} // namespace statistics
