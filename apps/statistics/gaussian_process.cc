#include "apps/statistics/gaussian_process.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace statistics
{
  namespace
  {
    constexpr int    most_runs = 300;
    constexpr double pi        = 3.14159265358979323846;
    constexpr double shortest = 0.05, longest = 50;            // of coded lengths: runs fill -1 to 1
    constexpr double least_scatter = 1e-8, most_scatter = 1e2; // below, the correlations of close runs cannot be solved
    constexpr int    most_steps   = 100;
    constexpr double most_damping = 1e8, enough = 1e-12;

    /** Logarithms of lengths and scatter, which are searched. */
    Eigen::VectorXd logarithms(const GaussianProcess::Shape &shape)
    {
      Eigen::VectorXd logs(shape.lengths.size() + 1);
      logs << shape.lengths.array().log().matrix(), std::log(shape.scatter);
      return logs;
    }

    GaussianProcess::Shape shape_of(const Eigen::VectorXd &logs)
    {
      const Eigen::Index factors = logs.size() - 1;
      return {logs.head(factors).array().exp().max(shortest).min(longest).matrix(),
              std::clamp(std::exp(logs[factors]), least_scatter, most_scatter)};
    }

    /** A variable at its bound that would leave it takes no part in the step. */
    void leave_at_bounds(const Eigen::VectorXd &logs, Eigen::VectorXd &rise, Eigen::MatrixXd &curvature)
    {
      for (Eigen::Index k = 0; k < logs.size(); ++k)
        {
          const bool   last    = k + 1 == logs.size();
          const double lowest  = std::log(last ? least_scatter : shortest),
                       highest = std::log(last ? most_scatter : longest);
          const bool at_low    = logs[k]<lowest + 1e-9, at_high = logs[k]> highest - 1e-9;
          if ((at_low && rise[k] < 0) || (at_high && rise[k] > 0))
            {
              rise[k] = 0;
              curvature.row(k).setZero();
              curvature.col(k).setZero();
            }
          if (curvature(k, k) <= 0)
            curvature(k, k) = 1;
        }
    }
  } // namespace

  void GaussianProcess::read(const std::vector<Factor> &factors, const Eigen::VectorXd &response)
  {
    const Eigen::Index runs = response.size();
    if (runs > most_runs || runs < 3)
      throw base::InputError("Gaussian process: " + std::to_string(runs) + " runs: 3 to " + std::to_string(most_runs) +
                             ".");
    runs_box = {Eigen::VectorXd(factors.size()), Eigen::VectorXd(factors.size())};
    points.resize(runs, factors.size());
    for (std::size_t factor = 0; factor < factors.size(); ++factor)
      {
        const double low = factors[factor].values.minCoeff(), high = factors[factor].values.maxCoeff();
        if (!(low < high))
          throw base::InputError("factor " + factors[factor].name +
                                 " has the same value in every run: a surface over it cannot be fitted.");
        runs_box.lower[factor] = low;
        runs_box.upper[factor] = high;
        points.col(factor)     = (factors[factor].values.array() - (low + high) / 2) / ((high - low) / 2);
      }
    observed = response;
  }

  Eigen::MatrixXd GaussianProcess::correlation() const
  {
    const Eigen::MatrixXd scaled = points * own_shape.lengths.cwiseInverse().asDiagonal();
    Eigen::MatrixXd       matrix(scaled.rows(), scaled.rows());
    for (Eigen::Index a = 0; a < scaled.rows(); ++a)
      for (Eigen::Index b = 0; b <= a; ++b)
        matrix(a, b) = matrix(b, a) = std::exp(-0.5 * (scaled.row(a) - scaled.row(b)).squaredNorm());
    return matrix;
  }

  void GaussianProcess::set(const Shape &shape)
  {
    own_shape                 = shape;
    const Eigen::Index n      = observed.size();
    Eigen::MatrixXd    matrix = correlation();
    matrix.diagonal().array() += own_shape.scatter;
    factorised.compute(matrix);
    ones_solved                  = factorised.solve(Eigen::VectorXd::Ones(n));
    level                        = ones_solved.dot(observed) / ones_solved.sum();
    weights                      = factorised.solve((observed.array() - level).matrix());
    variance                     = weights.dot((observed.array() - level).matrix()) / n;
    const double log_determinant = 2 * factorised.matrixLLT().diagonal().array().log().sum();
    likelihood                   = -0.5 * (n * (std::log(2 * pi * variance) + 1) + log_determinant);
    if (!std::isfinite(likelihood)) // a response that does not vary, or correlations that are singular
      likelihood = -std::numeric_limits<double>::infinity();
  }

  Eigen::VectorXd GaussianProcess::slope(Eigen::MatrixXd &curvature) const
  {
    const Eigen::Index           factors = points.cols(), n = observed.size();
    const Eigen::MatrixXd        correlations = correlation();
    std::vector<Eigen::MatrixXd> solved; // inverse times derivative, of each logarithm
    Eigen::VectorXd              traces(factors + 1), rise(factors + 1);
    for (Eigen::Index k = 0; k <= factors; ++k)
      {
        Eigen::MatrixXd derivative;
        if (k == factors)
          derivative = own_shape.scatter * Eigen::MatrixXd::Identity(n, n);
        else
          {
            const Eigen::VectorXd place = points.col(k) / own_shape.lengths[k];
            derivative                  = correlations;
            for (Eigen::Index a = 0; a < n; ++a)
              derivative.col(a).array() *= (place.array() - place[a]).square();
          }
        solved.push_back(factorised.solve(derivative));
        traces[k] = solved.back().trace();
        rise[k]   = 0.5 * (weights.dot(derivative * weights) / variance - traces[k]);
      }
    curvature.resize(factors + 1, factors + 1);
    for (Eigen::Index a = 0; a <= factors; ++a)
      for (Eigen::Index b = 0; b <= a; ++b)
        curvature(a, b) = curvature(b, a) =
          0.5 * (solved[a].cwiseProduct(solved[b].transpose()).sum() - traces[a] * traces[b] / n);
    return rise;
  }

  /** Damped scoring: Newton's method with the expected curvature of the likelihood, which is never negative. */
  void GaussianProcess::climb(const Shape &start)
  {
    set(start);
    Eigen::VectorXd logs    = logarithms(own_shape);
    double          damping = 1e-2;
    for (int step = 0; step < most_steps && std::isfinite(likelihood); ++step)
      {
        Eigen::MatrixXd curvature;
        Eigen::VectorXd rise = slope(curvature);
        leave_at_bounds(logs, rise, curvature);
        const double before = likelihood;
        bool         better = false;
        for (; !better && damping < most_damping; damping *= better ? 0.1 : 10)
          {
            Eigen::MatrixXd damped = curvature;
            damped.diagonal() *= 1 + damping;
            set(shape_of(logs + damped.ldlt().solve(rise)));
            better = likelihood > before;
          }
        if (better)
          logs = logarithms(own_shape);
        if (!better || likelihood - before < enough * std::fabs(before))
          break;
      }
    set(shape_of(logs));
  }

  GaussianProcess::GaussianProcess(const std::vector<Factor> &factors, const Eigen::VectorXd &response)
  {
    read(factors, response);
    Shape  best;
    double highest = -std::numeric_limits<double>::infinity();
    for (const double length : {0.7, 3.0})
      for (const double scatter : {1e-4, 0.1})
        {
          climb({Eigen::VectorXd::Constant(points.cols(), length), scatter});
          if (likelihood > highest)
            {
              highest = likelihood;
              best    = own_shape;
            }
        }
    if (!std::isfinite(highest))
      throw base::InputError("Gaussian process: the response does not vary.");
    set(best);
  }

  GaussianProcess::GaussianProcess(const std::vector<Factor> &factors,
                                   const Eigen::VectorXd     &response,
                                   const Shape               &shape)
  {
    read(factors, response);
    set(shape);
  }

  Predicted GaussianProcess::at(const Eigen::VectorXd &point) const
  {
    const Eigen::VectorXd coded = (point - runs_box.centre()).cwiseQuotient(runs_box.half());
    Eigen::VectorXd       to_runs(points.rows());
    for (Eigen::Index run = 0; run < points.rows(); ++run)
      to_runs[run] =
        std::exp(-0.5 * (points.row(run).transpose() - coded).cwiseQuotient(own_shape.lengths).squaredNorm());
    const double unexplained = 1 - to_runs.dot(factorised.solve(to_runs));
    const double of_mean     = 1 - ones_solved.dot(to_runs);
    return {level + to_runs.dot(weights),
            std::sqrt(std::fmax(variance * (unexplained + of_mean * of_mean / ones_solved.sum()), 0))};
  }

  Eigen::VectorXd GaussianProcess::left_out() const
  {
    const Eigen::Index    n       = observed.size();
    const Eigen::MatrixXd inverse = factorised.solve(Eigen::MatrixXd::Identity(n, n));
    const Eigen::VectorXd own     = inverse.diagonal() - ones_solved.cwiseAbs2() / ones_solved.sum();
    return observed - weights.cwiseQuotient(own);
  }
} // namespace statistics
