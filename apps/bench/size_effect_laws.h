#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace apps
{
  /** Nominal strength of a size of similar beams: a run of a packing each. */
  struct SizeStrength
  {
    double depth = 0, strength = 0; ///< D [m], sigma_N = 3 P S/(2 b D^2) [Pa]
  };

  /** A number and half the width of the band that holds it with 95 %. */
  struct Estimate
  {
    double value = std::numeric_limits<double>::quiet_NaN(), half_width = std::numeric_limits<double>::quiet_NaN();
  };

  /** sigma_N = sigma_0 (1 + (D/D_0)^r)^(-1/(2 r)) (doc/theory/size-effect.md, 1). */
  struct SizeEffectLaw
  {
    Estimate strength, depth;   ///< sigma_0 [Pa], D_0 [m]
    Estimate exponent = {1, 0}; ///< r
    double   scatter  = 0;      ///< standard deviation of ln sigma_N about it [-]

    double at(double depth) const; ///< [Pa]
  };

  /**
   * Bazant (1984), J. Eng. Mech. 110, 518: r = 1, by least squares of ln sigma_N from all beams, begun at the line 1/sigma_N^2 over D.
   * @throws base::InputError for fewer than three beams, or sizes that are all the same, or strengths that grow with the size
   */
  SizeEffectLaw fitted_bazant(const std::vector<SizeStrength> &beams);
  /** Bazant (1985): r free, from 0.2 to 5, where the sizes are at least three. @throws as fitted_bazant() */
  SizeEffectLaw fitted_with_exponent(const std::vector<SizeStrength> &beams);

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
} // namespace apps
