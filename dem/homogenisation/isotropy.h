#pragma once

#include "dem/homogenisation/macroscopic_stiffness.h"

namespace dem
{
  /** Elastic constants averaged over the axes, and how far a stiffness is from isotropic; doc/theory/homogenisation.md, 4. */
  struct IsotropyMeasures
  {
    ElasticConstants mean; ///< averages over the axes of the orthotropic reading E_i = 1/C_ii, nu_ij = -C_ji E_i
    double           shear           = 0; ///< average of 1/C of the shears [Pa]
    double           isotropic_shear = 0; ///< E/(2 (1 + nu)) of the averages [Pa]
    double           young_spread    = 0; ///< max |E_i - E| / E, Stransky (2018), (3.65)
    double           poisson_spread  = 0; ///< max |nu_ij - nu|, absolute, as its graphs and tables
    double           shear_spread    = 0; ///< max |G_i - E/(2(1 + nu))| over the latter, (3.67)
    double           off             = 0; ///< largest entry that isotropy would make zero, over E, (3.68)
    double           asymmetry       = 0; ///< max |D - D^T| / E
  };

  /**
   * @param dimension 2: the 3 x 3 part 11 22 12, read as plane stress
   * @throws base::NumericalError if the stiffness is singular: the cell does not resist some strain.
   */
  IsotropyMeasures isotropy_measures(const MacroscopicStiffness &D, int dimension);
} // namespace dem
