#pragma once

#include "apps/statistics/polynomial.h"

#include <filesystem>
#include <string>

namespace apps
{
  /** A response surface as analysis.json holds it. */
  struct StoredSurface
  {
    std::string            response, unit;
    statistics::Polynomial polynomial;
    Eigen::VectorXd        coefficients; ///< of physical variables
    statistics::Box        box; ///< of the runs that it was fitted to, in the order of the polynomial's factors

    double          value(const Eigen::VectorXd &point) const { return polynomial.at(point).dot(coefficients); }
    Eigen::VectorXd gradient(const Eigen::VectorXd &point) const
    {
      return polynomial.derivatives(point).transpose() * coefficients;
    }
  };

  /** @throws base::InputError for a file that holds no surface, naming it */
  StoredSurface read_surface(const std::filesystem::path &file);
} // namespace apps
