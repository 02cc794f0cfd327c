#include "dem/genesis/insertion.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/core/uniform_random.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace dem
{
  namespace
  {
    /** Particles of like size in square cells: each cell holds the number of its newest, which points to the one before. */
    class SizeGrid
    {
    public:
      SizeGrid(const Vessel &vessel, const double largest, const std::size_t particles)
        : largest_radius(largest)
      {
        // Cells as wide as a particle, and no more than a few for each.
        const double per   = vessel.space() / (4 * static_cast<double>(particles) + 1);
        const double width = std::max(2 * largest, vessel.dimension == 2 ? std::sqrt(per) : std::cbrt(per));
        std::size_t  all   = 1;
        for (int d = 0; d < 3; ++d)
          {
            const double edge = d < vessel.dimension ? vessel.size[d] : width;
            count[d]          = std::max(1, static_cast<int>(edge / width));
            inverse_width[d]  = count[d] / edge;
            all *= static_cast<std::size_t>(count[d]);
          }
        newest.assign(all, none);
      }

      double largest() const { return largest_radius; }

      void add(const Eigen::Vector3d &x, const std::size_t particle)
      {
        std::int64_t &head = newest[cell(index(x, 0), index(x, 1), index(x, 2))];
        if (before.size() <= particle)
          before.resize(particle + 1, none);
        before[particle] = head;
        head             = static_cast<std::int64_t>(particle);
      }

      /** Whether none in here overlaps a particle. */
      bool is_free(const Eigen::Vector3d &x, const double radius, const Packing &placed) const
      {
        std::array<int, 3> low, high;
        const double       reach = radius + largest_radius;
        for (int d = 0; d < 3; ++d)
          {
            low[d]  = clamped((x[d] - reach) * inverse_width[d], d);
            high[d] = clamped((x[d] + reach) * inverse_width[d], d);
          }
        for (int k = low[2]; k <= high[2]; ++k)
          for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i)
              for (std::int64_t other = newest[cell(i, j, k)]; other != none;
                   other              = before[static_cast<std::size_t>(other)])
                {
                               const auto   p       = static_cast<std::size_t>(other);
                               const double touches = radius + placed.radius[p];
                               if ((placed.centre[p] - x).squaredNorm() < touches * touches)
                    return false;
                }
        return true;
      }

    private:
      static constexpr std::int64_t none = -1;

      int clamped(const double place, const int d) const
      {
        return std::min(count[d] - 1, std::max(0, static_cast<int>(std::floor(place))));
      }
      int         index(const Eigen::Vector3d &x, const int d) const { return clamped(x[d] * inverse_width[d], d); }
      std::size_t cell(const int i, const int j, const int k) const
      {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(count[1]) + static_cast<std::size_t>(j)) *
                 static_cast<std::size_t>(count[0]) +
               static_cast<std::size_t>(i);
      }

      double                    largest_radius;
      std::array<int, 3>        count;
      std::array<double, 3>     inverse_width;
      std::vector<std::int64_t> newest, before;
    };

    /** One grid for each halving of the size, for radii in descending order. */
    class Grids
    {
    public:
      Grids(const Vessel &vessel_, const std::vector<double> &radii)
        : vessel(vessel_)
        , sizes(radii)
      {
      }

      bool is_free(const Eigen::Vector3d &x, const double radius, const Packing &placed) const
      {
        return std::all_of(grids.begin(), grids.end(),
                           [&](const SizeGrid &grid) { return grid.is_free(x, radius, placed); });
      }

      void add(const Eigen::Vector3d &x, const double radius, const std::size_t particle)
      {
        if (grids.empty() || radius < 0.5 * grids.back().largest())
          {
            const auto end =
              std::partition_point(sizes.begin(), sizes.end(), [&](const double r) { return r >= 0.5 * radius; });
            grids.emplace_back(vessel, radius, static_cast<std::size_t>(end - sizes.begin()) - particle);
          }
        grids.back().add(x, particle);
      }

    private:
      const Vessel              &vessel;
      const std::vector<double> &sizes;
      std::vector<SizeGrid>      grids;
    };
  } // namespace

  Insertion insert_at_random(const Vessel       &vessel,
                             std::vector<double> radii,
                             const std::uint64_t seed,
                             const std::int64_t  attempts)
  {
    std::sort(radii.begin(), radii.end(), std::greater<double>());
    for (int d = 0; d < vessel.dimension && !radii.empty(); ++d)
      if (2 * radii.front() > vessel.size[d])
        throw base::InputError("Vessel: a particle of " + base::number_text(2 * radii.front()) +
                               " m does not fit into an edge of " + base::number_text(vessel.size[d]) +
                               " m. Enlarge the vessel, or check the units: metres.");
    UniformRandom random(seed);
    Insertion     made;
    Grids         grids(vessel, radii);
    for (std::size_t i = 0; i < radii.size(); ++i)
      {
        Eigen::Vector3d x;
        bool            free = false;
        for (std::int64_t draw = 0; draw < attempts && !free; ++draw)
          {
            const double a = random(), b = random(), c = vessel.dimension == 3 ? random() : 0.0;
            x    = vessel.place({{a, b, c}}, radii[i]);
            free = grids.is_free(x, radii[i], made.packing);
            ++made.draws;
          }
        if (!free)
          ++made.overlaps;
        made.packing.centre.push_back(x);
        made.packing.radius.push_back(radii[i]);
        grids.add(x, radii[i], i);
      }
    return made;
  }
} // namespace dem
