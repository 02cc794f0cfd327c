#pragma once

#include <Eigen/Core>

namespace optimisation
{
  /**
   * A test that costs nothing: stress at 12 equal strains up to 2, c_1 x exp(-(x/c_2)^c_3/c_3), which rises with the modulus c_1, peaks at
   * the strain c_2 and softens the faster the larger c_3.
   */
  Eigen::VectorXd softening_stresses(const Eigen::Vector3d &constants);

  /** Known constants are sought again from what the test gives for them. */
  struct SyntheticCalibrations
  {
    double deviation = 0.02; ///< of what is measured; the largest stress is 1.8
    double model_scatter =
      0; ///< of a run, which any change of its constants, however small, draws anew: of specimens that break
    bool known = true; ///< whether the deviation is given
    int  count = 200;
  };

  /** Of so many calibrations: how often the truth lies inside the bands of 95 %. */
  struct Coverage
  {
    Eigen::Vector3i inside = Eigen::Vector3i::Zero(); ///< of each constant
    Eigen::Vector3i by_residuals =
      Eigen::Vector3i::Zero(); ///< by bands that take the end of the search for that of a smooth model
    int rough = 0;             ///< calibrations in which noise of the model was found to matter
  };

  /** Sought as `breccia calibrate` does by default (doc/theory/studies.md, 8); the same in every call. */
  Coverage coverage_of(const SyntheticCalibrations &requested);
} // namespace optimisation
