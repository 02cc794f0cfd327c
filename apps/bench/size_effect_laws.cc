#include "apps/bench/size_effect_laws.h"

#include "apps/bench/line_fit.h"
#include "apps/optimisation/least_squares_search.h"
#include "apps/statistics/uncertainty.h"
#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    constexpr double probability = 0.95;

    /** By logarithms of sigma_0, D_0 and r, so that none can be negative. */
    double log_strength(const Eigen::VectorXd &place, const double depth)
    {
      const double r = place.size() > 2 ? std::exp(place[2]) : 1;
      return place[0] - std::log1p(std::pow(depth / std::exp(place[1]), r)) / (2 * r);
    }

    Eigen::VectorXd start_of(const std::vector<SizeStrength> &beams)
    {
      std::vector<double> x, y;
      for (const SizeStrength &beam : beams)
        {
          x.push_back(beam.depth);
          y.push_back(1 / (beam.strength * beam.strength));
        }
      const auto [least, most] = std::minmax_element(x.begin(), x.end());
      if (beams.size() < 3 || *least == *most)
        throw base::InputError("a law of size effect needs three beams at least, of two sizes at least.");
      const FittedLine line = line_through(x, y);
      if (!(line.slope > 0))
        throw base::InputError("the strength does not fall with the size: there is no size effect to fit.");
      // A line that starts below zero is a crack alone: D_0 is then small.
      const double depth = std::max(line.intercept / line.slope, 0.05 * *least);
      return Eigen::Vector2d(-0.5 * std::log(line.slope * depth), std::log(depth));
    }

    Estimate exponential_of(const statistics::Uncertainty &of, const Eigen::VectorXd &place, const int which)
    {
      const double value = std::exp(place[which]);
      return {value, value * of.half_width(which, probability)};
    }

    SizeEffectLaw fitted(const std::vector<SizeStrength> &beams, const Eigen::VectorXd &start)
    {
      optimisation::LeastSquaresProblem problem;
      const auto                        n = start.size();
      problem.start                       = start;
      problem.lower                       = start - Eigen::VectorXd::Constant(n, std::log(1e4));
      problem.upper                       = start + Eigen::VectorXd::Constant(n, std::log(1e4));
      if (n > 2)
        {
          problem.lower[2] = std::log(0.2);
          problem.upper[2] = std::log(5.0);
        }
      problem.steps     = Eigen::VectorXd::Constant(n, 1e-5);
      problem.residuals = [&beams](const std::vector<Eigen::VectorXd> &places) {
        std::vector<std::optional<Eigen::VectorXd>> all;
        for (const Eigen::VectorXd &place : places)
          {
            Eigen::VectorXd misfit(static_cast<Eigen::Index>(beams.size()));
            for (std::size_t i = 0; i < beams.size(); ++i)
              misfit[static_cast<Eigen::Index>(i)] = log_strength(place, beams[i].depth) - std::log(beams[i].strength);
            all.emplace_back(misfit);
          }
        return all;
      };
      optimisation::LeastSquaresOptions how;
      how.central_differences                 = true;
      const optimisation::LeastSquaresFit fit = optimisation::least_squares(problem, how);
      statistics::UncertaintyOptions      held;
      for (int i = 0; i < n; ++i)
        if (fit.place[i] <= problem.lower[i] || fit.place[i] >= problem.upper[i])
          held.held.push_back(i);
      const statistics::Uncertainty of =
        statistics::uncertainty(fit.jacobian, fit.residuals, Eigen::VectorXd::Ones(n), held);
      SizeEffectLaw law;
      law.strength = exponential_of(of, fit.place, 0);
      law.depth    = exponential_of(of, fit.place, 1);
      if (n > 2)
        law.exponent = exponential_of(of, fit.place, 2);
      law.scatter = of.scatter;
      return law;
    }
  } // namespace

  double SizeEffectLaw::at(const double size) const
  {
    const double r = exponent.value;
    return strength.value * std::pow(1 + std::pow(size / depth.value, r), -1 / (2 * r));
  }

  SizeEffectLaw fitted_bazant(const std::vector<SizeStrength> &beams) { return fitted(beams, start_of(beams)); }

  SizeEffectLaw fitted_with_exponent(const std::vector<SizeStrength> &beams)
  {
    Eigen::VectorXd start(3);
    start << start_of(beams), 0.0;
    return fitted(beams, start);
  }

  double shape_of_crack(const double a)
  {
    const double F = (1.0 - 2.5 * a + 4.49 * a * a - 3.98 * a * a * a + 1.33 * a * a * a * a) / std::pow(1 - a, 1.5);
    return M_PI * a * F * F;
  }

  double slope_of_shape(const double alpha)
  {
    constexpr double step = 1e-5;
    return (shape_of_crack(alpha + step) - shape_of_crack(alpha - step)) / (2 * step);
  }

  CrackOfLaw crack_of(const SizeEffectLaw &law, const double alpha, const double young)
  {
    const double g = shape_of_crack(alpha), slope = slope_of_shape(alpha), s = law.strength.value;
    return {g * s * s * law.depth.value / young, g / slope * law.depth.value};
  }

  SizeEffectLaw law_of_one_size(const SizeStrength &beam, const double energy, const double alpha, const double young)
  {
    const double g = shape_of_crack(alpha), slope = slope_of_shape(alpha);
    // sigma^2 (g' c + g D) = E G.
    const double zone = (young * energy / (beam.strength * beam.strength) - g * beam.depth) / slope;
    if (!(zone > 0))
      throw base::InputError("the beam bears more than a crack of its work of fracture lets it: no law of one size "
                             "follows.");
    SizeEffectLaw law;
    law.depth.value    = slope / g * zone;
    law.strength.value = std::sqrt(young * energy / (slope * zone));
    return law;
  }
} // namespace apps
