#include "apps/bench/size_effect_laws.h"

#include "apps/bench/line_fit.h"
#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    constexpr ConstantRange of_exponents = {1, 0.2, 5};

    double exponent_in(const Eigen::VectorXd &constants) { return constants.size() > 2 ? constants[2] : 1; }

    double log_of_notched(const Eigen::VectorXd &constants, const SizeStrength &beam)
    {
      const double r = exponent_in(constants);
      return std::log(constants[0]) - std::log1p(std::pow(beam.depth / constants[1], r)) / (2 * r);
    }

    double log_of_smooth(const Eigen::VectorXd &constants, const SizeStrength &beam)
    {
      const double r = exponent_in(constants);
      return std::log(constants[0]) + std::log1p(r * constants[1] / beam.depth) / r;
    }

    double least_depth(const std::vector<SizeStrength> &beams)
    {
      return std::min_element(beams.begin(), beams.end(),
                              [](const SizeStrength &a, const SizeStrength &b) { return a.depth < b.depth; })
        ->depth;
    }

    /** A line whose slope says that strengths fall with the size. */
    FittedLine falling(const std::vector<SizeStrength> &beams,
                       double (*const abscissa)(const SizeStrength &),
                       double (*const ordinate)(const SizeStrength &))
    {
      demand_sizes(beams);
      std::vector<double> x, y;
      for (const SizeStrength &beam : beams)
        {
          x.push_back(abscissa(beam));
          y.push_back(ordinate(beam));
        }
      const FittedLine line = line_through(x, y);
      if (!(line.slope > 0))
        throw base::InputError("the strength does not fall with the size: there is no size effect to fit.");
      return line;
    }

    std::vector<ConstantRange> start_of_notched(const std::vector<SizeStrength> &beams)
    {
      const FittedLine line = falling(
        beams, [](const SizeStrength &b) { return b.depth; },
        [](const SizeStrength &b) { return 1 / (b.strength * b.strength); });
      // A line that starts below zero is a crack alone: D_0 is then small.
      const double depth = std::max(line.intercept / line.slope, 0.05 * least_depth(beams));
      return {around(1 / std::sqrt(line.slope * depth)), around(depth)};
    }

    std::vector<ConstantRange> start_of_smooth(const std::vector<SizeStrength> &beams)
    {
      const FittedLine line = falling(
        beams, [](const SizeStrength &b) { return 1 / b.depth; }, [](const SizeStrength &b) { return b.strength; });
      // A line that ends below zero would have large beams without any strength.
      const double least =
        std::min_element(beams.begin(), beams.end(), [](const SizeStrength &a, const SizeStrength &b) {
          return a.strength < b.strength;
        })->strength;
      const double strength = std::max(line.intercept, 0.1 * least);
      return {around(strength), around(line.slope / strength)};
    }

    template <typename Law>
    Law in_members(const FittedConstants &found, Estimate Law::*const extent)
    {
      Law law;
      law.strength = found.constants[0];
      law.*extent  = found.constants[1];
      if (found.constants.size() > 2)
        law.exponent = found.constants[2];
      law.scatter = found.scatter;
      return law;
    }
  } // namespace

  double SizeEffectLaw::at(const double size) const
  {
    return std::exp(log_of_notched(Eigen::Vector3d(strength.value, depth.value, exponent.value), {size}));
  }

  double SmoothBeamLaw::at(const double size) const
  {
    return std::exp(log_of_smooth(Eigen::Vector3d(strength.value, layer.value, exponent.value), {size}));
  }

  SizeEffectLaw fitted_bazant(const std::vector<SizeStrength> &beams)
  {
    return in_members(fitted_constants(beams, start_of_notched(beams), log_of_notched), &SizeEffectLaw::depth);
  }

  SizeEffectLaw fitted_with_exponent(const std::vector<SizeStrength> &beams)
  {
    std::vector<ConstantRange> ranges = start_of_notched(beams);
    ranges.push_back(of_exponents);
    return in_members(fitted_constants(beams, ranges, log_of_notched), &SizeEffectLaw::depth);
  }

  SmoothBeamLaw fitted_smooth(const std::vector<SizeStrength> &beams)
  {
    return in_members(fitted_constants(beams, start_of_smooth(beams), log_of_smooth), &SmoothBeamLaw::layer);
  }

  SmoothBeamLaw fitted_smooth_with_exponent(const std::vector<SizeStrength> &beams)
  {
    std::vector<ConstantRange> ranges = start_of_smooth(beams);
    ranges.push_back(of_exponents);
    return in_members(fitted_constants(beams, ranges, log_of_smooth), &SmoothBeamLaw::layer);
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

  SmoothBeamLaw smooth_law_of_one_size(const SizeStrength &beam, const double zone)
  {
    // g'(0) = pi F^2 and g''(0) = 4 pi F F' of the polynomial, with F(0) = 1 and F'(0) = -1: D_b = -g''(0)/(4 g'(0)) c_f.
    SmoothBeamLaw law;
    law.layer.value    = zone;
    law.strength.value = beam.strength / (1 + zone / beam.depth);
    return law;
  }
} // namespace apps
