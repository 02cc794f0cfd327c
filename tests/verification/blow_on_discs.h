#pragma once

#include <string>
#include <vector>

namespace blow_on_discs
{
  /** A bond that reached its limit strain. */
  struct Break
  {
    double time; ///< [s]
    double x, y; ///< its middle [m]
  };

  struct Blow
  {
    std::string beam, impactor; ///< files of x, y, z, radius; discs of the impactor are one rigid body
    double      until;          ///< [s]
    double      step;           ///< [s]
    double      speed = 50;     ///< of the impactor [m/s]
  };

  /**
   * The published impact of a rigid clump on discs that nothing holds (J. Stransky 2018, 5.2), written from the formulas alone and sharing nothing with
   * the program: bonds of E A / L, shear in the plane by velocities at their middle, gone at the limit strain; contacts of the clump and of
   * discs whose bond is gone without tension and with friction; local damping. Breaks in the order of time.
   */
  std::vector<Break> breaks(const Blow &blow);
} // namespace blow_on_discs
