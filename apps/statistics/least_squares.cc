#include "apps/statistics/least_squares.h"

#include "base/errors.h"

#include <Eigen/QR>

#include <cmath>
#include <limits>

namespace statistics
{
  namespace
  {
    using Factorised = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;

    constexpr double unknown    = std::numeric_limits<double>::quiet_NaN();
    constexpr double dependent  = 1e-10; // of a column of unit length: what is left of it beside the others
    constexpr double full_lever = 1 - 1e-10;

    Eigen::VectorXd lengths_of(const Eigen::MatrixXd &matrix)
    {
      Eigen::VectorXd lengths = matrix.colwise().norm();
      for (double &length : lengths)
        if (length == 0)
          length = 1;
      return lengths;
    }

    /** "A^2 is made of 1, B": the terms that the runs cannot distinguish from others. */
    std::string aliases(const Factorised &factorised, const std::vector<std::string> &terms)
    {
      const Eigen::Index    rank  = factorised.rank();
      const auto           &order = factorised.colsPermutation().indices();
      const Eigen::MatrixXd upper = factorised.matrixR().topLeftCorner(rank, factorised.cols());
      const Eigen::MatrixXd made_of =
        upper.leftCols(rank).triangularView<Eigen::Upper>().solve(upper.rightCols(factorised.cols() - rank));
      std::string text;
      for (Eigen::Index column = 0; column < made_of.cols(); ++column)
        {
          std::string parts;
          for (Eigen::Index row = 0; row < rank; ++row)
            if (std::fabs(made_of(row, column)) > 1e-8)
              parts += (parts.empty() ? "" : ", ") + terms[order[row]];
          text +=
            (text.empty() ? "" : "; ") + terms[order[rank + column]] + " from " + (parts.empty() ? "zero" : parts);
        }
      return text;
    }

    void find_leverage(LinearFit &result, const Factorised &factorised)
    {
      const Eigen::Index    runs = factorised.rows(), terms = factorised.cols();
      const Eigen::MatrixXd q = factorised.householderQ() * Eigen::MatrixXd::Identity(runs, terms);
      result.leverage         = q.rowwise().squaredNorm();
    }

    void find_studentised(LinearFit &result)
    {
      const Eigen::Index runs = result.residuals.size();
      result.left_out = result.studentised = Eigen::VectorXd::Constant(runs, unknown);
      for (Eigen::Index run = 0; run < runs; ++run)
        {
          if (result.leverage[run] > full_lever)
            continue;
          const double rest = 1 - result.leverage[run], missed = result.residuals[run] / rest;
          result.left_out[run] = result.fitted[run] + result.residuals[run] - missed;
          if (result.error_degrees < 2)
            continue;
          const double others     = (result.error_sum - result.residuals[run] * missed) / (result.error_degrees - 1);
          result.studentised[run] = result.residuals[run] / std::sqrt(std::fmax(others, 0) * rest);
        }
    }
  } // namespace

  double LinearFit::standard_error() const
  {
    return error_degrees > 0 ? std::sqrt(error_sum / error_degrees) : unknown;
  }

  double LinearFit::r_squared() const { return total_sum > 0 ? 1 - error_sum / total_sum : unknown; }

  double LinearFit::adjusted_r_squared() const
  {
    const double degrees = static_cast<double>(residuals.size()) - 1;
    return total_sum > 0 && error_degrees > 0 ? 1 - error_sum / error_degrees / (total_sum / degrees) : unknown;
  }

  double LinearFit::press_r_squared() const { return total_sum > 0 ? 1 - press / total_sum : unknown; }

  LinearFit fit(const Eigen::MatrixXd &matrix, const Eigen::VectorXd &response, const std::vector<std::string> &terms)
  {
    if (matrix.rows() < matrix.cols())
      throw base::InputError("fewer runs than terms: " + std::to_string(matrix.rows()) + " runs for " +
                             std::to_string(matrix.cols()) + " terms. Leave out terms, or make more runs.");
    const Eigen::VectorXd scale  = lengths_of(matrix).cwiseInverse();
    const Eigen::MatrixXd scaled = matrix * scale.asDiagonal();
    Factorised            factorised(scaled);
    factorised.setThreshold(dependent);
    if (factorised.rank() < matrix.cols())
      throw base::InputError("the runs do not distinguish these terms: " + aliases(factorised, terms) +
                             ". Leave out terms, or make other runs.");
    LinearFit result;
    result.coefficients           = scale.asDiagonal() * factorised.solve(response);
    const Eigen::MatrixXd inverse = factorised.matrixR()
                                      .topLeftCorner(matrix.cols(), matrix.cols())
                                      .template triangularView<Eigen::Upper>()
                                      .solve(Eigen::MatrixXd::Identity(matrix.cols(), matrix.cols()));
    const Eigen::MatrixXd unscaled = scale.asDiagonal() * (factorised.colsPermutation() * inverse);
    result.unscaled_covariance     = unscaled * unscaled.transpose();
    result.fitted                  = matrix * result.coefficients;
    result.residuals               = response - result.fitted;
    result.error_sum               = result.residuals.squaredNorm();
    result.total_sum               = (response.array() - response.mean()).matrix().squaredNorm();
    result.error_degrees           = static_cast<int>(matrix.rows() - matrix.cols());
    find_leverage(result, factorised);
    find_studentised(result);
    result.press = (response - result.left_out).squaredNorm();
    return result;
  }
} // namespace statistics
