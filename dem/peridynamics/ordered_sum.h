#pragma once

#include "dem/peridynamics/grid.h"

#include <cstddef>
#include <vector>

namespace dem::peridynamics
{
  /** Sum of what a function says of each place: over the places of a row, then over the rows, so that threads do not decide its bits. */
  template <typename Function>
  double ordered_sum(const Grid &grid, Function &&f)
  {
    std::vector<double> sums(grid.rows(), 0.0);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t r = 0; r < static_cast<std::ptrdiff_t>(grid.rows()); ++r)
      {
        const std::size_t first = static_cast<std::size_t>(r) * grid.row_stride();
        double            sum   = 0;
        for (std::size_t i = first; i < first + static_cast<std::size_t>(grid.counts()[0]); ++i)
          sum += f(i);
        sums[static_cast<std::size_t>(r)] = sum;
      }
    double all = 0;
    for (const double sum : sums)
      all += sum;
    return all;
  }

  /** The largest of these, at least 0. */
  template <typename Function>
  double largest_of(const Grid &grid, Function &&f)
  {
    double found = 0;
    for (const std::size_t i : grid.nodes())
      if (const double v = f(i); v > found)
        found = v;
    return found;
  }
} // namespace dem::peridynamics
