#include "apps/bench/size_effect_universal.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace apps
{
  namespace
  {
    /** Constants G_f, c_f, f_inf, D_b, r. */
    double log_of_universal(const Eigen::VectorXd &k,
                            const SizeStrength    &beam,
                            const double           smoothness,
                            const double           young,
                            const double           smallest)
    {
      const double G = k[0], c = k[1], f = k[2], layer = k[3], r = k[4];
      const double deep     = 1 - smoothness;
      const double resisted = shape_of_crack(beam.notch) * beam.depth + deep * c * slope_of_shape(beam.notch) +
                              smoothness * young * G / (f * f);
      return 0.5 * std::log(young * G / resisted) + std::log1p(r * smoothness * layer / (beam.depth + smallest)) / r;
    }

    std::vector<SizeStrength> of_notch(const std::vector<SizeStrength> &beams, const double notch)
    {
      std::vector<SizeStrength> kept;
      std::copy_if(beams.begin(), beams.end(), std::back_inserter(kept),
                   [notch](const SizeStrength &beam) { return beam.notch == notch; });
      return kept;
    }

    double deepest_notch(const std::vector<SizeStrength> &beams)
    {
      double deepest = 0;
      for (const SizeStrength &beam : beams)
        deepest = std::max(deepest, beam.notch);
      return deepest;
    }
  } // namespace

  double UniversalForm::smoothness(const SizeStrength &beam) const
  {
    if (beam.notch == 0)
      return 1;
    return grain > 0 ? std::exp(-std::pow(beam.notch, notch_exponent) * std::pow(beam.depth / grain, size_exponent)) :
                       0.0;
  }

  double UniversalLaw::at(const SizeStrength &beam, const double smoothness) const
  {
    Eigen::VectorXd constants(5);
    constants << energy.value, zone.value, strength.value, layer.value, exponent.value;
    return std::exp(log_of_universal(constants, beam, smoothness, young, form.smallest));
  }

  UniversalLaw fitted_universal(const std::vector<SizeStrength> &beams, const double young, const UniversalForm &form)
  {
    const double          deepest = deepest_notch(beams);
    const CrackOfLaw      crack   = crack_of(fitted_bazant(of_notch(beams, deepest)), deepest, young);
    const SmoothBeamLaw   smooth  = fitted_smooth(of_notch(beams, 0));
    const FittedConstants found =
      fitted_constants(beams,
                       {around(crack.energy),
                        around(crack.zone),
                        around(smooth.strength.value),
                        around(smooth.layer.value),
                        {1, 0.2, 5}},
                       [young, &form](const Eigen::VectorXd &constants, const SizeStrength &beam) {
                         return log_of_universal(constants, beam, form.smoothness(beam), young, form.smallest);
                       });
    return {young,
            found.constants[0],
            found.constants[1],
            found.constants[2],
            found.constants[3],
            found.constants[4],
            found.scatter,
            form};
  }
} // namespace apps
