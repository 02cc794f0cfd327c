#pragma once

#include "base/column.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
  /**
   * A regular grid of cubic B-splines over places that stay: spreads what places carry over its knots, and gathers at the places what knots
   * have, by the same weights (doc/theory/volume-coupling.md, 4). Values are records of four numbers, of which the last is free.
   *
   * Same input, same bits, for any number of threads.
   */
  class SplineGrid
  {
  public:
    static constexpr std::size_t record = 4;

    SplineGrid() = default;
    /** @param spacing of the knots [m], > 0 @param dimension 2: all of it lies in the plane z = 0 */
    SplineGrid(const std::vector<Eigen::Vector3d> &places, double spacing, int dimension);

    std::size_t knots() const { return knot_count; }
    /** @param values a record of each place @param grid a record of each knot; what was there is lost */
    void spread(const base::Column &values, base::Column &grid) const;
    /** @param values likewise */
    void gather(const base::Column &grid, base::Column &values) const;

  private:
    /** A place between its knots: the first of them, and weights along each axis. */
    struct Place
    {
      std::uint32_t                        first;
      std::array<std::array<double, 4>, 3> weight;
    };

    void spread_part(std::size_t begin, std::size_t end, const double *values, double *grid) const;

    std::vector<Place>   places;
    std::array<long, 3>  size{};                     ///< knots along each axis
    std::size_t          knot_count = 0, layers = 4; ///< knots across z that a place has weights on
    mutable base::Column parts;                      ///< grids of all but the first part of the places
  };
} // namespace dem
