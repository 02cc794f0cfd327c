#pragma once

#include "base/matrix6.h"
#include "dem/network/elastic_network.h"

#include <Eigen/Core>

namespace dem
{
  /** Stiffness for strains with engineering shears, order 11 22 33 23 31 12, tension positive [Pa]; in the plane only 11 22 12 are used. */
  using MacroscopicStiffness = base::Matrix6;

  /** Young's modulus and Poisson's ratio read from a stiffness. */
  struct ElasticConstants
  {
    double young   = 0; ///< E [Pa]
    double poisson = 0; ///< nu [-]
  };

  /** What the closed form needs of a network, sums over links. */
  struct LinkStatistics
  {
    double length_area = 0; ///< sum L A / V [-]
    int    dimension   = 3;

    /** s = sum L A / (3 V), the measure of link density [-]. */
    double density() const { return length_area / 3; }
  };

  /** @throws std::invalid_argument if the network is not periodic: there is no volume to refer to. */
  LinkStatistics link_statistics(const ElasticNetwork &network);

  /** Moduli of links [Pa]: force over area = modulus times slip over length. */
  struct LinkModuli
  {
    double normal = 0, shear = 0;
  };

  /** Means over the links of a network, each with its length times its area; those of all where all are alike. */
  LinkModuli mean_moduli(const ElasticNetwork &network);

  /**
   * Closed form for links without preferred direction. In space E = s En (2 En + 3 Gn)/(4 En + Gn), nu = (En - Gn)/(4 En +
   * Gn), Stransky (2018), (3.38), after Kuhl et al. (2001); in the plane, read as plane stress, E = S En (En + Gn)/(3 En +
   * Gn), nu = (En - Gn)/(3 En + Gn) with S = sum L A / V.
   *
   * @param normal_modulus En [Pa]  @param shear_ratio Gn/En
   */
  ElasticConstants closed_form(const LinkStatistics &statistics, double normal_modulus, double shear_ratio);

  /** The same as a stiffness; in the plane that of plane stress. */
  MacroscopicStiffness
  closed_form_stiffness(const LinkStatistics &statistics, double normal_modulus, double shear_ratio);

  /**
   * Stiffness if every particle followed the macroscopic strain without turning, from the actual links: (1/V) sum H^T C H,
   * doc/theory/homogenisation.md, 2. No displacement field costs less than the true one, so this is an upper bound.
   */
  MacroscopicStiffness affine_stiffness(const ElasticNetwork &network);
} // namespace dem
