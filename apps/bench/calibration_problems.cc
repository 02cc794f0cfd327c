#include "apps/bench/calibration_problems.h"

#include <cmath>

namespace apps
{
  namespace
  {
    Eigen::VectorXd numbers_of(const std::vector<double> &values)
    {
      return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    }

    /** Popovics' curve: modulus at the peak, strain of the peak, brittleness. */
    double popovics(const double x, const double strength, const double peak, const double r)
    {
      return strength * x / peak * r / (r - 1 + std::pow(x / peak, r));
    }

    Eigen::VectorXd crushed_curve(const Eigen::VectorXd &c)
    {
      Eigen::VectorXd stress(50);
      for (int k = 0; k < 50; ++k)
        stress[k] = popovics(0.04 * (k + 1), c[0], c[1], c[2]);
      return stress;
    }

    Eigen::VectorXd crushed_and_pulled(const Eigen::VectorXd &c)
    {
      Eigen::VectorXd stress(100);
      stress.head(50) = crushed_curve(c.head(3));
      stress.tail(50) = 8 * crushed_curve(c.tail(3));
      return stress;
    }

    /** Ripples of one percent of the peak, the same for the same constants. */
    Eigen::VectorXd rippled_curve(const Eigen::VectorXd &c)
    {
      Eigen::VectorXd stress = crushed_curve(c);
      for (int k = 0; k < 50; ++k)
        stress[k] += 0.03 * std::sin(200 * c[0] + 350 * c[1] + 270 * c[2] + 1.7 * k);
      return stress;
    }

    /** Modulus, tensile and compressive strength over modulus, limit strain and cohesion of links. */
    Eigen::VectorXd modulus_and_strengths(const Eigen::VectorXd &c)
    {
      const double pulled        = c[0] * c[1] * (1 + 0.2 * std::exp(-c[2]));
      const double crushed_curve = 4 * pulled + 6 * c[2] * std::sqrt(1 + c[1]);
      return Eigen::Vector3d(c[0] * (1 - 0.1 * c[1]), pulled, crushed_curve);
    }

    CalibrationProblem
    named_problem(const std::string &name, const std::string &meaning, const std::vector<std::vector<double>> &places)
    {
      return {name, meaning, numbers_of(places[0]), numbers_of(places[1]), numbers_of(places[2]), numbers_of(places[3]),
              {},   {}};
    }
  } // namespace

  std::vector<CalibrationProblem> calibration_problems()
  {
    const std::vector<std::vector<double>> three = {{2.75, 0.9, 1.62}, {2, 1.3, 2.5}, {0.5, 0.3, 1.1}, {6, 2, 5}};
    std::vector<CalibrationProblem>        all   = {
               named_problem("curve", "one curve of stress, three constants", three),
               named_problem("two curves", "crushed and pulled, six constants",
                             {{2.75, 0.9, 1.62, 0.3, 0.5, 3},
                              {2, 1.3, 2.5, 0.5, 0.8, 2},
                              {0.5, 0.3, 1.1, 0.1, 0.2, 1.2},
                              {6, 2, 5, 1, 1.5, 6}}),
               named_problem("rippled curve", "one curve whose ripples mislead short differences", three),
               named_problem("figures", "modulus and two strengths", {{3, 1, 2}, {2, 1.5, 3}, {1, 0.3, 0.5}, {6, 3, 6}})};
    const std::vector<Eigen::VectorXd (*)(const Eigen::VectorXd &)> models = {crushed_curve, crushed_and_pulled,
                                                                              rippled_curve, modulus_and_strengths};
    for (std::size_t k = 0; k < all.size(); ++k)
      {
        const auto model = models[k];
        all[k].model     = model;
        all[k].cheap     = [model](const Eigen::VectorXd &c) { return Eigen::VectorXd(1.1 * model(0.98 * c)); };
      }
    return all;
  }
} // namespace apps
