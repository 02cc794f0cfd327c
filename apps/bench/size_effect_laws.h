#pragma once

#include "apps/bench/size_effect_fit.h"

#include <vector>

namespace apps
{
  /** Of beams with a deep notch: sigma_N = sigma_0 (1 + (D/D_0)^r)^(-1/(2 r)) (doc/theory/size-effect.md, 1). */
  struct SizeEffectLaw
  {
    Estimate strength, depth;      ///< sigma_0 [Pa], D_0 [m]
    Estimate exponent = {1, 0, 0}; ///< r
    double   scatter  = 0;         ///< standard deviation of ln sigma_N about it [-]

    double at(double depth) const; ///< [Pa]
  };

  /**
   * Bazant (1984), J. Eng. Mech. 110, 518: r = 1, by least squares of ln sigma_N from all beams, begun at the line 1/sigma_N^2 over D.
   * @throws base::InputError for fewer than three beams, or sizes that are all the same, or strengths that grow with the size
   */
  SizeEffectLaw fitted_bazant(const std::vector<SizeStrength> &beams);
  /** Bazant (1985): r free, from 0.2 to 5, where the sizes are at least three. @throws as fitted_bazant() */
  SizeEffectLaw fitted_with_exponent(const std::vector<SizeStrength> &beams);

  /** Of beams without a notch: sigma_N = f_inf (1 + r D_b/D)^(1/r) (doc/theory/size-effect.md, 4), Bazant's type 1. */
  struct SmoothBeamLaw
  {
    Estimate strength, layer;      ///< f_inf [Pa], D_b: depth of the layer that cracks before the peak [m]
    Estimate exponent = {1, 0, 0}; ///< r
    double   scatter  = 0;         ///< standard deviation of ln sigma_N about it [-]

    double at(double depth) const; ///< [Pa]
  };

  /**
   * Bazant, Li (1995), J. Struct. Eng. 121, 739: r = 1; Bazant, Novak (2000), J. Eng. Mech. 126, 166: r free, from 0.2 to 5. By least squares
   * of ln sigma_N from all beams, begun at the line sigma_N over 1/D.
   * @throws as fitted_bazant()
   */
  SmoothBeamLaw fitted_smooth(const std::vector<SizeStrength> &beams);
  SmoothBeamLaw fitted_smooth_with_exponent(const std::vector<SizeStrength> &beams);

  /**
   * Of a beam on supports 2.5 times its depth apart, notched to the part `alpha` of it: g = pi alpha F^2, by which K_I^2 = sigma_N^2 D g
   * (RILEM TC 89-FMT, 1990, Mater. Struct. 23, 461).
   */
  double shape_of_crack(double alpha);
  double slope_of_shape(double alpha); ///< g', by alpha

  /** What a crack needs and how long its zone is, of a law of size effect (doc/theory/size-effect.md, 2). */
  struct CrackOfLaw
  {
    double energy = 0, zone = 0; ///< G_f [J/m^2], c_f [m]
  };
  /** @param young of the material [Pa] */
  CrackOfLaw crack_of(const SizeEffectLaw &law, double alpha, double young);

  /** The law of r = 1 that one size decides: its strength, and the energy that breaking it took. @throws base::InputError where no zone length gives both */
  SizeEffectLaw law_of_one_size(const SizeStrength &beam, double energy, double alpha, double young);
  /** The law of r = 1 without a notch: D_b of the zone of a crack that begins at the face (doc/theory/size-effect.md, 4), and the strength of one size. */
  SmoothBeamLaw smooth_law_of_one_size(const SizeStrength &beam, double zone);
} // namespace apps
