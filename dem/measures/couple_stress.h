#pragma once

#include "dem/measures/loads.h"

#include <vector>

namespace dem
{
  /**
   * Volume times mean couple stress from the links,
   * V mu = x_0 (x) (1 x V sigma) + sum l (x) c + sum [x_K (x) ((c - x_K) x f) - x_J (x) ((c - x_J) x f)] [N m^2]
   * (Stransky, 2018, (4.51), (4.53)).
   *
   * First index: normal of the plane, second: direction of the couple. Does not depend on the origin of coordinates, and equals the
   * external form in equilibrium. Not for periodic cells: there it depends on which image a link is written with.
   *
   * @param centroid x_0 of the averaging volume [m]
   */
  Eigen::Matrix3d couple_stress_moment(const std::vector<LinkLoad> &links, const Eigen::Vector3d &centroid);

  /**
   * The same from the loads on the particles, V mu = x_0 (x) (1 x V sigma) + sum x (x) c (Stransky, 2018, (4.31); in (4.55) a factor
   * V too many is printed).
   * @pre forces and moments of the loads sum to zero
   */
  Eigen::Matrix3d couple_stress_moment(const std::vector<ExternalLoad> &loads, const Eigen::Vector3d &centroid);

  /** A particle of a periodic cell with the moment of its links' forces about its centre. */
  struct ParticleMoment
  {
    Eigen::Vector3d place;  ///< x_P [m]
    Eigen::Vector3d moment; ///< M_P, sum of (c - x_P) x f_on_P [N m]; zero in equilibrium without outer couples
  };

  /**
   * The same in a periodic cell, V mu = x_0 (x) (1 x V sigma) + sum l (x) c - sum_P x_P (x) M_P
   * (doc/theory/stress-and-fabric.md, 2).
   *
   * Does not depend on the image that a link is written with, nor on the origin; in a free assembly it is the internal form.
   * Departure: elsewhere stands + before the last sum; only with - is the form independent of the origin, and equal to
   * (4.53) where no link crosses the cell.
   */
  Eigen::Matrix3d periodic_couple_stress_moment(const std::vector<LinkLoad>       &links,
                                                const std::vector<ParticleMoment> &particles,
                                                const Eigen::Vector3d             &centroid);
} // namespace dem
