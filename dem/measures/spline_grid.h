#pragma once

#include "base/column.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
  /**
   * A regular grid of cubic B-splines over places that stay: spreads what places carry over its knots, and takes off at the places what
   * knots have, by the same weights (doc/theory/volume-coupling.md, 4).
   *
   * Values of places are records of three numbers and a free one, in the order of the grid: places of one cell of the grid follow each other,
   * so that what they share is read and written once. Fields on the knots are columns, one after the other, of those numbers alone that the
   * grid is requested; the others are left as they are.
   *
   * Same input, same bits, for any number of threads.
   */
  class SplineGrid
  {
  public:
    static constexpr std::size_t record = 4;

    /** Which of the three numbers of a record count. */
    struct Components
    {
      std::size_t first = 0, count = 3;
    };

    SplineGrid() = default;
    /** @param spacing of the knots [m], > 0 @param dimension 2: all of it lies in the plane z = 0 */
    SplineGrid(const std::vector<Eigen::Vector3d> &places, double spacing, int dimension, const Components &components);

    /** Which of the given places each of the grid's is. */
    const std::vector<std::size_t> &order() const { return given; }
    std::size_t                     knots() const { return knot_count; }
    const Components               &components() const { return requested; }
    Eigen::Vector3d                 place_of_knot(std::size_t knot) const; ///< [m]

    /** Sum up values times factors. @param grid what was there is lost */
    void spread(const base::Column &values, const base::Column &factors, base::Column &grid) const;
    /** What values have and the grid does not, times factors. @param left likewise; may be the values themselves */
    void take_off(const base::Column &grid,
                  const base::Column &values,
                  const base::Column &factors,
                  base::Column       &left) const;
    /**
     * Averages of one or more columns over the knots around, by the products of B-splines that places everywhere would sum up to; nothing is
     * beyond the grid.
     */
    void smooth(base::Column &columns) const;

  private:
    /** A place between its knots: the first of them; weights of a layer of 16; weights of the layers. */
    struct Place
    {
      std::array<double, 16> across;
      std::array<double, 4>  along;
    };

    template <std::size_t Layers, std::size_t Count>
    void
    spread_part(std::size_t begin, std::size_t end, const double *values, const double *factors, double *grid) const;
    template <std::size_t Layers, std::size_t Count>
    void take_off_part(std::size_t   begin,
                       std::size_t   end,
                       const double *grid,
                       const double *values,
                       const double *factors,
                       double       *left) const;
    /** @param use is called with the part of spread() or take_off() for the layers and components that there are */
    template <typename Use>
    void dispatch(Use &&use) const;
    /** Of knots that are so far apart. */
    void        smooth_along(std::size_t axis, double *column) const;
    std::size_t parts() const;

    std::vector<Place, base::ColumnAllocator<Place>> places;
    std::vector<std::uint32_t>                       first; ///< knot of each place
    std::vector<std::size_t>                         given;
    Components                                       requested;
    double                                           step = 0;                   ///< spacing [m]
    std::array<long, 3>                              low{}, size{1, 1, 1};       ///< first cell; knots along each axis
    std::size_t                                      knot_count = 0, layers = 4; ///< layers that a place has weights on
    mutable base::Column                             of_parts; ///< grids of all but the first part of the places
  };
} // namespace dem
