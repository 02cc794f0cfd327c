#pragma once

#include "apps/statistics/factor.h"
#include "apps/statistics/polynomial.h"

#include <Eigen/Cholesky>

#include <vector>

namespace statistics
{
  /** A value of a surface and how sure it is. */
  struct Predicted
  {
    double mean = 0, standard_error = 0; ///< of the surface, not of a single run
  };

  /**
   * A Gaussian process through runs: unknown constant mean, squared exponential correlation with a length for each coded factor, and
   * scatter of single runs; lengths and scatter by maximum likelihood (doc/theory/studies.md, 5).
   */
  class GaussianProcess
  {
  public:
    /** Lengths in coded variables, in which the runs fill -1 to 1; scatter as a share of the variance of the process. */
    struct Shape
    {
      Eigen::VectorXd lengths;
      double          scatter = 0;
    };

    /** Find the shape of the greatest likelihood. @throws base::InputError above 300 runs, below 3, or for a factor that does not vary */
    GaussianProcess(const std::vector<Factor> &factors, const Eigen::VectorXd &response);
    /** With a given shape. @throws base::InputError as above */
    GaussianProcess(const std::vector<Factor> &factors, const Eigen::VectorXd &response, const Shape &shape);

    /** @param point in physical variables */
    Predicted at(const Eigen::VectorXd &point) const;

    const Shape &shape() const { return own_shape; }
    const Box   &box() const { return runs_box; }
    double       mean() const { return level; }
    double       process_variance() const { return variance; }
    double       log_likelihood() const { return likelihood; }
    /** What the process of all other runs, of the same shape, predicts for each run. */
    Eigen::VectorXd left_out() const;

  private:
    void            read(const std::vector<Factor> &factors, const Eigen::VectorXd &response);
    void            set(const Shape &shape);
    Eigen::VectorXd slope(Eigen::MatrixXd &curvature) const;
    void            climb(const Shape &start);
    Eigen::MatrixXd correlation() const;

    Box                         runs_box;
    Eigen::MatrixXd             points; ///< coded
    Eigen::VectorXd             observed;
    Shape                       own_shape;
    Eigen::LLT<Eigen::MatrixXd> factorised; ///< correlations and scatter
    Eigen::VectorXd             ones_solved, weights;
    double                      level = 0, variance = 0, likelihood = 0;
  };
} // namespace statistics
