#pragma once

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace fem
{
  /**
   * Weights that average over the points within a radius R: w_ij = V_j (1 - r^2/R^2)^2 / (the same summed over all j), the bell-shaped
   * weight of nonlocal damage (Bazant and Jirasek, 2002; doc/theory/late-transfers.md, 4), normalised over the points that exist.
   */
  class NonlocalWeights
  {
  public:
    NonlocalWeights() = default;

    /// @param volumes of the points [m^3] @param radius R [m], positive
    NonlocalWeights(const std::vector<Eigen::Vector3d> &places, const std::vector<double> &volumes, double radius);

    /// Points with a weight for point i, itself among them, in ascending order, with these weights; their sum is 1.
    const std::vector<std::pair<std::size_t, double>> &row(const std::size_t i) const { return rows[i]; }

    /**
     * Average that counts m times, the value itself 1 - m times: x_i + m sum_j w_ij (x_j - x_i), so that a uniform field stays what
     * it is to the last bit.
     */
    std::vector<double> averaged(const std::vector<double> &values, double m) const;

  private:
    std::vector<std::vector<std::pair<std::size_t, double>>> rows;
  };
}
