#include "dem/packing/sequential_placement.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/core/uniform_random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace dem
{
  namespace
  {
    /** Cells that grow by one sphere at a time: each holds the number of its newest, which points to the one before. */
    class GrowingCells
    {
    public:
      GrowingCells(const Eigen::Vector3d &cell_edges, const double diameter, const std::size_t spheres)
        : edges(cell_edges)
        , reach(diameter)
      {
        // At least as wide as the reach, no more cells than a few per sphere.
        const double width = std::max(reach, std::cbrt(edges.prod() / (8 * static_cast<double>(spheres) + 1)));
        std::size_t  all   = 1;
        for (int d = 0; d < 3; ++d)
          {
            count[d] = std::max(1, static_cast<int>(edges[d] / width));
            all *= static_cast<std::size_t>(count[d]);
          }
        newest.assign(all, none);
      }

      bool is_free(const Eigen::Vector3d &x, const std::vector<Eigen::Vector3d> &placed) const
      {
        // With fewer than three cells a neighbour on both sides is the same one.
        const std::array<int, 3> home = cell_of(x);
        std::array<int, 3>       low, high;
        for (int d = 0; d < 3; ++d)
          {
            low[d]  = count[d] >= 3 ? -1 : 0;
            high[d] = count[d] >= 3 ? 1 : count[d] - 1;
          }
        for (int dz = low[2]; dz <= high[2]; ++dz)
          for (int dy = low[1]; dy <= high[1]; ++dy)
            for (int dx = low[0]; dx <= high[0]; ++dx)
              for (std::int64_t other = newest[number({{home[0] + dx, home[1] + dy, home[2] + dz}})]; other != none;
                   other              = before[other])
                if (nearest_distance_squared(x, placed[other]) < reach * reach)
                  return false;
        return true;
      }

      void add(const Eigen::Vector3d &x)
      {
        std::int64_t &head = newest[number(cell_of(x))];
        before.push_back(head);
        head = static_cast<std::int64_t>(before.size()) - 1;
      }

    private:
      static constexpr std::int64_t none = -1;

      std::array<int, 3> cell_of(const Eigen::Vector3d &x) const
      {
        std::array<int, 3> cell;
        for (int d = 0; d < 3; ++d)
          cell[d] = std::min(static_cast<int>(x[d] / edges[d] * count[d]), count[d] - 1);
        return cell;
      }

      std::size_t number(const std::array<int, 3> &cell) const
      {
        std::size_t n = 0;
        for (int d = 2; d >= 0; --d)
          n = n * static_cast<std::size_t>(count[d]) + static_cast<std::size_t>((cell[d] + count[d]) % count[d]);
        return n;
      }

      double nearest_distance_squared(const Eigen::Vector3d &a, const Eigen::Vector3d &b) const
      {
        double sum = 0;
        for (int d = 0; d < 3; ++d)
          {
            const double apart = std::abs(a[d] - b[d]), nearest = std::min(apart, edges[d] - apart);
            sum += nearest * nearest;
          }
        return sum;
      }

      Eigen::Vector3d           edges;
      double                    reach;
      std::array<int, 3>        count;
      std::vector<std::int64_t> newest, before;
    };
  } // namespace

  Packing place_sequentially(const std::size_t      count,
                             const double           radius,
                             const Eigen::Vector3d &edges,
                             const std::uint64_t    seed)
  {
    constexpr int most_draws = 100000;
    if (!(edges.minCoeff() >= 2 * radius))
      throw base::InputError("random placement: a sphere of diameter " + base::number_text(2 * radius) +
                             " m overlaps its own image in a periodic cell of edge " +
                             base::number_text(edges.minCoeff()) + " m.");
    UniformRandom random(seed);
    GrowingCells  cells(edges, 2 * radius, count);
    Packing       packing;
    packing.periodic_cell = edges;
    packing.radius.assign(count, radius);
    packing.centre.reserve(count);
    while (packing.centre.size() < count)
      {
        Eigen::Vector3d x;
        int             draws = 0;
        do
          {
            if (++draws > most_draws)
              {
                std::ostringstream text;
                text << "random placement: sphere " << packing.centre.size() + 1 << " of " << count
                     << " found no free place in " << most_draws
                     << " draws. Place them in a larger cell (its edges are " << edges.transpose() << " m).";
                throw base::InputError(text.str());
              }
            for (int d = 0; d < 3; ++d)
              x[d] = edges[d] * random();
          }
        while (!cells.is_free(x, packing.centre));
        cells.add(x);
        packing.centre.push_back(x);
      }
    return packing;
  }
} // namespace dem
