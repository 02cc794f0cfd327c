#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dem
{
  /** How unevenly directions are spread over the sphere. */
  struct DirectionStatistics
  {
    std::size_t links = 0;
    Eigen::Matrix3d
           density; ///< D of the density (1 + n.D.n)/(4 pi) nearest to the directions, D = 15/2 (<n (x) n> - 1/3)
    double anisotropy = 0; ///< sqrt(3/2 D:D), 0: even
    /** Root mean square of the anisotropy that as many directions drawn evenly at random show, 7.5/sqrt(links). */
    double by_chance = 0;
  };

  /** @throws std::invalid_argument without a direction. Density: Kanatani (1984), Int. J. Eng. Sci. 22, 149. */
  DirectionStatistics direction_statistics(const std::vector<Eigen::Vector3d> &directions);

  /** Links counted by their direction about an axis. */
  struct AzimuthHistogram
  {
    std::vector<std::int64_t> count; ///< equal bins over [0, pi)
    double                    mean = 0, deviation = 0 /* of the sample */;
    std::int64_t              least = 0, most = 0;
  };

  /**
   * Directions with |n.axis| <= steepest, projected along the coordinate axis and counted in equal bins over [0, pi), the angle running
   * from the next axis (x about z) towards the one after (doc/theory/stress-and-fabric.md, 4).
   * @param axis 0, 1, 2 @param bins >= 2
   */
  AzimuthHistogram
  azimuth_histogram(const std::vector<Eigen::Vector3d> &directions, int axis, int bins, double steepest);
} // namespace dem
