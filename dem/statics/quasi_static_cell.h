#pragma once

#include "dem/statics/damaging_links.h"

#include <string>
#include <vector>

namespace dem
{
  /** How a periodic cell is loaded along one axis without any inertia. */
  struct QuasiStaticParameters
  {
    int    axis         = 0;    ///< 0, 1, 2
    double sign         = 1;    ///< +1: tension, -1: compression
    bool   lateral_free = true; ///< the other five stresses vanish; off: the other five strains do

    double strain_step = 0; ///< of the axis before links damage [-], > 0
    double opening_step =
      0.2;                 ///< mean growth of the damaging links' strain in a later step, in limit elastic strains, > 0
    double end_strain = 0; ///< magnitude of the axial strain at which to stop [-], > 0
    double end_stress = 0.5; ///< stop when the stress has fallen to this part of its peak, in [0, 1)

    double tolerance      = 1e-6; ///< unbalanced force over link forces, root of sums of squares
    int    max_iterations = 200;  ///< of one step
  };

  /** What kept a step on the path. */
  enum class StepControl
  {
    strain,  ///< the axial strain was prescribed
    opening, ///< the mean strain of damaging links was prescribed: it grows though stress and axial strain may fall
    relaxed ///< no equilibrium near by was found; the axial strain was held and damage let run to the next one (a cascade)
  };

  std::string name_of(StepControl control);

  /** One equilibrium of the path. */
  struct QuasiStaticPoint
  {
    Eigen::Matrix<double, 6, 1> strain      = Eigen::Matrix<double, 6, 1>::Zero(); ///< [-]
    Eigen::Matrix<double, 6, 1> stress      = Eigen::Matrix<double, 6, 1>::Zero(); ///< [Pa]
    double                      mean_damage = 0, dissipated = 0 /* [J] */, stored = 0 /* [J] */;
    StepControl                 control    = StepControl::strain;
    int                         iterations = 0;
    double                      residual   = 0;
  };

  /**
   * Equilibrium path of a periodic cell of CPM links under uniaxial loading, past the peak.
   *
   * Each step is solved by Newton-like iterations with the secant stiffness (positive definite, homogenisation specification
   * 3.4), all macroscopic strains and the residual being one solution with several load cases. Past the onset of damage the
   * step is controlled by the mean strain of the links that damaged in the step before (indirect displacement control: de
   * Borst, 1987, Comput. Struct. 25, 211), so that snap-back is followed. A step that does not converge is halved; one
   * that is too small is relaxed at fixed axial strain, and the path says so.
   *
   * @throws InputError for parameters out of range; NumericalError if even the relaxation finds no equilibrium.
   */
  std::vector<QuasiStaticPoint> load_quasi_statically(const ElasticNetwork        &network,
                                                      const CpmParameters         &law,
                                                      const QuasiStaticParameters &parameters);
} // namespace dem
