#pragma once

#include "apps/bench/size_effect_laws.h"

#include <vector>

namespace apps
{
  /** What of the universal law neither deep notches nor none decide (doc/theory/size-effect.md, 5): it is given, not fitted. */
  struct UniversalForm
  {
    double grain          = 0; ///< d_a, of the largest aggregate [m]; 0: every notch counts as deep
    double notch_exponent = 1; ///< k
    double size_exponent  = 1; ///< p
    double smallest       = 0; ///< l_p: no beam is stronger than one without depth, of this layer [m]

    /** lambda: 1 of a beam without a notch, exp(-alpha^k (D/d_a)^p) of one with, 0 of a deep one. */
    double smoothness(const SizeStrength &beam) const;
  };

  /** Beams with notches of any depth, and with none: Bazant, Yu (2009), J. Eng. Mech. 135, 78 (doc/theory/size-effect.md, 5). */
  struct UniversalLaw
  {
    double        young = 0;       ///< E of the material [Pa]
    Estimate      energy, zone;    ///< G_f [J/m^2], c_f [m]: what a notched beam hangs on
    Estimate      strength, layer; ///< f_inf [Pa], D_b [m]: what one without a notch does
    Estimate      exponent;        ///< r
    double        scatter = 0;     ///< standard deviation of ln sigma_N about it [-]
    UniversalForm form;

    /**
     * Nominal strength [Pa].
     * @param beam its strength is not looked at
     * @param smoothness lambda, from 0 to 1
     */
    double at(const SizeStrength &beam, double smoothness) const;
    double at(const SizeStrength &beam) const { return at(beam, form.smoothness(beam)); }
  };

  /**
   * All five constants from beams with deep notches and without at once, and others if the form knows of them, by least squares of ln sigma_N.
   * @param young of the material [Pa]
   * @throws base::InputError as fitted_bazant() of those with the deepest notch and fitted_smooth() of those without
   */
  UniversalLaw
  fitted_universal(const std::vector<SizeStrength> &beams, double young, const UniversalForm &form = UniversalForm());
} // namespace apps
