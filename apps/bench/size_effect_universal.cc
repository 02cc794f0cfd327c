#include "apps/bench/size_effect_universal.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace apps
{
  namespace
  {
    /** Constants G_f, c_f, f_inf, D_b, r. */
    double
    log_of_universal(const Eigen::VectorXd &k, const SizeStrength &beam, const double smoothness, const double young)
    {
      const double G = k[0], c = k[1], f = k[2], layer = k[3], r = k[4];
      const double deep     = 1 - smoothness;
      const double resisted = shape_of_crack(beam.notch) * beam.depth + deep * c * slope_of_shape(beam.notch) +
                              smoothness * young * G / (f * f);
      return 0.5 * std::log(young * G / resisted) + std::log1p(r * smoothness * layer / beam.depth) / r;
    }

    std::vector<SizeStrength> of_kind(const std::vector<SizeStrength> &beams, const bool notched)
    {
      std::vector<SizeStrength> kept;
      std::copy_if(beams.begin(), beams.end(), std::back_inserter(kept),
                   [notched](const SizeStrength &beam) { return (beam.notch > 0) == notched; });
      return kept;
    }
  } // namespace

  double UniversalLaw::at(const SizeStrength &beam, const double smoothness) const
  {
    Eigen::VectorXd constants(5);
    constants << energy.value, zone.value, strength.value, layer.value, exponent.value;
    return std::exp(log_of_universal(constants, beam, smoothness, young));
  }

  UniversalLaw fitted_universal(const std::vector<SizeStrength> &beams, const double young)
  {
    const std::vector<SizeStrength> notched = of_kind(beams, true);
    const CrackOfLaw                crack   = crack_of(fitted_bazant(notched), notched.front().notch, young);
    const SmoothBeamLaw             smooth  = fitted_smooth(of_kind(beams, false));
    const FittedConstants           found =
      fitted_constants(beams,
                       {around(crack.energy),
                        around(crack.zone),
                        around(smooth.strength.value),
                        around(smooth.layer.value),
                        {1, 0.2, 5}},
                       [young](const Eigen::VectorXd &constants, const SizeStrength &beam) {
                         return log_of_universal(constants, beam, beam.notch > 0 ? 0 : 1, young);
                       });
    return {
      young,        found.constants[0], found.constants[1], found.constants[2], found.constants[3], found.constants[4],
      found.scatter};
  }
} // namespace apps
