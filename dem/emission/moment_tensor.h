#pragma once

#include "dem/emission/emission_event.h"

#include <Eigen/Core>

#include <vector>

/** What a seismologist reads from a moment tensor (doc/theory/acoustic-emission.md, 2). */
namespace dem
{
  /** M_0 = sqrt(sum m_i^2/2) of the eigenvalues of a symmetric tensor [N m] (Silver and Jordan, 1982). */
  double scalar_moment(const Eigen::Matrix3d &moment);

  /** M_w = (log10 M_0 - 9.1)/1.5 (Hanks and Kanamori, 1979). @param scalar_moment [N m] > 0 */
  double moment_magnitude(double scalar_moment);

  /** Of those events that have a moment, in their order. */
  std::vector<double> magnitudes_of(const std::vector<EmissionEvent> &events);

  /**
   * tr M/(|tr M| + sum |m_i*|), m_i* the eigenvalues of the deviator (Feignier and Young, 1992): 1 explosion, -1 implosion, 0 shear; above 0.3
   * a source counts as tensile, below -0.3 as implosive. 0 of no moment.
   */
  double isotropic_share(const Eigen::Matrix3d &moment);
} // namespace dem
