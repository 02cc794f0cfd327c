#pragma once

#include <string>
#include <vector>

namespace dem
{
  /** One material of a cubic metre of fresh concrete. */
  struct Constituent
  {
    std::string name;
    double      mass    = 0; ///< per volume of concrete [kg/m^3], >= 0
    double      density = 0; ///< of the material itself [kg/m^3], > 0
  };

  /** What a cubic metre of concrete is mixed of. */
  struct Mix
  {
    std::vector<Constituent> constituents;
    double                   unit_weight = 0; ///< measured on the fresh concrete [kg/m^3]; 0: not measured
    double                   air         = 0; ///< part of the volume, where there is no unit weight [-], in [0, 1)
  };

  /** The same as parts of the volume of the concrete. */
  struct MixVolumes
  {
    std::vector<double> fractions; ///< of each constituent [-], in the mix's order
    double              voids = 0; ///< 1 - their sum [-]
  };

  /**
   * Parts of the volume: v_i = (m_i/rho_i) / sum(m_j/rho_j) (1 - voids), with voids = 1 - unit weight / sum(m_j) where the fresh concrete was
   * weighed, and the air content where it was not (doc/theory/mesostructure.md, 1).
   *
   * Weighed concrete may come out a little heavier than its batch (voids below zero): masses and densities are known to a few per mille.
   * @throws base::InputError for masses or densities that are none, an air content outside [0, 1), or voids outside [-0.01, 0.5]
   */
  MixVolumes volumes_of(const Mix &mix);
} // namespace dem
