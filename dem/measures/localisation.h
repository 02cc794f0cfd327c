#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace dem
{
  /** Where in a periodic cell something (say, dissipation) is gathered: the family of parallel bands that it fits best. */
  struct Band
  {
    std::array<int, 3> wave   = {0, 0, 0}; ///< k: the bands repeat with phase k . H^-1 x
    Eigen::Vector3d    normal = {0, 0, 0}; ///< unit
    /** Mean resultant length |sum w exp(2 pi i k.s)| / sum w in [0, 1]: 0 spread evenly, 1 all in one plane. */
    double concentration = 0;
    double place         = 0; ///< phase of the middle of the band, in [0, 1)
    double period        = 0; ///< distance of one band to the next [m]
    double thickness     = 0; ///< of the even band with this concentration [m]
    /** Probability that as many places drawn at random show such a concentration along any of the 13 waves (Rayleigh test). */
    double by_chance = 1;
    /** Share of the places that takes part: (sum w)^2/(n sum w^2); 1 when all do alike. */
    double participation = 0;
  };

  /**
   * Mean resultant length over the 13 plane waves with k in {-1, 0, 1}^3 that fit the cell, the largest of them (directional statistics:
   * Mardia and Jupp, 2000, Directional Statistics, 2.3 and 6.3.1). Periodic by construction: a band across the cell's boundary counts
   * like any other. Only bands that close on themselves in the cell are sought, as only those can form in it.
   *
   * @param base H, columns are the base vectors [m]; in the plane (dimension 2) waves along the third are left out
   * @param weights not negative; none positive: a band of concentration 0
   */
  Band strongest_band(const Eigen::Matrix3d              &base,
                      const std::vector<Eigen::Vector3d> &places,
                      const std::vector<double>          &weights,
                      int                                 dimension = 3);
} // namespace dem
