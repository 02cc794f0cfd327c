#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace dem
{
  /**
   * Two particles near each other, each pair named once: first < second, or first == second (a particle and its own
   * periodic image) with the first non-zero component of the shift positive.
   */
  struct NeighbourPair
  {
    std::int32_t               first, second;
    std::array<std::int8_t, 3> shift; ///< k: the branch vector is x_second + H k - x_first; 0 in a free packing
  };

  /** A range of particles whose pairs are wanted: those of which it has an end. By default all particles. */
  struct PairsOf
  {
    std::int32_t begin = 0, end = std::numeric_limits<std::int32_t>::max();

    bool has(const std::int32_t particle) const { return particle >= begin && particle < end; }
    bool has(const NeighbourPair &pair) const { return has(pair.first) || has(pair.second); }
  };

  bool operator==(const NeighbourPair &a, const NeighbourPair &b);
  bool operator<(const NeighbourPair &a, const NeighbourPair &b); ///< by first, second, shift

  /**
   * All pairs with |x_K + H k - x_J| < factor (r_J + r_K) + skin, a tie (tie.h) excluded, each periodic image a pair of its own,
   * however small the cell (doc/theory/links.md, 2). Sorted, the same for any number of threads and any translation.
   *
   * Particles are sorted into one uniform grid per size class (reach halves from class to class); each searches its own
   * class and the larger ones, so that the cost does not grow with the size ratio (hierarchical grid: Krijgsman, Ogarko,
   * Luding, 2014, Comput. Part. Mech. 1, 357). For the pairs of a range only what may be within its reach is sorted and searched.
   *
   * @param centre [m], may lie outside the cell.
   * @param radius [m], > 0.
   * @param factor >= 0 [-] and skin >= 0 [m].
   * @param cell edge lengths of the periodic box [m]; an infinite edge: no repetition along it; absent: a free packing.
   * @param of whose pairs
   * @throws std::invalid_argument if the columns differ in length, an argument is out of its range or there are more than
   *         2^31 - 1 particles; NumericalError naming the particle (from 1) whose centre or radius is not finite;
   *         std::range_error if a shift does not fit its type, that is particles have strayed more than 127 cells apart.
   */
  std::vector<NeighbourPair> find_pairs(const std::vector<Eigen::Vector3d>   &centre,
                                        const std::vector<double>            &radius,
                                        double                                factor,
                                        double                                skin,
                                        const std::optional<Eigen::Vector3d> &cell,
                                        const PairsOf                        &of = {});

  /** The same in a parallelepiped cell H, columns are its base vectors [m]; det H > 0. */
  std::vector<NeighbourPair> find_pairs_sheared(const std::vector<Eigen::Vector3d> &centre,
                                                const std::vector<double>          &radius,
                                                double                              factor,
                                                double                              skin,
                                                const Eigen::Matrix3d              &cell,
                                                const PairsOf                      &of = {});
} // namespace dem
