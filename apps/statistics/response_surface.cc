#include "apps/statistics/response_surface.h"

#include "apps/statistics/distributions.h"
#include "base/errors.h"

#include <algorithm>
#include <limits>
#include <map>

namespace statistics
{
  namespace
  {
    Eigen::MatrixXd points_of(const std::vector<Factor> &factors)
    {
      Eigen::MatrixXd points(factors.front().values.size(), factors.size());
      for (std::size_t factor = 0; factor < factors.size(); ++factor)
        points.col(factor) = factors[factor].values;
      return points;
    }

    Box box_of(const std::vector<Factor> &factors)
    {
      Box box{Eigen::VectorXd(factors.size()), Eigen::VectorXd(factors.size())};
      for (std::size_t factor = 0; factor < factors.size(); ++factor)
        {
          box.lower[factor] = factors[factor].values.minCoeff();
          box.upper[factor] = factors[factor].values.maxCoeff();
          if (!(box.lower[factor] < box.upper[factor]))
            throw base::InputError("factor " + factors[factor].name +
                                   " has the same value in every run: a surface over it cannot be fitted.");
        }
      return box;
    }

    std::vector<int> runs_without(const std::vector<int> &copies, const int runs)
    {
      std::vector<int> kept;
      for (int run = 0; run < runs; ++run)
        if (std::find(copies.begin(), copies.end(), run) == copies.end())
          kept.push_back(run);
      return kept;
    }

    std::vector<std::vector<int>> groups_at_the_same_point(const Eigen::MatrixXd &points)
    {
      std::map<std::vector<double>, std::vector<int>> groups;
      for (int run = 0; run < points.rows(); ++run)
        {
          const Eigen::RowVectorXd point = points.row(run);
          groups[std::vector<double>(point.begin(), point.end())].push_back(run);
        }
      std::vector<std::vector<int>> all;
      for (const auto &group : groups)
        all.push_back(group.second);
      return all;
    }

    std::optional<LackOfFit>
    lack_of_fit(const Eigen::MatrixXd &points, const Eigen::VectorXd &response, const LinearFit &fit)
    {
      LackOfFit found;
      for (const std::vector<int> &group : groups_at_the_same_point(points))
        {
          double mean = 0;
          for (const int run : group)
            mean += response[run] / group.size();
          for (const int run : group)
            found.pure_error += (response[run] - mean) * (response[run] - mean);
          found.pure_degrees += static_cast<int>(group.size()) - 1;
        }
      found.lack         = fit.error_sum - found.pure_error;
      found.lack_degrees = fit.error_degrees - found.pure_degrees;
      if (found.pure_degrees < 1 || found.lack_degrees < 1)
        return std::nullopt;
      found.f = found.pure_error > 0 ? (found.lack / found.lack_degrees) / (found.pure_error / found.pure_degrees) :
                                       std::numeric_limits<double>::quiet_NaN();
      found.p = f_probability_above(found.f, found.lack_degrees, found.pure_degrees);
      return found;
    }
  } // namespace

  ResponseSurface fit_surface(const std::vector<Factor> &factors,
                              const Eigen::VectorXd     &response,
                              const Degree               degree,
                              const std::vector<int>    &copies)
  {
    std::vector<std::string> names;
    for (const Factor &factor : factors)
      names.push_back(factor.name);
    const Box             box    = box_of(factors);
    const Eigen::MatrixXd points = points_of(factors);
    const Eigen::MatrixXd coded =
      (points.rowwise() - box.centre().transpose()) * box.half().cwiseInverse().asDiagonal();
    const Polynomial polynomial = degree == Degree::linear ? Polynomial::linear(names) : Polynomial::quadratic(names);
    ResponseSurface  surface{polynomial, box, {}, {}, {}, {}, {}, {}};
    surface.fit                    = fit(polynomial.matrix(coded), response, polynomial.term_names());
    const Eigen::MatrixXd decoding = polynomial.decoding(box);
    const double          scatter  = surface.fit.standard_error();
    surface.coded                  = surface.fit.coefficients;
    surface.coded_standard_errors  = scatter * surface.fit.unscaled_covariance.diagonal().cwiseSqrt();
    surface.coefficients           = decoding * surface.coded;
    surface.standard_errors =
      scatter * (decoding * surface.fit.unscaled_covariance * decoding.transpose()).diagonal().cwiseSqrt();
    const std::vector<int> kept = runs_without(copies, static_cast<int>(points.rows()));
    if (kept.size() > polynomial.size())
      {
        const Eigen::MatrixXd own_matrix   = polynomial.matrix(coded(kept, Eigen::all));
        const Eigen::VectorXd own_response = response(kept);
        surface.lack_of_fit =
          lack_of_fit(points(kept, Eigen::all), own_response, fit(own_matrix, own_response, polynomial.term_names()));
      }
    return surface;
  }
} // namespace statistics
