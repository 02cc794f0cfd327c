#pragma once

#include "apps/bench/size_effect_laws.h"

#include <vector>

namespace apps
{
  /**
   * Beams with notches of any depth, and with none (doc/theory/size-effect.md, 5): Bazant, Yu (2009), J. Eng. Mech. 135, 78, for beams much
   * deeper than l_p, the length that keeps the strength of the smallest beams finite there.
   */
  struct UniversalLaw
  {
    double   young = 0;       ///< E of the material [Pa]
    Estimate energy, zone;    ///< G_f [J/m^2], c_f [m]: what a notched beam hangs on
    Estimate strength, layer; ///< f_inf [Pa], D_b [m]: what one without a notch does
    Estimate exponent;        ///< r
    double   scatter = 0;     ///< standard deviation of ln sigma_N about it [-]

    /**
     * Nominal strength [Pa].
     * @param beam its strength is not looked at
     * @param smoothness lambda, 1 of a beam without a notch, 0 of one with a deep notch; what is between belongs to shallow ones
     */
    double at(const SizeStrength &beam, double smoothness) const;
    double at(const SizeStrength &beam) const { return at(beam, beam.notch > 0 ? 0 : 1); }
  };

  /**
   * All five constants from beams of both kinds at once, with deep notches and without, by least squares of ln sigma_N.
   * @param young of the material [Pa] @throws base::InputError as fitted_bazant() of those with and fitted_smooth() of those without
   */
  UniversalLaw fitted_universal(const std::vector<SizeStrength> &beams, double young);
} // namespace apps
